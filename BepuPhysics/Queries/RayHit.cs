using System.Numerics;
using BepuPhysics.Collidables;

namespace BepuPhysics;

/// <summary>What a ray hits, and where.</summary>
public struct RayHit
{
    /// <summary>The collidable.</summary>
    public CollidableReference Collidable;

    /// <summary>
    /// Number of the convex piece that was hit: of the triangle of a mesh, of the child of a compound, or, where that is made of children
    /// itself, what <see cref="Compound.FindPiece"/> takes apart; zero for a shape without children.
    /// </summary>
    public int ChildIndex;

    /// <summary>Where on the ray, in units of its direction; zero for a ray that starts inside.</summary>
    public float T;

    /// <summary>Where in the world, m: origin + direction * <see cref="T"/>.</summary>
    public Vector3 Place;

    /// <summary>Unit normal out of the shape, in world axes.</summary>
    public Vector3 Normal;

    /// <summary>Whether this hit comes before another one of the same ray: what is nearer, or is as near and has the lower reference or piece.</summary>
    internal readonly bool ComesBefore(in RayHit other)
    {
        if (T != other.T)
            return T < other.T;
        return Collidable.Packed != other.Collidable.Packed ? Collidable.Packed < other.Collidable.Packed : ChildIndex < other.ChildIndex;
    }
}
