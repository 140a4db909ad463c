using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>The core of a sphere: its centre.</summary>
public readonly struct SphereSupport : ISupport<SphereWide>
{
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector<float> Margin(in SphereWide shape) => shape.Radius;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void GetExtents(in SphereWide shape, out Vector3Wide center, out Vector<float> inner, out Vector<float> outer)
    {
        center = Vector3Wide.Zero;
        inner = Vector<float>.Zero;
        outer = Vector<float>.Zero;
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3Wide Support(in SphereWide shape, in Vector3Wide direction, Vector<int> doneMask) => Vector3Wide.Zero;
}
