using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>One edge of each triangle of a bundle, as the testers of triangles look at it.</summary>
struct TriangleEdgeWide
{
    /// <summary>Corner where the edge starts.</summary>
    public Vector3Wide Start;
    /// <summary>Unit direction of the edge; zero where it has no length.</summary>
    public Vector3Wide Direction;
    /// <summary>Length of the edge.</summary>
    public Vector<float> Length;
    /// <summary>Unit direction away from the triangle, within its plane and across the edge; zero where the triangle has no area.</summary>
    public Vector3Wide Outward;

    /// <summary>Creates the edge between two corners that follow each other in the order A, B, C.</summary>
    /// <param name="start">First corner.</param>
    /// <param name="end">Second corner.</param>
    /// <param name="front">Unit normal of the triangle's front.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public TriangleEdgeWide(in Vector3Wide start, in Vector3Wide end, in Vector3Wide front)
    {
        Start = start;
        var offset = end - start;
        Length = offset.Length();
        Direction = offset * Wide.DivideOrZero(Vector<float>.One, Length);
        // The corners follow each other clockwise around the normal of the front.
        Outward = Vector3Wide.Cross(front, Direction);
    }

    /// <summary>How far a point is beyond the edge, seen along the triangle's normal; negative on the side of the triangle.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly Vector<float> GetBeyond(in Vector3Wide point) => Vector3Wide.Dot(Outward, point - Start);
}
