using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>The least depth of two triangles: what is known of it, and the search for it. Everything is in A's frame.</summary>
// Triangles that cross leave each other along the normal of one of them or across an edge of each: 2 and 9 axes. Triangles that are apart
// may be nearest at an edge and a corner, or at two corners: the distances of the corners of each from the edges of the other cover that,
// and triangles side by side in one plane as well, for which the other axes show nothing.
// Along an axis, the corners of both are projected, those of its edges included: rounding turns the product of two short or nearly parallel
// edges out of its right direction, and then it is an axis still.
struct TriangleTriangleAxes
{
    // Squared sine below which two edges are parallel. The direction of their product is wrong by the rounding of an edge over the sine, and
    // without it the depth is wrong by up to the sine times the shorter edge: both are some 2e-4 here.
    const float ParallelSineSquared = 1e-7f;
    // An axis of edges must beat the normals by this part of the smaller triangle. Rounding is below it.
    const float EdgeTolerance = 1e-5f;
    // Nearest points must show this much more than the axes, by the smaller triangle.
    const float NearestTolerance = 1e-6f;
    // Part of the smaller triangle by which nearest points may be farther apart than the axis shows and still be what it belongs to.
    const float TouchTolerance = 1e-5f;
    // Depth up to which the nearest points are looked for, by the smaller triangle: in one plane, rounding may show a depth.
    const float FlatTolerance = 1e-4f;

    /// <summary>The triangles.</summary>
    public PlacedTriangleWide A, B;
    /// <summary>Unit normal from B to A.</summary>
    public Vector3Wide Normal;
    /// <summary>Depth along the normal, negative where the triangles are apart; the greatest number where they have no axis.</summary>
    public Vector<float> Depth;
    /// <summary>A point of A that is as deep.</summary>
    public Vector3Wide PointOnA;

    /// <summary>Length of the smaller triangle.</summary>
    Vector<float> size;
    EdgeSearch edges;
    NearestSearch nearest;

