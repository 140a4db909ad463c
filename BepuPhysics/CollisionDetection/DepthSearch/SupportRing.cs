using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>
/// A lower bound of the depth that costs four support points, for all lanes at once: from directions tilted by a little, every quarter of a turn
/// around that of the minimum.
/// </summary>
/// <remarks>
/// The descent's triangle shrinks to a point where the difference is round, and the tetrahedron on it is a needle. The ring is as wide as the
/// slack allows. With the point that the descent found in the middle and one of the inner ball below it makes a closed surface of eight
/// triangles whose corners are points of the difference. Where the origin is on the inner side of all their planes it is inside, and a ball
/// around it that no plane cuts lies in the difference: no depth is less than its radius.
/// </remarks>
struct SupportRing
{
    public const int VertexCount = 4;
    // Tangent of the tilt, at most: where shapes hardly touch, anything would do.
    const float GreatestTilt = 0.5f;
    // In sizes of the smaller shape. The ring reaches the tilt times a radius of curvature to the side, and there its planes must be as far from
    // the origin as the depth: with depths of more than the tilt times this, they hardly ever are.
    const float GreatestRadius = 1.6f;
    // Part of the longest edge of the descent's triangle that must be across the direction, squared; and length at which there is an edge.
    const float LeastAcross = 0.5f;
    const float LeastSquaredEdge = 1e-12f;
    const float LeastEdge = 1e-6f;

    /// <summary>Counterclockwise, seen against the direction.</summary>
    public SearchVertex Vertex0, Vertex1, Vertex2, Vertex3;
    /// <summary>Lanes that have a ring.</summary>
    public Vector<int> Mask;
    /// <summary>Across the direction, as long as the tilt's tangent.</summary>
    public Vector3Wide Along;
    Vector3Wide normal, top, bottom;
    Vector<float> squaredBound, tilt, tiltedScale;

    /// <summary>Chooses which way to tilt, and how far.</summary>
    // A plane through the middle of the ring that is tilted by an angle is the depth times the angle's cosine away: so far that this is the bound,
    // or nearly.
    // First along the longest edge of the descent's triangle: where the difference is flat, its face is longest about there.
    [MethodImpl(MethodImplOptions.NoInlining)]
    public void Start(in SearchDescent descent, in SearchFrame frame, Vector<float> bound, Vector<int> openMask)
    {
        // All lanes of the mask are deeper than the slack, which is above zero.
        tilt = Wide.Min(Vector.SquareRoot((descent.Depth - bound) * new Vector<float>(2) / descent.Depth), new Vector<float>(GreatestTilt));
        Mask = openMask & Vector.LessThan(descent.Depth, tilt * frame.Smaller * new Vector<float>(GreatestRadius));
        if (Mask == Vector<int>.Zero)
            return;
        tiltedScale = Vector<float>.One / Vector.SquareRoot(Vector<float>.One + tilt * tilt);
        squaredBound = bound * bound;
        normal = descent.Direction;
        ref readonly var simplex = ref descent.Simplex;
        var weights = simplex.GetWeights(descent.Target());
        top = simplex.A.Point * weights.X + simplex.B.Point * weights.Y + simplex.C.Point * weights.Z;
        bottom = frame.Center - normal * frame.Inner;

        var edge = simplex.B.Point - simplex.A.Point;
        var squaredEdge = edge.LengthSquared();
        TakeLonger(simplex.C.Point - simplex.B.Point, ref edge, ref squaredEdge);
        TakeLonger(simplex.A.Point - simplex.C.Point, ref edge, ref squaredEdge);
        edge -= normal * Vector3Wide.Dot(edge, normal);
        var squaredAcross = edge.LengthSquared();
        var hasEdge = Vector.GreaterThan(squaredEdge, new Vector<float>(LeastSquaredEdge)) &
            Vector.GreaterThan(squaredAcross, squaredEdge * new Vector<float>(LeastAcross));
        Vector3Wide.BuildOrthonormalBasis(normal, out var any, out _);
        Along = Vector3Wide.Select(hasEdge, edge * (tilt / Vector.SquareRoot(squaredAcross)), any * tilt);
    }

    /// <summary>Across the line between the first and the third point, so that the other two are on either side of it.</summary>
    // Where the difference is round and curved unequally, support points are not in the direction of the tilt.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly Vector3Wide Across(in Vector3Wide direction)
    {
        var across = Vector3Wide.Cross(direction, Vertex0.Point - Vertex2.Point);
        var length = across.Length();
        return Vector3Wide.Select(
            Vector.GreaterThan(length, new Vector<float>(LeastEdge)), across * (tilt / length), Vector3Wide.Cross(direction, Along));
    }

    /// <summary>The direction tilted, as a unit vector.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly Vector3Wide Tilt(in Vector3Wide tangent) => (normal + tangent) * tiltedScale;

    /// <summary>Lanes in which no direction can be less deep than the bound.</summary>
    // Four points that are one are no ring: all its sides would pass for want of triangles.
    [MethodImpl(MethodImplOptions.NoInlining)]
    public readonly Vector<int> Certifies() =>
        Mask & ~(SearchVertex.AreOne(Vertex0.Point, Vertex1.Point) & SearchVertex.AreOne(Vertex0.Point, Vertex2.Point)) &
        IsBeyond(Vertex0.Point, Vertex1.Point) & IsBeyond(Vertex1.Point, Vertex2.Point) &
        IsBeyond(Vertex2.Point, Vertex3.Point) & IsBeyond(Vertex3.Point, Vertex0.Point);

    /// <summary>Whether the triangles above and below a side of the ring are far enough from the origin. Two points that are one have none.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    readonly Vector<int> IsBeyond(in Vector3Wide from, in Vector3Wide to) =>
        SearchVertex.AreOne(from, to) | (IsBeyond(top, from, to) & IsBeyond(to, from, bottom));

    /// <summary>Whether the origin is far enough inside of a triangle that is counterclockwise seen from outside.</summary>
    // The first corner is one that is near: a plane that is measured from a far one has that corner's rounding.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    readonly Vector<int> IsBeyond(in Vector3Wide a, in Vector3Wide b, in Vector3Wide c)
    {
        var e1 = b - a;
        var e2 = c - a;
        var outward = Vector3Wide.Cross(e1, e2);
        var squared = outward.LengthSquared();
        var offset = Vector3Wide.Dot(outward, a);
        return Vector.GreaterThan(squared, e1.LengthSquared() * e2.LengthSquared() * new Vector<float>(SearchTolerances.SquaredSineOfPlane)) &
            Vector.GreaterThan(offset, Vector<float>.Zero) & Vector.GreaterThanOrEqual(offset * offset, squaredBound * squared);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void TakeLonger(in Vector3Wide other, ref Vector3Wide edge, ref Vector<float> squaredEdge)
    {
        var squaredOther = other.LengthSquared();
        var isLonger = Vector.GreaterThan(squaredOther, squaredEdge);
        edge = Vector3Wide.Select(isLonger, other, edge);
        squaredEdge = Wide.Select(isLonger, squaredOther, squaredEdge);
    }
}
