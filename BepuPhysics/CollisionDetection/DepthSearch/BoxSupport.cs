using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>A box is its own core. Of equally far corners it shows the one whose signs are those of the direction.</summary>
public readonly struct BoxSupport : ISupport<BoxWide>
{
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector<float> Margin(in BoxWide shape) => Vector<float>.Zero;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void GetExtents(in BoxWide shape, out Vector3Wide center, out Vector<float> inner, out Vector<float> outer)
    {
        center = Vector3Wide.Zero;
        inner = Wide.Min(Wide.Min(shape.HalfWidth, shape.HalfHeight), shape.HalfLength);
        outer = new Vector3Wide(shape.HalfWidth, shape.HalfHeight, shape.HalfLength).Length();
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3Wide Support(in BoxWide shape, in Vector3Wide direction, Vector<int> doneMask) => new(
        Wide.CopySign(shape.HalfWidth, direction.X),
        Wide.CopySign(shape.HalfHeight, direction.Y),
        Wide.CopySign(shape.HalfLength, direction.Z));
}
