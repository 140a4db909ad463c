using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>Finds the corners of the overlap of two features seen along the normal.</summary>
// Of two polygons: of each edge of A's the part that is inside of B's. Its start is a corner of the overlap, and its end is one where it was
// cut off; where it was not, it is the start of the next edge. Then B's vertices that are inside of A's polygon.
// Of a segment and a polygon: the ends of the part of the segment that is inside. Of two segments: the ends of the part of A's that lies
// along B's; segments that cross have none, and touch at the witness.
// Edges that coincide, as those of boxes of one size in a stack do, would be inside or outside by rounding, so the polygon that edges are
// cut by is wider by a border. A vertex that is inside by at most half the border is found as a point of an edge, too, or only so.
unsafe struct FaceOverlap
{
    // Part of the sum of the smaller feature's two extents, and of the size of the larger shape, by which a point outside of a feature still
    // counts as inside. The second is a few roundings of a coordinate.
    public const float BorderTolerance = 5e-6f;
    public const float BorderRounding = 2e-7f;
    /// <summary>
    /// A contact may be where the other of two round segments is this part of the smaller radius to the side, or of the mean of radius and size where
    /// a capsule is the smaller: the surface is farther there by the square of it.
    /// </summary>
    public const float SideDeviation = 0.02f;
    // Segments that are beside each other for less than so many of their deviations cross.
    const float MinimumSegmentLength = 10;

    // Names of corners: an edge of A's, by twos, with its start and its end; the vertices of B's; a segment of B's; the witness.
    const int VertexName = 128;
    const int SegmentName = 192;

    /// <summary>Greatest number of corners of a bundle whose features have at most these numbers of vertices.</summary>
    // A corner takes its place where any lane has it, and polygons that stand on edge are segments: one bundle may have all kinds, the starts and
    // ends of A's edges, B's vertices, and two ends each of segments of A's, of B's and of both.
    public static int GreatestCount(int countA, int countB) => 2 * countA + countB + 6;

    /// <summary>Features of A and B.</summary>
    public FacePolygon A, B;
    /// <summary>Depth of the pair along the normal.</summary>
    public Vector<float> PairDepth;
    /// <summary>Least depth that a contact has.</summary>
    public Vector<float> MinimumDepth;
    /// <summary>Length by which a point outside of a feature still counts as inside.</summary>
    public Vector<float> Border;
    /// <summary>Corners that were found.</summary>
    public FaceCandidate* Candidates;
    /// <summary>Number of corners.</summary>
    public int CandidateCount;

    /// <summary>Finds the corners.</summary>
    /// <param name="near">All bits set where the pair may have contacts.</param>
    /// <param name="aIsDisc">Whether polygons of A are discs.</param>
    /// <param name="bIsDisc">Whether polygons of B are discs.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public void FindCandidates(Vector<int> near, bool aIsDisc, bool bIsDisc)
    {
        CandidateCount = 0;
        Border = Wide.Min(A.Extent, B.Extent) * new Vector<float>(BorderTolerance) +
            Wide.Max(A.Feature.Size, B.Feature.Size) * new Vector<float>(BorderRounding);
        var polygons = near & A.IsPolygon & B.IsPolygon;
        if (!Vector.EqualsAll(polygons, Vector<int>.Zero))
            ClipPolygons(polygons, aIsDisc, bIsDisc);
        var segments = near & A.IsSegment & B.IsPolygon;
        if (!Vector.EqualsAll(segments, Vector<int>.Zero))
            ClipSegment(A, B, bIsDisc, segments, 0);
        segments = near & A.IsPolygon & B.IsSegment;
        if (!Vector.EqualsAll(segments, Vector<int>.Zero))
            ClipSegment(B, A, aIsDisc, segments, SegmentName);
        segments = near & A.IsSegment & B.IsSegment;
        if (!Vector.EqualsAll(segments, Vector<int>.Zero))
            ClipSegments(segments);
    }