    /// <summary>Lanes where the nearest points could show a greater distance.</summary>
    public readonly Vector<int> MayBeApart
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => Vector.LessThan(Depth, size * new Vector<float>(FlatTolerance)) | Vector.Equals(Depth, new Vector<float>(float.MaxValue));
    }

    /// <summary>Finds the axis of least depth.</summary>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public void FindLeastDepth()
    {
        edges.Score = new Vector<float>(float.MaxValue);
        edges.Axis = A.AB;
        edges.IndexA = edges.IndexB = Vector<int>.Zero;
        edges.FloorAB = B.AB.LengthSquared() * new Vector<float>(ParallelSineSquared);
        edges.FloorBC = B.BC.LengthSquared() * new Vector<float>(ParallelSineSquared);
        edges.FloorCA = B.CA.LengthSquared() * new Vector<float>(ParallelSineSquared);
        edges.Test(B, A.A, A.AB, -A.CA, 0);
        edges.Test(B, A.B, A.BC, -A.AB, 1);
        edges.Test(B, A.C, A.CA, -A.BC, 2);
        Choose();
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    void Choose()
    {
        size = Wide.Min(A.GetSize(), B.GetSize());
        var depth = new Vector<float>(float.MaxValue);
        var normal = Vector3Wide.Zero;
        // Of two ways out that are as long, that by the front.
        TryFace(-A.Front, ref depth, ref normal);
        var useB = TryFace(B.Front, ref depth, ref normal);

        var edgeDepth = Wide.CopySign(Vector.SquareRoot(Vector.Abs(edges.Score)), edges.Score);
        var useEdge = Vector.LessThan(edgeDepth + size * new Vector<float>(EdgeTolerance), depth) &
            Vector.LessThan(edges.Score, new Vector<float>(float.MaxValue));
        depth = Wide.Select(useEdge, edgeDepth, depth);
        normal = Vector3Wide.Select(useEdge, Vector3Wide.Normalize(edges.Axis), normal);
        Depth = depth;
        Normal = normal;

        var way = normal * depth;
        var onFace = Vector3Wide.Select(useB, A.GetSupport(-normal), B.GetSupport(normal) - way);
        PointOnA = Vector3Wide.Select(useEdge, edges.GetPlace(A, B, way), onFace);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    readonly Vector<int> TryFace(in Vector3Wide axis, ref Vector<float> depth, ref Vector3Wide normal)
    {
        A.Project(axis, out var leastA, out var greatestA);
        B.Project(axis, out var leastB, out var greatestB);
        var ahead = greatestB - leastA;
        var behind = greatestA - leastB;
        var faceDepth = Wide.Min(ahead, behind);
        var faceNormal = Vector3Wide.Select(Vector.LessThanOrEqual(ahead, behind), axis, -axis);
        var better = Vector.LessThan(faceDepth, depth) & Vector.GreaterThan(axis.LengthSquared(), new Vector<float>(0.5f));
        depth = Wide.Select(better, faceDepth, depth);
        normal = Vector3Wide.Select(better, faceNormal, normal);
        return better;
    }

    /// <summary>The best of the axes across edges so far.</summary>
    struct EdgeSearch
    {
        /// <summary>Depth times its magnitude.</summary>
        public Vector<float> Score;
        /// <summary>The axis from B to A, of any length.</summary>
        public Vector3Wide Axis;
        /// <summary>0, 1 or 2: the edges AB, BC, CA.</summary>
        public Vector<int> IndexA, IndexB;
        /// <summary>Squared lengths of B's edges, times the squared sine of parallel ones.</summary>
        public Vector<float> FloorAB, FloorBC, FloorCA;

        /// <summary>Tests one of A's edges with all of B's.</summary>
        /// <param name="b">Second triangles.</param>
        /// <param name="start">Start of A's edge.</param>
        /// <param name="edge">From there to its end.</param>
        /// <param name="toOpposite">From the start to the opposite corner.</param>
        /// <param name="index">Number of the edge.</param>
        [MethodImpl(MethodImplOptions.NoInlining)]
        public void Test(in PlacedTriangleWide b, in Vector3Wide start, in Vector3Wide edge, in Vector3Wide toOpposite, int index)
        {
            var squared = edge.LengthSquared();
            var score = Score;
            var axis = Axis;
            var indexB = new Vector<int>(-1);
            Try(start, edge, toOpposite, b.A, b.AB, -b.CA, FloorAB * squared, 0, ref score, ref axis, ref indexB);
            Try(start, edge, toOpposite, b.B, b.BC, -b.AB, FloorBC * squared, 1, ref score, ref axis, ref indexB);
            Try(start, edge, toOpposite, b.C, b.CA, -b.BC, FloorCA * squared, 2, ref score, ref axis, ref indexB);
            Score = score;
            Axis = axis;
            var better = Vector.GreaterThanOrEqual(indexB, Vector<int>.Zero);
            IndexA = Wide.Select(better, new Vector<int>(index), IndexA);
            IndexB = Wide.Select(better, indexB, IndexB);
        }

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        static void Try(in Vector3Wide startA, in Vector3Wide edgeA, in Vector3Wide toOppositeA, in Vector3Wide startB, in Vector3Wide edgeB,
            in Vector3Wide toOppositeB, Vector<float> floor, int index, ref Vector<float> best, ref Vector3Wide bestAxis, ref Vector<int> bestIndex)
        {
            var zero = Vector<float>.Zero;
            var axis = Vector3Wide.Cross(edgeA, edgeB);
            var squared = axis.LengthSquared();
            var endA = Vector3Wide.Dot(axis, edgeA);
            var oppositeA = Vector3Wide.Dot(axis, toOppositeA);
            var endB = Vector3Wide.Dot(axis, edgeB);
            var oppositeB = Vector3Wide.Dot(axis, toOppositeB);
            var between = Vector3Wide.Dot(axis, startB - startA);
            var ahead = between + (Wide.Max(Wide.Max(endB, oppositeB), zero) - Wide.Min(Wide.Min(endA, oppositeA), zero));
            var behind = Wide.Max(Wide.Max(endA, oppositeA), zero) - Wide.Min(Wide.Min(endB, oppositeB), zero) - between;
            var scaledDepth = Wide.Min(ahead, behind);
            var score = scaledDepth * Vector.Abs(scaledDepth) / squared;
            var better = Vector.GreaterThan(squared, floor) & Vector.LessThan(score, best);
            best = Wide.Select(better, score, best);
            bestAxis = Vector3Wide.Select(better, Vector3Wide.Select(Vector.LessThan(behind, ahead), -axis, axis), bestAxis);
            bestIndex = Wide.Select(better, new Vector<int>(index), bestIndex);
        }

        /// <summary>Where A's edge passes B's.</summary>
        /// <param name="a">First triangles.</param>
        /// <param name="b">Second triangles.</param>
        /// <param name="way">The normal times the depth.</param>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public readonly Vector3Wide GetPlace(in PlacedTriangleWide a, in PlacedTriangleWide b, in Vector3Wide way)
        {
            var useSecondA = Vector.Equals(IndexA, Vector<int>.One);
            var useThirdA = Vector.GreaterThan(IndexA, Vector<int>.One);
            var start = Vector3Wide.Select(useThirdA, a.C, Vector3Wide.Select(useSecondA, a.B, a.A));
            var edge = Vector3Wide.Select(useThirdA, a.CA, Vector3Wide.Select(useSecondA, a.BC, a.AB));
            var useSecondB = Vector.Equals(IndexB, Vector<int>.One);
            var useThirdB = Vector.GreaterThan(IndexB, Vector<int>.One);
            var startB = Vector3Wide.Select(useThirdB, b.C, Vector3Wide.Select(useSecondB, b.B, b.A));
            var edgeB = Vector3Wide.Select(useThirdB, b.CA, Vector3Wide.Select(useSecondB, b.BC, b.AB));
            var cross = Vector3Wide.Cross(edge, edgeB);
            var place = Vector3Wide.Dot(Vector3Wide.Cross(startB - way - start, edgeB), cross);
            place = Wide.DivideOrZero(place, cross.LengthSquared());
            return start + edge * Wide.Clamp(place, Vector<float>.Zero, Vector<float>.One);
        }
    }

    /// <summary>Replaces the axis where the nearest points show that the triangles are farther apart.</summary>
    /// <param name="mask">All bits set where that is wanted.</param>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public void FindNearest(Vector<int> mask)
    {
        nearest.SquaredDistance = new Vector<float>(float.MaxValue);
        nearest.Offset = nearest.Corner = Vector3Wide.Zero;
        nearest.Visit(A, B.A, B.AB);
        nearest.Visit(A, B.B, B.BC);
        nearest.Visit(A, B.C, B.CA);
        var squaredOnA = nearest.SquaredDistance;
        // From here on from the corners of B to the edges of A.
        nearest.Visit(B, A.A, A.AB);
        nearest.Visit(B, A.B, A.BC);
        nearest.Visit(B, A.C, A.CA);
        var isCornerOfB = Vector.LessThan(nearest.SquaredDistance, squaredOnA);
        var offset = Vector3Wide.Select(isCornerOfB, -nearest.Offset, nearest.Offset);
        var pointOnA = Vector3Wide.Select(isCornerOfB, nearest.Corner - nearest.Offset, nearest.Corner);
        // No axis shows more than the distance, and this one shows less unless the points are the nearest.
        var axis = Vector3Wide.Normalize(offset);
        A.Project(axis, out var least, out _);
        B.Project(axis, out _, out var greatest);
        var depth = greatest - least;
        var better = mask & Vector.LessThan(depth, Depth - size * new Vector<float>(NearestTolerance)) &
            Vector.GreaterThan(axis.LengthSquared(), new Vector<float>(0.5f));
        Depth = Wide.Select(better, depth, Depth);
        Normal = Vector3Wide.Select(better, axis, Normal);
        // Touching at corners, many axes show the same, but not the place.
        var isTouching = mask & Vector.LessThan(Vector.SquareRoot(nearest.SquaredDistance),
            Vector.Abs(Depth) + size * new Vector<float>(TouchTolerance));
        PointOnA = Vector3Wide.Select(better | isTouching, pointOnA, PointOnA);
    }

    /// <summary>The nearest of the corners to the edges so far.</summary>
    struct NearestSearch
    {
        public Vector<float> SquaredDistance;
        /// <summary>From the edge to the corner, and there.</summary>
        public Vector3Wide Offset, Corner;

        /// <summary>Visits one edge and the corners of the other triangle.</summary>
        [MethodImpl(MethodImplOptions.NoInlining)]
        public void Visit(in PlacedTriangleWide corners, in Vector3Wide start, in Vector3Wide edge)
        {
            var inverse = Wide.DivideOrZero(Vector<float>.One, edge.LengthSquared());
            var best = SquaredDistance;
            var offset = Offset;
            var corner = Corner;
            Try(corners.A, start, edge, inverse, ref best, ref offset, ref corner);
            Try(corners.B, start, edge, inverse, ref best, ref offset, ref corner);
            Try(corners.C, start, edge, inverse, ref best, ref offset, ref corner);
            SquaredDistance = best;
            Offset = offset;
            Corner = corner;
        }

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        static void Try(in Vector3Wide corner, in Vector3Wide start, in Vector3Wide edge, Vector<float> inverse,
            ref Vector<float> best, ref Vector3Wide bestOffset, ref Vector3Wide bestCorner)
        {
            var fromStart = corner - start;
            var place = Wide.Clamp(Vector3Wide.Dot(fromStart, edge) * inverse, Vector<float>.Zero, Vector<float>.One);
            var offset = fromStart - edge * place;
            // From an inner point of the edge the way is across it. What is left along it is rounding, which a long edge multiplies.
            var isInner = Vector.GreaterThan(place, Vector<float>.Zero) & Vector.LessThan(place, Vector<float>.One);
            offset -= edge * Wide.Mask(isInner, Vector3Wide.Dot(offset, edge) * inverse);
            var squared = offset.LengthSquared();
            var nearer = Vector.LessThan(squared, best);
            best = Wide.Select(nearer, squared, best);
            bestOffset = Vector3Wide.Select(nearer, offset, bestOffset);
            bestCorner = Vector3Wide.Select(nearer, corner, bestCorner);
        }
    }
}
