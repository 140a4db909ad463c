using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>A triangle is its own core, without a front or a back. Of equally far corners it shows the first.</summary>
public readonly struct TriangleSupport : ISupport<TriangleWide>
{
    /// <inheritdoc/>
    public static int FaceVertexCount => 3;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3Wide FaceNormal(in TriangleWide shape, in Vector3Wide direction)
    {
        var normal = Vector3Wide.Cross(shape.B - shape.A, shape.C - shape.A);
        var along = Vector3Wide.Dot(normal, direction);
        return normal * (Wide.CopySign(Vector<float>.One, along) / normal.Length());
    }

    /// <inheritdoc/>
    // Counter-clockwise whichever side is looked at: the second axis is turned to where the third corner is.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void GetFace(in TriangleWide shape, in Vector3Wide normal, out SearchFace face)
    {
        Unsafe.SkipInit(out face);
        var ab = shape.B - shape.A;
        face.Normal = normal;
        face.AxisX = ab * (Vector<float>.One / ab.Length());
        var across = Vector3Wide.Cross(normal, face.AxisX);
        face.AxisY = across * Wide.CopySign(Vector<float>.One, Vector3Wide.Dot(across, shape.C - shape.A));
        face.Height = Vector3Wide.Dot(normal, shape.A);
        face.Corner0 = face.Place(shape.A);
        face.Corner1 = face.Place(shape.B);
        face.Corner2 = face.Place(shape.C);
        face.Corner3 = face.Corner0;
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector<float> Margin(in TriangleWide shape) => Vector<float>.Zero;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void GetExtents(in TriangleWide shape, out Vector3Wide center, out Vector<float> inner, out Vector<float> outer)
    {
        center = shape.A + (shape.B - shape.A + (shape.C - shape.A)) * new Vector<float>(1f / 3);
        inner = Vector<float>.Zero;
        outer = Vector.SquareRoot(Wide.Max(Wide.Max(
            (shape.A - center).LengthSquared(), (shape.B - center).LengthSquared()), (shape.C - center).LengthSquared()));
    }

    /// <inheritdoc/>
    // By differences of corners: exact where the triangle is far from the origin of its frame.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3Wide Support(in TriangleWide shape, in Vector3Wide direction, Vector<int> doneMask)
    {
        var b = Vector3Wide.Dot(shape.B - shape.A, direction);
        var c = Vector3Wide.Dot(shape.C - shape.A, direction);
        var useB = Vector.GreaterThan(b, Vector<float>.Zero);
        var useC = Vector.GreaterThan(c, Wide.Max(b, Vector<float>.Zero));
        return Vector3Wide.Select(useC, shape.C, Vector3Wide.Select(useB, shape.B, shape.A));
    }
}