    /// <summary>Takes the vertices of A's feature over a plane, which has no border.</summary>
    /// <param name="near">All bits set where the pair may have contacts.</param>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public void TakeAllOfA(Vector<int> near)
    {
        CandidateCount = 0;
        Border = A.Extent * new Vector<float>(BorderTolerance) + A.Feature.Size * new Vector<float>(BorderRounding);
        // Level, as deep as the pair below the witness, and larger than any shape.
        B.Feature.Id = Vector<int>.Zero;
        B.Feature.Size = new Vector<float>(float.MaxValue);
        B.Highest = PairDepth;
        for (int i = 0; i < A.Count; ++i)
        {
            ref var vertex = ref A.Vertices[i];
            var exists = near & A.IsPolygon & Vector.LessThan(new Vector<int>(i), A.Feature.VertexCount);
            Add(vertex.X, vertex.Y, vertex.Height + PairDepth, exists, i);
        }
        var segments = near & A.IsSegment;
        if (Vector.EqualsAll(segments, Vector<int>.Zero))
            return;
        ref var edge = ref A.Vertices[0];
        Add(edge.X, edge.Y, edge.Height + PairDepth, segments, SegmentName);
        Add(edge.X + edge.EdgeX, edge.Y + edge.EdgeY, edge.Height + edge.EdgeHeight + PairDepth, segments, SegmentName + 1);
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    void ClipPolygons(Vector<int> mask, bool aIsDisc, bool bIsDisc)
    {
        var border = Border;
        // An edge that moves less than half the border across another counts as parallel to it.
        var half = border * new Vector<float>(0.5f);
        var needles = bIsDisc ? Vector<int>.Zero : B.Widen(border, mask);
        var anyNeedle = !Vector.EqualsAll(needles, Vector<int>.Zero);
        var verticesB = B.Vertices;
        var endB = verticesB + B.Count;
        if (!aIsDisc)
        {
            for (var vertex = verticesB; vertex != endB; ++vertex)
                vertex->Inside = new Vector<float>(float.MaxValue);
        }
        var countA = A.Count;
        var countB = B.Count;
        for (int i = 0; i < countA; ++i)
        {
            ref var edge = ref A.Vertices[i];
            var line = new EdgeLine(edge);
            if (anyNeedle)
                line.MoveToFoot(edge, needles);
            var start = line.Start;
            var end = line.End;
            if (bIsDisc)
                B.Disc.Clip(line.X, line.Y, edge.EdgeX, edge.EdgeY, border, ref start, ref end);
            else
                ClipToLines(verticesB, endB, line, edge, half, ref start, ref end);
            if (!aIsDisc)
                Measure(verticesB, endB, edge);
            var isInside = mask & Vector.LessThanOrEqual(start, end) & Vector.LessThan(new Vector<int>(i), A.Feature.VertexCount);
            AddOnEdge(edge, line, B, start, isInside, 2 * i);
            AddOnEdge(edge, line, B, end, isInside & Vector.LessThan(end, line.End), 2 * i + 1);
        }
        for (int i = 0; i < countB; ++i)
        {
            ref var vertex = ref verticesB[i];
            var isInside = aIsDisc ? A.Disc.Holds(vertex.X, vertex.Y, half) : Vector.GreaterThan(vertex.Inside, half);
            isInside &= mask & Vector.LessThan(new Vector<int>(i), B.Feature.VertexCount);
            Add(vertex.X, vertex.Y, vertex.Height + A.HeightAt(vertex.X, vertex.Y), isInside, VertexName + i);
        }
    }

    /// <summary>Measures how far vertices are inside of an edge.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void Measure(FaceVertex* vertices, FaceVertex* verticesEnd, in FaceVertex edge)
    {
        var x = edge.LineX;
        var y = edge.LineY;
        var offset = edge.LineOffset;
        for (var vertex = vertices; vertex != verticesEnd; ++vertex)
            vertex->Inside = Wide.Min(x * vertex->X + y * vertex->Y + offset, vertex->Inside);
    }

    /// <summary>Cuts an interval of an edge to what is inside of a polygon.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void ClipToLines(FaceVertex* polygon, FaceVertex* polygonEnd, in EdgeLine line, in FaceVertex edge, Vector<float> half,
        ref Vector<float> start, ref Vector<float> end)
    {
        var x = line.X;
        var y = line.Y;
        var edgeX = edge.EdgeX;
        var edgeY = edge.EdgeY;
        var (first, last) = (start, end);
        for (var vertex = polygon; vertex != polygonEnd; ++vertex)
        {
            Clip(x * vertex->LineX + y * vertex->LineY + vertex->WideLineOffset, edgeX * vertex->LineX + edgeY * vertex->LineY,
                half, ref first, ref last);
        }
        (start, end) = (first, last);
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    void ClipSegment(in FacePolygon segment, in FacePolygon polygon, bool isDisc, Vector<int> mask, int name)
    {
        ref var edge = ref segment.Vertices[0];
        var line = new EdgeLine(edge);
        var start = line.Start;
        var end = line.End;
        if (isDisc)
        {
            polygon.Disc.Clip(line.X, line.Y, edge.EdgeX, edge.EdgeY, Border, ref start, ref end);
        }
        else
        {
            var needles = polygon.Widen(Border, mask);
            if (!Vector.EqualsAll(needles, Vector<int>.Zero))
            {
                line.MoveToFoot(edge, needles);
                (start, end) = (line.Start, line.End);
            }
            ClipToLines(polygon.Vertices, polygon.Vertices + polygon.Count, line, edge, Border * new Vector<float>(0.5f), ref start, ref end);
        }
        var isInside = mask & Vector.LessThanOrEqual(start, end);
        AddOnEdge(edge, line, polygon, start, isInside, name);
        AddOnEdge(edge, line, polygon, end, isInside, name + 1);
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    void ClipSegments(Vector<int> mask)
    {
        ref var a = ref A.Vertices[0];
        ref var b = ref B.Vertices[0];
        var deviation = Wide.Max(Wide.Min(A.Feature.Roundness, B.Feature.Roundness) * new Vector<float>(SideDeviation), Border);
        var half = Border * new Vector<float>(0.5f);
        var start = Vector<float>.Zero;
        var end = Vector<float>.One;
        // Within the deviation of B's line. Of a segment that is a point in this view there is no line.
        var length = Vector.SquareRoot(b.EdgeX * b.EdgeX + b.EdgeY * b.EdgeY);
        var inverse = Wide.DivideOrZero(Vector<float>.One, length);
        var alongX = b.EdgeX * inverse;
        var alongY = b.EdgeY * inverse;
        var x = a.X - b.X;
        var y = a.Y - b.Y;
        var side = alongX * y - alongY * x;
        var sideSpeed = alongX * a.EdgeY - alongY * a.EdgeX;
        Clip(deviation + side, sideSpeed, half, ref start, ref end);
        Clip(deviation - side, -sideSpeed, half, ref start, ref end);
        // And between its ends.
        var place = alongX * x + alongY * y;
        var placeSpeed = alongX * a.EdgeX + alongY * a.EdgeY;
        Clip(Border + place, placeSpeed, half, ref start, ref end);
        Clip(Border + length - place, -placeSpeed, half, ref start, ref end);
        var together = (end - start) * Vector.SquareRoot(a.EdgeX * a.EdgeX + a.EdgeY * a.EdgeY);
        var isInside = mask & Vector.GreaterThan(together, deviation * new Vector<float>(MinimumSegmentLength));
        var line = new EdgeLine(a);
        AddOnEdge(a, line, B, start, isInside, 0);
        AddOnEdge(a, line, B, end, isInside, 1);
    }

    /// <summary>A point of the line of an edge, and where from there the edge starts and ends, in its lengths.</summary>
    // The start of the edge, for it is exact. But a place on the edge of a large face has the rounding of an end that is far away, and between
    // the lines of a needle's corner, which meet at a small angle, the corner of the overlap would be as much farther out. The foot of the witness
    // on the line is near the overlap. What it is rounded to moves the edge a little, but all that is cut off of it is cut off there.
    struct EdgeLine
    {
        public Vector<float> X, Y, Height, Start, End;

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public EdgeLine(in FaceVertex edge)
        {
            X = edge.X;
            Y = edge.Y;
            Height = edge.Height;
            Start = Vector<float>.Zero;
            End = Vector<float>.One;
        }

        /// <summary>Takes the foot of the witness. An edge without a length keeps its start.</summary>
        [MethodImpl(MethodImplOptions.NoInlining)]
        public void MoveToFoot(in FaceVertex edge, Vector<int> mask)
        {
            var along = edge.EdgeX * edge.X + edge.EdgeY * edge.Y;
            var start = Wide.DivideOrZero(along, edge.EdgeX * edge.EdgeX + edge.EdgeY * edge.EdgeY);
            Start = Wide.Select(mask, start, Start);
            End = Wide.Select(mask, Vector<float>.One + start, End);
            X = Wide.Select(mask, edge.X - edge.EdgeX * start, X);
            Y = Wide.Select(mask, edge.Y - edge.EdgeY * start, Y);
            Height = Wide.Select(mask, edge.Height - edge.EdgeHeight * start, Height);
        }
    }

    /// <summary>Cuts an interval of a line to what is inside of a half plane.</summary>
    /// <param name="distance">How far the line's origin is inside.</param>
    /// <param name="speed">How much farther it gets inside until the line's end.</param>
    /// <param name="floor">Least speed that counts; positive.</param>
    /// <param name="start">Start of the interval.</param>
    /// <param name="end">End of the interval.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void Clip(Vector<float> distance, Vector<float> speed, Vector<float> floor, ref Vector<float> start, ref Vector<float> end)
    {
        var leaves = Vector.LessThan(speed, Vector<float>.Zero);
        var divisor = Wide.Select(leaves, Wide.Max(-speed, floor), -Wide.Max(speed, floor));
        var crossing = distance / divisor;
        start = Wide.Max(start, Wide.Select(leaves, start, crossing));
        end = Wide.Min(end, Wide.Select(leaves, crossing, end));
    }

    /// <summary>Adds a point of an edge of one feature that is inside of the other.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    void AddOnEdge(in FaceVertex edge, in EdgeLine line, in FacePolygon other, Vector<float> t, Vector<int> exists, int name)
    {
        var x = line.X + edge.EdgeX * t;
        var y = line.Y + edge.EdgeY * t;
        Add(x, y, line.Height + edge.EdgeHeight * t + other.HeightAt(x, y), exists, name);
    }

    // What no lane has takes no place, and is overwritten by the next.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    void Add(Vector<float> x, Vector<float> y, Vector<float> depth, Vector<int> exists, int name)
    {
        ref var candidate = ref Candidates[CandidateCount];
        exists &= Vector.GreaterThanOrEqual(depth, MinimumDepth);
        candidate.X = x;
        candidate.Y = y;
        candidate.Depth = Wide.Select(exists, Wide.Min(depth, PairDepth), new Vector<float>(IContactCandidate.None));
        candidate.Name = new Vector<int>(name);
        CandidateCount += Vector.EqualsAll(exists, Vector<int>.Zero) ? 0 : 1;
    }
}
