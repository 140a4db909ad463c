using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>A vertex of a feature seen along the normal, and the edge to the next.</summary>
struct FaceVertex
{
    /// <summary>Place across the normal, from the witness, m.</summary>
    public Vector<float> X, Y;
    /// <summary>Height of the surface over the witness of A, along the direction out of its own shape, m.</summary>
    public Vector<float> Height;
    /// <summary>From here to the next vertex.</summary>
    public Vector<float> EdgeX, EdgeY, EdgeHeight;
    /// <summary>A point is this far inside of the edge: LineX x + LineY y + LineOffset, in m. An edge without a length has all inside.</summary>
    public Vector<float> LineX, LineY, LineOffset;
    /// <summary><see cref="LineOffset"/> of a polygon that is wider by a border.</summary>
    public Vector<float> WideLineOffset;
    /// <summary>How far the vertex is inside of the other polygon, m.</summary>
    public Vector<float> Inside;
}

/// <summary>Where the vertices of a bundle of features are.</summary>
// As large as a vector, so that what follows it in memory is aligned as what is before it.
[StructLayout(LayoutKind.Explicit)]
unsafe struct FaceVertexList
{
    /// <summary>Fills the struct up.</summary>
    [FieldOffset(0)]
    public Vector<int> Padding;
    /// <summary>First vertices.</summary>
    [FieldOffset(0)]
    public FaceVertex* First;
    /// <summary>Greatest number of vertices in the bundle.</summary>
    [FieldOffset(8)]
    public int Count;
}

/// <summary>A frame in that features are seen along the normal, in the coordinates of one of the two shapes.</summary>
struct FaceFrame
{
    /// <summary>Axes across the normal. These two and the normal from B to A are right-handed.</summary>
    public Vector3Wide X, Y;
    /// <summary>Direction out of the shape, along the normal.</summary>
    public Vector3Wide Outwards;
    /// <summary>Witness on A's surface.</summary>
    public Vector3Wide Origin;
}

/// <summary>The features of a bundle of shapes, seen along the normal.</summary>
/// <remarks>
/// <para>
/// What is left of a shape once the normal is known: a convex polygon, or a segment, in the plane across the normal, with the height of its own plane
/// over each place (<see cref="HeightAt"/>). The depth of a contact is then a sum of two heights, and clipping (<see cref="FaceOverlap"/>,
/// after Sutherland and Hodgman) needs two coordinates and a line for each edge: how far inside of it a point is.
/// </para>
/// <para>
/// <see cref="Project"/> makes it, from the shape's vertices; a plane that is nearly along the normal has no height that could be trusted, and is
/// replaced by its highest edge. <see cref="Widen"/> then moves edges out by a border, so that features whose edges coincide overlap whatever
/// rounding says. Invariants: vertices run counter-clockwise in the frame of either shape; beyond its own count a lane repeats its first vertex, whose
/// edges have no length and hold everything; a disc is a circle to what it cuts and a polygon of sixteen corners to what names contacts.
/// </para>
/// </remarks>
unsafe partial struct FacePolygon
{
    // Cosine of the angle of a plane to the normal below which its slope says more about rounding than about the surface: at this one,
    // of 87 degrees, the tolerance of a border becomes that of a depth.
    const float SteepCosine = 0.05f;
    // Twice the squared sine of half the angle of a corner that is sharp.
    const float SharpBluntness = 0.25f;
    // The same of a corner of some 8 degrees, where rounding across its edges is 14 times as much along them.
    const float NeedleBluntness = 0.01f;
    // Distance inside of an edge that is none.
    const float Everything = 1e30f;

