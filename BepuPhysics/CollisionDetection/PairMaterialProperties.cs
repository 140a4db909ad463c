using BepuPhysics.Constraints;

namespace BepuPhysics.CollisionDetection;

/// <summary>How the surfaces of a pair behave: these three fields and no others, so that a game may set them one by one.</summary>
/// <remarks>What only some pairs have, such as restitution, is in <see cref="SurfaceProperties"/>.</remarks>
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
}
