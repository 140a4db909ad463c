using BepuPhysics.Collidables;

namespace BepuPhysics.CollisionDetection;

/// <summary>Two collidables that may touch.</summary>
public struct CollidablePair(CollidableReference a, CollidableReference b)
{
    /// <summary>First collidable; never a static.</summary>
    public CollidableReference A = a;
    /// <summary>Second collidable.</summary>
    public CollidableReference B = b;

    /// <inheritdoc/>
    public override readonly string ToString() => $"({A}, {B})";
}
