using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>The core of a capsule: its segment.</summary>
public readonly struct CapsuleSupport : ISupport<CapsuleWide>
{
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector<float> Margin(in CapsuleWide shape) => shape.Radius;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void GetExtents(in CapsuleWide shape, out Vector3Wide center, out Vector<float> inner, out Vector<float> outer)
    {
        center = Vector3Wide.Zero;
        inner = Vector<float>.Zero;
        outer = shape.HalfLength;
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3Wide Support(in CapsuleWide shape, in Vector3Wide direction, Vector<int> doneMask) =>
        new(Vector<float>.Zero, Wide.CopySign(shape.HalfLength, direction.Y), Vector<float>.Zero);
}