    /// <summary>Vertices; those of a lane repeat from its count on.</summary>
    public FaceVertexList List;
    /// <summary>What the shape said of its feature; a steep polygon has become a segment.</summary>
    public ContactFeatureWide Feature;
    /// <summary>Height of the feature's plane: SlopeX x + SlopeY y + SlopeHeight.</summary>
    public Vector<float> SlopeX, SlopeY, SlopeHeight;
    /// <summary>Greatest distance of a vertex from the first, its two parts added, m.</summary>
    public Vector<float> Extent;
    /// <summary>Height of the highest vertex, m.</summary>
    public Vector<float> Highest;
    /// <summary>All bits set where the feature is a polygon or a segment that is not steep.</summary>
    public Vector<int> IsPolygon, IsSegment;
    /// <summary>Of features whose polygons are discs.</summary>
    public FaceDisc Disc;

    /// <summary>First vertices.</summary>
    public readonly FaceVertex* Vertices
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => List.First;
    }

    /// <summary>Greatest number of vertices in the bundle.</summary>
    public readonly int Count
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => List.Count;
    }

    /// <summary>Height of the feature's plane at a place.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly Vector<float> HeightAt(Vector<float> x, Vector<float> y) => SlopeX * x + SlopeY * y + SlopeHeight;

    /// <summary>Projects the vertices of a feature.</summary>
    /// <param name="points">Vertices in the shape's frame.</param>
    /// <param name="frame">Frame to project to.</param>
    /// <param name="winding">1 where counter-clockwise seen from outside is counter-clockwise in the frame as well, else -1.</param>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public void Project(Vector3Wide* points, in FaceFrame frame, float winding)
    {
        var vertices = Vertices;
        var margin = Feature.Margin;
        var sign = new Vector<float>(winding);
        var extent = Vector<float>.Zero;
        var highest = new Vector<float>(-float.MaxValue);
        var point = points[0];
        var count = Count;
        for (int i = 0; i < count; ++i)
        {
            var next = points[i + 1 < count ? i + 1 : 0];
            ref var vertex = ref vertices[i];
            var offset = point - frame.Origin;
            vertex.X = Vector3Wide.Dot(offset, frame.X);
            vertex.Y = Vector3Wide.Dot(offset, frame.Y);
            vertex.Height = Vector3Wide.Dot(offset, frame.Outwards) + margin;
            highest = Wide.Max(vertex.Height, highest);
            // Not the difference of the projections: short edges of large faces keep their directions.
            var edge = next - point;
            var edgeX = Vector3Wide.Dot(edge, frame.X);
            var edgeY = Vector3Wide.Dot(edge, frame.Y);
            vertex.EdgeX = edgeX;
            vertex.EdgeY = edgeY;
            vertex.EdgeHeight = Vector3Wide.Dot(edge, frame.Outwards);
            var lengthSquared = edgeX * edgeX + edgeY * edgeY;
            var inverse = Wide.DivideOrZero(sign, Vector.SquareRoot(lengthSquared));
            vertex.LineX = -edgeY * inverse;
            vertex.LineY = edgeX * inverse;
            vertex.LineOffset = Wide.Select(Vector.Equals(inverse, Vector<float>.Zero), new Vector<float>(Everything),
                -(vertex.LineX * vertex.X + vertex.LineY * vertex.Y));
            extent = Wide.Max(Vector.Abs(vertex.X - vertices[0].X) + Vector.Abs(vertex.Y - vertices[0].Y), extent);
            point = next;
        }
        Extent = extent;
        Highest = highest;
        FindSlope(points[0] - frame.Origin, frame);
    }

    /// <summary>Makes the polygon wider by a border.</summary>
    /// <param name="border">Length to add on all sides.</param>
    /// <param name="mask">Lanes that matter.</param>
    /// <returns>All bits set where one of these has the corner of a needle.</returns>
    // Edges that are each moved out by a border meet farther beyond their corner; a thousand borders at the tip of a needle. The edges of a
    // corner below 41 degrees get so much less that they meet no more than 2.8 borders beyond it. Edges without a length make no corner.
    [MethodImpl(MethodImplOptions.NoInlining)]
    public readonly Vector<int> Widen(Vector<float> border, Vector<int> mask)
    {
        var vertices = Vertices;
        var lastX = Vector<float>.Zero;
        var lastY = Vector<float>.Zero;
        for (int i = 0; i < Count; ++i)
            Follow(vertices[i], ref lastX, ref lastY);
        var x = lastX;
        var y = lastY;
        var least = Vector<float>.One;
        for (int i = 0; i < Count; ++i)
        {
            ref var vertex = ref vertices[i];
            vertex.WideLineOffset = vertex.LineOffset + border;
            least = Wide.Min(least, Bluntness(vertex, x, y));
            Follow(vertex, ref x, ref y);
        }
        var sharp = mask & Vector.LessThan(least, new Vector<float>(SharpBluntness));
        if (!Vector.EqualsAll(sharp, Vector<int>.Zero))
            WidenSharp(border, lastX, lastY);
        var needle = mask & Vector.LessThan(least, new Vector<float>(NeedleBluntness));
        if (!Vector.EqualsAll(needle, Vector<int>.Zero))
            TakeNearerEnds(needle);
        return needle;
    }

    // What an end of an edge that is far away is rounded to counts as much at the corner of a needle as the border would, so the line is taken
    // from the end that is nearer to the witness.
    [MethodImpl(MethodImplOptions.NoInlining)]
    readonly void TakeNearerEnds(Vector<int> needle)
    {
        for (int i = 0; i < Count; ++i)
        {
            ref var vertex = ref Vertices[i];
            ref var end = ref Vertices[i + 1 < Count ? i + 1 : 0];
            var useEnd = needle & Vector.LessThan(end.X * end.X + end.Y * end.Y, vertex.X * vertex.X + vertex.Y * vertex.Y) &
                Vector.LessThan(vertex.LineOffset, new Vector<float>(Everything));
            var change = -(vertex.LineX * end.X + vertex.LineY * end.Y) - vertex.LineOffset;
            vertex.WideLineOffset = Wide.Select(useEnd, vertex.WideLineOffset + change, vertex.WideLineOffset);
        }
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    readonly void WidenSharp(Vector<float> border, Vector<float> lastX, Vector<float> lastY)
    {
        var vertices = Vertices;
        for (int i = 0; i < Count; ++i)
        {
            ref var vertex = ref vertices[i];
            vertex.WideLineOffset = Bluntness(vertex, lastX, lastY);
            Follow(vertex, ref lastX, ref lastY);
        }
        var nextX = Vector<float>.Zero;
        var nextY = Vector<float>.Zero;
        for (int i = Count - 1; i >= 0; --i)
            Follow(vertices[i], ref nextX, ref nextY);
        for (int i = Count - 1; i >= 0; --i)
        {
            ref var vertex = ref vertices[i];
            var bluntness = Wide.Min(vertex.WideLineOffset, Bluntness(vertex, nextX, nextY));
            var share = Vector.SquareRoot(Wide.Clamp(bluntness * new Vector<float>(1 / SharpBluntness), Vector<float>.Zero, Vector<float>.One));
            vertex.WideLineOffset = vertex.LineOffset + border * share;
            Follow(vertex, ref nextX, ref nextY);
        }
    }

    /// <summary>Twice the squared sine of half the angle of the corner between two edges, at most 1.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<float> Bluntness(in FaceVertex vertex, Vector<float> otherX, Vector<float> otherY) =>
        Vector<float>.One + Wide.Min(vertex.LineX * otherX + vertex.LineY * otherY, Vector<float>.Zero);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void Follow(in FaceVertex vertex, ref Vector<float> x, ref Vector<float> y)
    {
        var hasLength = Vector.LessThan(vertex.LineOffset, new Vector<float>(Everything));
        x = Wide.Select(hasLength, vertex.LineX, x);
        y = Wide.Select(hasLength, vertex.LineY, y);
    }

    // Where p is a point of the plane N . (q - p) = 0, seen from the origin of the frame, and a place has the coordinates x, y and the height h,
    // N . (X x + Y y + O h - p) = 0. So h over the origin is N . p / N . O, without the place of p in the frame: a corner of a large face is far
    // away, and the axes are at right angles but for rounding, which would become 1e-7 of that distance.
    [MethodImpl(MethodImplOptions.NoInlining)]
    void FindSlope(in Vector3Wide point, in FaceFrame frame)
    {
        var along = Vector3Wide.Dot(Feature.PlaneNormal, frame.Outwards);
        var acrossX = Vector3Wide.Dot(Feature.PlaneNormal, frame.X);
        var acrossY = Vector3Wide.Dot(Feature.PlaneNormal, frame.Y);
        var isSteep = IsSteep(along, acrossX * acrossX + acrossY * acrossY);
        var isSegment = Vector.Equals(Feature.VertexCount, new Vector<int>(2));
        var isPolygon = Vector.GreaterThan(Feature.VertexCount, new Vector<int>(2));
        var inverse = Vector<float>.One / along;
        SlopeX = -acrossX * inverse;
        SlopeY = -acrossY * inverse;
        SlopeHeight = Vector3Wide.Dot(Feature.PlaneNormal, point) * inverse + Feature.Margin;
        // A polygon that is one point has no edge to be outside of.
        IsPolygon = Vector.AndNot(isPolygon, isSteep) & Vector.GreaterThan(Extent, Vector<float>.Zero);
        IsSegment = Vector.AndNot(isSegment, isSteep);
        var becomesSegment = isPolygon & isSteep;
        if (!Vector.EqualsAll(becomesSegment, Vector<int>.Zero))
            KeepHighestEdge(becomesSegment);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<int> IsSteep(Vector<float> along, Vector<float> acrossSquared)
    {
        var limit = new Vector<float>(SteepCosine * SteepCosine);
        return Vector.LessThanOrEqual(along, Vector<float>.Zero) |
            Vector.LessThan(along * along, (along * along + acrossSquared) * limit);
    }

    /// <summary>Makes a segment of a polygon that stands on edge: that of its edges whose ends are highest together.</summary>
    [MethodImpl(MethodImplOptions.NoInlining)]
    void KeepHighestEdge(Vector<int> becomesSegment)
    {
        var score = new Vector<float>(-float.MaxValue);
        var best = Vertices[0];
        for (int i = 0; i < Count; ++i)
        {
            ref var vertex = ref Vertices[i];
            var height = vertex.Height + vertex.Height + vertex.EdgeHeight;
            var hasLength = Vector.LessThan(vertex.LineOffset, new Vector<float>(Everything));
            var better = hasLength & Vector.GreaterThan(height, score);
            score = Wide.Select(better, height, score);
            Select(better, vertex, ref best);
        }
        ref var first = ref Vertices[0];
        Select(becomesSegment, best, ref first);
        Feature.VertexCount = Wide.Select(becomesSegment, new Vector<int>(2), Feature.VertexCount);
        // Along the segment as high as it is, across it level.
        var lengthSquared = first.EdgeX * first.EdgeX + first.EdgeY * first.EdgeY;
        var slope = Wide.DivideOrZero(first.EdgeHeight, lengthSquared);
        SlopeX = Wide.Select(becomesSegment, first.EdgeX * slope, SlopeX);
        SlopeY = Wide.Select(becomesSegment, first.EdgeY * slope, SlopeY);
        SlopeHeight = Wide.Select(becomesSegment, first.Height - (SlopeX * first.X + SlopeY * first.Y), SlopeHeight);
        var isSteep = IsSteep(Vector.SquareRoot(lengthSquared), first.EdgeHeight * first.EdgeHeight);
        IsSegment |= Vector.AndNot(becomesSegment, isSteep);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void Select(Vector<int> mask, in FaceVertex source, ref FaceVertex target)
    {
        target.X = Wide.Select(mask, source.X, target.X);
        target.Y = Wide.Select(mask, source.Y, target.Y);
        target.Height = Wide.Select(mask, source.Height, target.Height);
        target.EdgeX = Wide.Select(mask, source.EdgeX, target.EdgeX);
        target.EdgeY = Wide.Select(mask, source.EdgeY, target.EdgeY);
        target.EdgeHeight = Wide.Select(mask, source.EdgeHeight, target.EdgeHeight);
    }
}
