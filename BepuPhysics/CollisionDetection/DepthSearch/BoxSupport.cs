using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>A box is its own core. Of equally far corners it shows the one whose signs are those of the direction.</summary>
public readonly struct BoxSupport : ISupport<BoxWide>
{
    /// <inheritdoc/>
    public static int FaceVertexCount => 4;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3Wide FaceNormal(in BoxWide shape, in Vector3Wide direction)
    {
        var x = Vector.Abs(direction.X);
        var y = Vector.Abs(direction.Y);
        var z = Vector.Abs(direction.Z);
        var isX = Vector.GreaterThanOrEqual(x, Wide.Max(y, z));
        var isY = Vector.AndNot(Vector.GreaterThanOrEqual(y, z), isX);
        var isZ = Vector.OnesComplement(isX | isY);
        var one = Vector<float>.One;
        return new(Wide.Mask(isX, Wide.CopySign(one, direction.X)), Wide.Mask(isY, Wide.CopySign(one, direction.Y)),
            Wide.Mask(isZ, Wide.CopySign(one, direction.Z)));
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void GetFace(in BoxWide shape, in Vector3Wide normal, out SearchFace face)
    {
        var x = Vector.Abs(normal.X);
        var y = Vector.Abs(normal.Y);
        var z = Vector.Abs(normal.Z);
        var isX = Vector.GreaterThan(x, Vector<float>.Zero);
        var isY = Vector.GreaterThan(y, Vector<float>.Zero);
        face.Normal = normal;
        // The next axes in turn.
        face.AxisX = new(z, x, y);
        face.AxisY = new(y, z, x);
        face.Height = Wide.Select(isX, shape.HalfWidth, Wide.Select(isY, shape.HalfHeight, shape.HalfLength));
        var extentX = Wide.Select(isX, shape.HalfHeight, Wide.Select(isY, shape.HalfLength, shape.HalfWidth));
        var extentY = Wide.Select(isX, shape.HalfLength, Wide.Select(isY, shape.HalfWidth, shape.HalfHeight));
        face.Corner0 = new(extentX, extentY);
        face.Corner1 = new(-extentX, extentY);
        face.Corner2 = new(-extentX, -extentY);
        face.Corner3 = new(extentX, -extentY);
    }

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
