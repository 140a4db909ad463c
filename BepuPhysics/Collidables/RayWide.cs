using BepuUtilities;

namespace BepuPhysics.Collidables;

/// <summary>A bundle of rays.</summary>
public struct RayWide
{
    /// <summary>Where the rays start, world space, m.</summary>
    public Vector3Wide Origin;
    /// <summary>Directions of the rays; their lengths are the unit of t.</summary>
    public Vector3Wide Direction;
}
