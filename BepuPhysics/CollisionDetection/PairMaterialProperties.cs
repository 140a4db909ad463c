using BepuPhysics.Constraints;

namespace BepuPhysics.CollisionDetection;

/// <summary>How the surfaces of a pair behave.</summary>
/// <param name="frictionCoefficient">Coulomb coefficient: greatest friction force over normal force of the whole contact patch; not negative.</param>
/// <param name="maximumRecoveryVelocity">Greatest speed at which penetration is corrected, m/s; not negative.</param>
/// <param name="springSettings">Stiffness of the contacts; the default is rigid.</param>
public struct PairMaterialProperties(float frictionCoefficient, float maximumRecoveryVelocity, SpringSettings springSettings)
{
    /// <summary>Coulomb coefficient: greatest friction force over normal force of the whole contact patch.</summary>
    public float FrictionCoefficient = frictionCoefficient;
    /// <summary>Greatest speed at which penetration is corrected, m/s.</summary>
    public float MaximumRecoveryVelocity = maximumRecoveryVelocity;
    /// <summary>Stiffness of the contacts; the default is rigid.</summary>
    public SpringSettings SpringSettings = springSettings;
    /// <summary>
    /// Coefficient of restitution: speed after an impact over speed before it, 0 to 1. Impacts no faster than what gravity adds in two steps
    /// do not bounce, so that resting things rest. Costs nothing where it is 0.
    /// </summary>
    public float Restitution;
}
