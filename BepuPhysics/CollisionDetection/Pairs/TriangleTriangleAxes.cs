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
    // Part of the smaller triangle by which the edges of an axis may miss each other where they should cross.
    const float GapTolerance = 1e-4f;
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
    /// <summary>Lanes whose axis is the normal of A's face, and of B's.</summary>
    Vector<int> isFaceOfA, isFaceOfB;
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
        edges.FloorAB = B.AB.LengthSquared() * new Vector<float>(PairTolerances.ParallelTriangleEdge);
        edges.FloorBC = B.BC.LengthSquared() * new Vector<float>(PairTolerances.ParallelTriangleEdge);
        edges.FloorCA = B.CA.LengthSquared() * new Vector<float>(PairTolerances.ParallelTriangleEdge);
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
        var useEdge = Vector.LessThan(edgeDepth + size * new Vector<float>(PairTolerances.EdgeAdvantage), depth) &
            Vector.LessThan(edges.Score, new Vector<float>(float.MaxValue));
        depth = Wide.Select(useEdge, edgeDepth, depth);
        normal = Vector3Wide.Select(useEdge, Vector3Wide.Normalize(edges.Axis), normal);
        isFaceOfA = ~(useEdge | useB);
        isFaceOfB = Vector.AndNot(useB, useEdge);
        Depth = depth;
        Normal = normal;

        var way = normal * depth;
        var onFace = Vector3Wide.Select(useB, A.GetSupport(-normal), B.GetSupport(normal) - way);
        var gap = size * new Vector<float>(GapTolerance);
        PointOnA = Vector3Wide.Select(useEdge, edges.GetPlace(A, B, way, gap * gap, out var mayMiss), onFace);
        mayMiss &= useEdge;
        if (!Vector.EqualsAll(mayMiss, Vector<int>.Zero))
            CheckEdges(mayMiss, way, gap * gap);
    }

    /// <summary>Finds another place where the edges of the axis do not cross.</summary>
    /// <param name="mask">All bits set where they may not.</param>
    /// <param name="way">The normal times the depth.</param>
    /// <param name="limitSquared">Squared distance at which they miss each other.</param>
    [MethodImpl(MethodImplOptions.NoInlining)]
    void CheckEdges(Vector<int> mask, in Vector3Wide way, Vector<float> limitSquared)
    {
        edges.GetPlaceAndGap(A, B, way, out var gapSquared);
        var misses = mask & Vector.GreaterThan(gapSquared, limitSquared);
        if (!Vector.EqualsAll(misses, Vector<int>.Zero))
            FindTouchingPlace(misses, gapSquared);
    }

    /// <summary>Finds where the triangles touch when they are moved apart: over a face, where edges cross, or at a corner and an edge.</summary>
    /// <param name="mask">All bits set where the axis does not tell.</param>
    /// <param name="gapSquared">Squared distance of the triangles there at the place that is known; another one must be nearer.</param>
    // Triangles that barely touch are as deep along many axes, and those of faces and edges elsewhere are among them, within rounding. Edges
    // that are nearly parallel cross at a place that rounding moves far along them, beyond their ends.
    [MethodImpl(MethodImplOptions.NoInlining)]
    void FindTouchingPlace(Vector<int> mask, Vector<float> gapSquared)
    {
        var way = Normal * Depth;
        var movedB = B;
        movedB.A -= way;
        movedB.B -= way;
        movedB.C -= way;
        FindNearestCorner(movedB, out var isCornerOfB);
        var point = Vector3Wide.Select(isCornerOfB, nearest.Corner - nearest.Offset, nearest.Corner);
        var leastSquared = nearest.SquaredDistance;
        TryOverFace(movedB, A, ref leastSquared, ref point);
        TryOverFace(A, movedB, ref leastSquared, ref point);
        var crossing = edges.GetPlaceAndGap(A, B, way, out var crossingSquared);
        point = Vector3Wide.Select(Vector.LessThan(crossingSquared, leastSquared), crossing, point);
        leastSquared = Wide.Min(crossingSquared, leastSquared);
        PointOnA = Vector3Wide.Select(mask & Vector.LessThan(leastSquared, gapSquared), point, PointOnA);
    }

    /// <summary>Takes a corner that is nearer to the face of the other triangle.</summary>
    [MethodImpl(MethodImplOptions.NoInlining)]
    static void TryOverFace(in PlacedTriangleWide face, in PlacedTriangleWide corners, ref Vector<float> leastSquared, ref Vector3Wide point)
    {
        TryOverFace(face, corners.A, ref leastSquared, ref point);
        TryOverFace(face, corners.B, ref leastSquared, ref point);
        TryOverFace(face, corners.C, ref leastSquared, ref point);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void TryOverFace(in PlacedTriangleWide face, in Vector3Wide corner, ref Vector<float> leastSquared, ref Vector3Wide point)
    {
        var distance = Wide.Max(GetDistanceBeyond(face, corner), Vector.Abs(Vector3Wide.Dot(face.Front, corner - face.A)));
        var nearer = Vector.LessThan(distance * distance, leastSquared) & Vector.GreaterThan(face.Front.LengthSquared(), new Vector<float>(0.5f));
        leastSquared = Wide.Select(nearer, distance * distance, leastSquared);
        point = Vector3Wide.Select(nearer, corner, point);
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
        /// <param name="limitSquared">Squared distance at which the lines miss each other.</param>
        /// <param name="mayMiss">
        /// All bits set where the lines miss each other when B is moved back by the way, or cross beyond the end of an edge, if by nothing but
        /// rounding.
        /// </param>
        // start + s edge = startB - way + t edgeB, each side crossed with the other edge; s and t are times the squared length of the cross product.
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public readonly Vector3Wide GetPlace(
            in PlacedTriangleWide a, in PlacedTriangleWide b, in Vector3Wide way, Vector<float> limitSquared, out Vector<int> mayMiss)
        {
            SelectEdges(a, b, out var start, out var edge, out var startB, out var edgeB);
            var cross = Vector3Wide.Cross(edge, edgeB);
            var squared = cross.LengthSquared();
            var fromA = startB - way - start;
            var place = Vector3Wide.Dot(Vector3Wide.Cross(fromA, edgeB), cross);
            var placeB = Vector3Wide.Dot(Vector3Wide.Cross(fromA, edge), cross);
            var apart = Vector3Wide.Dot(fromA, cross);
            mayMiss = Vector.LessThan(Wide.Min(Wide.Min(place, placeB), squared - Wide.Max(place, placeB)), Vector<float>.Zero) |
                Vector.GreaterThan(apart * apart, limitSquared * squared);
            return start + edge * Wide.Clamp(Wide.DivideOrZero(place, squared), Vector<float>.Zero, Vector<float>.One);
        }

        /// <summary>Where A's edge passes B's, and the squared distance from there to B's edge when B is moved back by the way.</summary>
        [MethodImpl(MethodImplOptions.NoInlining)]
        public readonly Vector3Wide GetPlaceAndGap(
            in PlacedTriangleWide a, in PlacedTriangleWide b, in Vector3Wide way, out Vector<float> gapSquared)
        {
            var place = GetPlace(a, b, way, Vector<float>.Zero, out _);
            SelectEdges(a, b, out _, out _, out var startB, out var edgeB);
            var fromB = place - (startB - way);
            var placeB = Wide.DivideOrZero(Vector3Wide.Dot(fromB, edgeB), edgeB.LengthSquared());
            gapSquared = (fromB - edgeB * Wide.Clamp(placeB, Vector<float>.Zero, Vector<float>.One)).LengthSquared();
            return place;
        }

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        readonly void SelectEdges(in PlacedTriangleWide a, in PlacedTriangleWide b,
            out Vector3Wide startA, out Vector3Wide edgeA, out Vector3Wide startB, out Vector3Wide edgeB)
        {
            var useSecondA = Vector.Equals(IndexA, Vector<int>.One);
            var useThirdA = Vector.GreaterThan(IndexA, Vector<int>.One);
            startA = Vector3Wide.Select(useThirdA, a.C, Vector3Wide.Select(useSecondA, a.B, a.A));
            edgeA = Vector3Wide.Select(useThirdA, a.CA, Vector3Wide.Select(useSecondA, a.BC, a.AB));
            var useSecondB = Vector.Equals(IndexB, Vector<int>.One);
            var useThirdB = Vector.GreaterThan(IndexB, Vector<int>.One);
            startB = Vector3Wide.Select(useThirdB, b.C, Vector3Wide.Select(useSecondB, b.B, b.A));
            edgeB = Vector3Wide.Select(useThirdB, b.CA, Vector3Wide.Select(useSecondB, b.BC, b.AB));
        }
    }

    /// <summary>Replaces the axis where the nearest points show that the triangles are farther apart.</summary>
    /// <param name="mask">All bits set where that is wanted.</param>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public void FindNearest(Vector<int> mask)
    {
        FindNearestCorner(B, out var isCornerOfB);
        var offset = Vector3Wide.Select(isCornerOfB, -nearest.Offset, nearest.Offset);
        var pointOnA = Vector3Wide.Select(isCornerOfB, nearest.Corner - nearest.Offset, nearest.Corner);
        // No axis shows more than the distance, and this one shows less unless the points are the nearest.
        var axis = Vector3Wide.Normalize(offset);
        A.Project(axis, out var least, out _);
        B.Project(axis, out _, out var greatest);
        var depth = greatest - least;
        var better = mask & Vector.LessThan(depth, Depth - size * new Vector<float>(PairTolerances.NearestAdvantage)) &
            Vector.GreaterThan(axis.LengthSquared(), new Vector<float>(0.5f));
        Depth = Wide.Select(better, depth, Depth);
        Normal = Vector3Wide.Select(better, axis, Normal);
        // Touching at corners, many axes show the same, but not the place.
        var isTouching = mask & Vector.LessThan(Vector.SquareRoot(nearest.SquaredDistance),
            Vector.Abs(Depth) + size * new Vector<float>(PairTolerances.SamePoints));
        PointOnA = Vector3Wide.Select(better | isTouching, pointOnA, PointOnA);
        var isOnFace = Vector.AndNot(mask & (isFaceOfA | isFaceOfB), better | isTouching);
        if (!Vector.EqualsAll(isOnFace, Vector<int>.Zero))
            CheckFace(isOnFace);
    }

    /// <summary>Finds another place where the corner that is farthest along a face's normal is not over the face.</summary>
    /// <param name="mask">All bits set where the axis is the normal of a face.</param>
    [MethodImpl(MethodImplOptions.NoInlining)]
    void CheckFace(Vector<int> mask)
    {
        var corner = Vector3Wide.Select(isFaceOfB, PointOnA + Normal * Depth, PointOnA);
        var beyond = Wide.Select(isFaceOfB, GetDistanceBeyond(B, corner), GetDistanceBeyond(A, corner));
        var misses = mask & Vector.GreaterThan(beyond, size * new Vector<float>(GapTolerance));
        if (!Vector.EqualsAll(misses, Vector<int>.Zero))
            FindTouchingPlace(misses, beyond * beyond);
    }

    /// <summary>How far a point is outside of the edge of a triangle that it is farthest outside of.</summary>
    // Seen from the front the corners run clockwise, and the edges have their outside to the left.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<float> GetDistanceBeyond(in PlacedTriangleWide triangle, in Vector3Wide point)
    {
        var beyond = GetDistanceBeyond(triangle.Front, triangle.AB, point - triangle.A);
        beyond = Wide.Max(beyond, GetDistanceBeyond(triangle.Front, triangle.BC, point - triangle.B));
        return Wide.Max(beyond, GetDistanceBeyond(triangle.Front, triangle.CA, point - triangle.C));
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<float> GetDistanceBeyond(in Vector3Wide front, in Vector3Wide edge, in Vector3Wide fromStart)
    {
        var across = Vector3Wide.Cross(front, edge);
        return Wide.DivideOrZero(Vector3Wide.Dot(across, fromStart), Vector.SquareRoot(across.LengthSquared()));
    }

    /// <summary>Finds the corner of one of the triangles that is nearest to an edge of the other.</summary>
    /// <param name="b">Second triangles.</param>
    /// <param name="isCornerOfB">All bits set where it is a corner of theirs.</param>
    [MethodImpl(MethodImplOptions.NoInlining)]
    void FindNearestCorner(in PlacedTriangleWide b, out Vector<int> isCornerOfB)
    {
        nearest.SquaredDistance = new Vector<float>(float.MaxValue);
        nearest.Offset = nearest.Corner = Vector3Wide.Zero;
        nearest.Visit(A, b.A, b.AB);
        nearest.Visit(A, b.B, b.BC);
        nearest.Visit(A, b.C, b.CA);
        var squaredOnA = nearest.SquaredDistance;
        // From here on from the corners of B to the edges of A.
        nearest.Visit(b, A.A, A.AB);
        nearest.Visit(b, A.B, A.BC);
        nearest.Visit(b, A.C, A.CA);
        isCornerOfB = Vector.LessThan(nearest.SquaredDistance, squaredOnA);
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
