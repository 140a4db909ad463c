namespace BepuPhysics.CollisionDetection;

/// <summary>What the surfaces of a pair do besides friction and stiffness. The default is nothing, and costs nothing.</summary>
public struct SurfaceProperties
{
    /// <summary>
    /// Coefficient of restitution: speed after an impact over speed before it, 0 to 1. Impacts no faster than what gravity adds in two steps
    /// do not bounce, so that resting things rest.
    /// </summary>
    public float Restitution;
}
