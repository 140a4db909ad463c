namespace BepuPhysics.CollisionDetection;

/// <summary>What the surfaces of a pair do besides friction and stiffness. The default is nothing, and costs nothing.</summary>
public struct SurfaceProperties
{
    /// <summary>
    /// Coefficient of restitution: speed after an impact over speed before it, 0 to 1. Impacts no faster than what gravity adds in two steps
    /// do not bounce, so that resting things rest.
    /// </summary>
    public float Restitution;

    /// <summary>
    /// Whether impacts are made when the surfaces meet, as those of surfaces that bounce, also where <see cref="Restitution"/> is zero: what falls stays where
    /// it lands. Contacts by themselves take a few substeps to stop it, it overlaps meanwhile, and leaves with the speed at which that is corrected, at
    /// most that of the material; with relaxations less. Costs as much as restitution.
    /// </summary>
    public bool ExactImpacts;
}
