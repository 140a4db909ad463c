using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>A triangle, from the side that the direction looks to.</summary>
public readonly struct TriangleFeature : IContactFeature<TriangleWide>
{
    /// <summary>
    /// Sine by which a direction may point behind a one-sided triangle. A triangle that is touched at an edge, in its plane, would
    /// otherwise be there or not by rounding, and so would one whose plane a segment crosses.
    /// </summary>
    internal const float BehindSine = 1e-4f;

    /// <inheritdoc/>
    public static int MaximumVertexCount => 3;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Find(in TriangleWide shape, in Vector3Wide direction, Vector<int> done, ref Vector3Wide vertices,
        out ContactFeatureWide feature)
    {
        // Seen from the front A, B, C run clockwise.
        var normal = FrontNormal(shape);
        var isFront = Vector.GreaterThanOrEqual(Vector3Wide.Dot(normal, direction), Vector<float>.Zero);
        vertices = shape.A;
        Unsafe.Add(ref vertices, 1) = Vector3Wide.Select(isFront, shape.C, shape.B);
        Unsafe.Add(ref vertices, 2) = Vector3Wide.Select(isFront, shape.B, shape.C);
        feature.VertexCount = new Vector<int>(3);
        feature.PlaneNormal = Vector3Wide.Select(isFront, normal, -normal);
        feature.Id = Vector.AndNot(Vector<int>.One, isFront);
        feature.Margin = Vector<float>.Zero;
        feature.Roundness = Vector<float>.Zero;
        feature.Size = Vector.SquareRoot(Wide.Max(shape.A.LengthSquared(), Wide.Max(shape.B.LengthSquared(), shape.C.LengthSquared())));
    }

    /// <summary>Lanes of one-sided triangles whose direction points behind them; a triangle without an area has no behind.</summary>
    /// <param name="shape">Triangles.</param>
    /// <param name="direction">Unit directions out of the triangles, in their frames.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector<int> RejectsNormal(in TriangleWide shape, in Vector3Wide direction)
    {
        var isBehind = Vector.LessThan(Vector3Wide.Dot(FrontNormal(shape), direction), new Vector<float>(-BehindSine));
        return isBehind & Vector.Equals(shape.TwoSidedMask, Vector<int>.Zero);
    }

    // The edges have lengths of up to 1e7 m; the squared length of their cross product stays in range.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector3Wide FrontNormal(in TriangleWide shape) =>
        Vector3Wide.Normalize(Vector3Wide.Cross(shape.C - shape.A, shape.B - shape.A));
}
