using System.Numerics;
using BepuPhysics.Collidables;

namespace BepuPhysics;

/// <summary>How near a collidable is to a shape or point.</summary>
public struct Proximity
{
    /// <summary>The collidable.</summary>
    public CollidableReference Collidable;

    /// <summary>
    /// Number of its nearest convex piece, as rays tell it; zero for shapes without children. Of pieces that are equally near it is the lowest
    /// number, of pieces that overlap any one.
    /// </summary>
    public int ChildIndex;

    /// <summary>Distance of the surfaces, m: that in double precision, rounded up. Zero where the shapes overlap or touch.</summary>
    public float Distance;

    /// <summary>
    /// Point of the collidable's surface that is nearest to what was asked about, in the world, m. Zero where the shapes overlap.
    /// </summary>
    public Vector3 Place;

    /// <summary>Unit normal out of the collidable there, towards what was asked about, in world axes. Zero where the shapes overlap.</summary>
    public Vector3 Normal;

    /// <summary>Whether the shapes overlap or touch.</summary>
    public bool Overlaps;
}
