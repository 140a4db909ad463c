using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>Triangles in the frame of the other shape of their pair.</summary>
// The edges are rotated by themselves, not taken as differences of corners: short edges far from the origin keep their directions.
struct PlacedTriangleWide
{
    /// <summary>Corners.</summary>
    public Vector3Wide A, B, C;
    /// <summary>From each corner to the next.</summary>
    public Vector3Wide AB, BC, CA;
    /// <summary>Unit normal of the front; zero where the triangle has no area.</summary>
    public Vector3Wide Front;

    /// <summary>Places triangles.</summary>
    /// <param name="triangle">Triangles in their own frames.</param>
    /// <param name="axes">Axes of the triangles, in the rows.</param>
    /// <param name="offset">Positions of the triangles.</param>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public void Place(in TriangleWide triangle, in Matrix3x3Wide axes, in Vector3Wide offset)
    {
        PlaceCorners(triangle, axes, offset);
        FindFront();
    }

    /// <summary>Places triangles whose front is found in their own frames, which is finer where they are thin.</summary>
    /// <param name="triangle">Triangles in their own frames.</param>
    /// <param name="axes">Axes of the triangles, in the rows.</param>
    /// <param name="offset">Positions of the triangles.</param>
    /// <param name="height">Height of the frame's origin over the planes of the triangles.</param>
    // Of the height, too, the part that the triangle has in its own frame is found there: corners that are far away bring their rounding along.
    [MethodImpl(MethodImplOptions.NoInlining)]
    public void PlaceThin(in TriangleWide triangle, in Matrix3x3Wide axes, in Vector3Wide offset, out Vector<float> height)
    {
        PlaceCorners(triangle, axes, offset);
        var normal = triangle.GetNormal();
        Front = Matrix3x3Wide.TransposeTimes(axes, normal);
        height = -(Vector3Wide.Dot(normal, triangle.A) + Vector3Wide.Dot(Front, offset));
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    void PlaceCorners(in TriangleWide triangle, in Matrix3x3Wide axes, in Vector3Wide offset)
    {
        AB = Matrix3x3Wide.TransposeTimes(axes, triangle.B - triangle.A);
        BC = Matrix3x3Wide.TransposeTimes(axes, triangle.C - triangle.B);
        CA = Matrix3x3Wide.TransposeTimes(axes, triangle.A - triangle.C);
        A = Matrix3x3Wide.TransposeTimes(axes, triangle.A) + offset;
        B = A + AB;
        C = A - CA;
    }

    /// <summary>Takes triangles where they are.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public void Place(in TriangleWide triangle)
    {
        A = triangle.A;
        B = triangle.B;
        C = triangle.C;
        AB = B - A;
        BC = C - B;
        CA = A - C;
        FindFront();
    }

    // Seen from the front A, B, C run clockwise.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    void FindFront() => Front = Vector3Wide.Normalize(Vector3Wide.Cross(AB, CA));

    /// <summary>Length of the longest edge.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly Vector<float> GetSize() =>
        Vector.SquareRoot(Wide.Max(Wide.Max(AB.LengthSquared(), BC.LengthSquared()), CA.LengthSquared()));

    /// <summary>The interval that the triangle takes along a direction.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly void Project(in Vector3Wide direction, out Vector<float> least, out Vector<float> greatest)
    {
        var a = Vector3Wide.Dot(direction, A);
        var b = Vector3Wide.Dot(direction, B);
        var c = Vector3Wide.Dot(direction, C);
        least = Wide.Min(Wide.Min(a, b), c);
        greatest = Wide.Max(Wide.Max(a, b), c);
    }

    /// <summary>The corner that is farthest along a direction; of equally far ones the first.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly Vector3Wide GetSupport(in Vector3Wide direction)
    {
        var a = Vector3Wide.Dot(direction, A);
        var b = Vector3Wide.Dot(direction, B);
        var c = Vector3Wide.Dot(direction, C);
        var point = Vector3Wide.Select(Vector.GreaterThan(b, a), B, A);
        return Vector3Wide.Select(Vector.GreaterThan(c, Wide.Max(a, b)), C, point);
    }
}
