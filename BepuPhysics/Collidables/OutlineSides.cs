using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using BepuPhysics.Trees;

namespace BepuPhysics.Collidables;

/// <summary>What a shape is to a triangle, as far as what it lies in says it.</summary>
enum OutlineSide
{
    /// <summary>Nothing is known.</summary>
    Unknown,
    /// <summary>It is apart from the triangle by more than its margin.</summary>
    IsApart,
    /// <summary>It does not touch the triangle, and what of it is near enough is beyond an edge: that is a neighbour's, if there is one.</summary>
    IsBeyondEdge,
}

/// <summary>Tells which triangles a shape is beside, or in front of: what the box around it meets is often only the box around them.</summary>
/// <remarks>
/// A shape is apart from a triangle if it is beyond one of the planes that stand on its edges, or in front of its own. That is looked at along four
/// directions at once, those of AB, BC and CA and the normal. Next each edge is looked at along a direction that leans from the edge towards the shape's
/// middle: what rolls over one triangle is high above the next where it is over that. And a box is apart from what is beyond one of its faces. Of what is
/// round it is enough that whatever faces the triangle is beyond the edge, if it does not touch the triangle.
/// What is behind a triangle is not left out: it may have been pressed through.
/// <para>
/// Nothing is touched at an edge from beyond the neighbour's normal there (TriangleNeighbours). With n the triangle's normal, o out of the edge, and an angle
/// t by which the surface bends away, the plane of the edge and the neighbour's normal has the normal m = o cos t - n sin t. Of a shape of which no point
/// is both within the margin u of the triangle's height and on the near side of that plane, whatever is near the triangle is the neighbour's. It is so if
/// for some direction g = a o + b n, which is a / cos t m + (b + a tan t) n, with a > 0 and b >= 0, all of the shape is farther along g than the edge by
/// (b + a tan t) u. What is told by this has no contacts once children agree, whatever the test finds, unless nobody has any at a corner of a saddle.
/// </para>
/// </remarks>
readonly struct OutlineSides
{
    // Of what the lengths that a direction and a distance are made of come to: cross products of edges, and a product with a corner, are rounded.
    const float Slack = 1e-5f;
    // Squares below it have lost digits: directions of triangles of some micrometres are not looked along.
    const float LeastSquare = 1e-34f;
    // Of the sizes and distances: five times what counts as near where children agree.
    const float Near = 5e-4f;
    // Of coordinates: by how much places of the shape and of corners may be rounded.
    const float Rounding = 4e-6f;
    // Cosine of the greatest angle to a neighbour.
    const float LeastCosine = .02f;
    const int Edges = 7;

    readonly Lanes center, x, y, z, axis;
    readonly Vector128<float> radius, roundRadius, front, margin, ball, slack;
    // The axes of a box as rows, to its sides; how far along each the nearest point of what is apart is, times its half width.
    readonly Lanes sides;
    readonly Vector128<float> sideLimits, sideLengths;
    readonly bool isBox;

    /// <summary>A vector in each lane.</summary>
    public readonly struct Lanes(Vector128<float> x, Vector128<float> y, Vector128<float> z)
    {
        public readonly Vector128<float> X = x, Y = y, Z = z;

        public Lanes(in Vector3 v) : this(Vector128.Create(v.X), Vector128.Create(v.Y), Vector128.Create(v.Z)) { }

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public Vector128<float> Dot(in Lanes v) => X * v.X + Y * v.Y + Z * v.Z;

        /// <summary>From each vector to the next.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public Lanes ToNext() => new(Next(X) - X, Next(Y) - Y, Next(Z) - Z);

        /// <summary>One of the vectors in all lanes.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public Lanes Spread(int lane) => new(Vector128.Create(X[lane]), Vector128.Create(Y[lane]), Vector128.Create(Z[lane]));

        /// <summary>The greatest number of all, without signs.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public Vector128<float> Greatest()
        {
            var greatest = BoxMath.Max(BoxMath.Max(Vector128.Abs(X), Vector128.Abs(Y)), Vector128.Abs(Z));
            greatest = BoxMath.Max(greatest, Vector128.Shuffle(greatest, Vector128.Create(2, 3, 0, 1)));
            return BoxMath.Max(greatest, Vector128.Shuffle(greatest, Vector128.Create(1, 0, 3, 2)));
        }
    }

    /// <param name="shape">The shape.</param>
    /// <param name="isMirrored">Whether corners are in the other order: A, B and C follow each other counterclockwise seen from the front.</param>
    public OutlineSides(in ShapeOutline shape, bool isMirrored)
    {
        center = new(shape.Center);
        (x, y, z, axis) = (new(shape.X), new(shape.Y), new(shape.Z), new(shape.Axis));
        (radius, roundRadius) = (Vector128.Create(shape.Radius), Vector128.Create(shape.RoundRadius));
        front = Vector128.Create(isMirrored ? -1f : 1);
        isBox = shape.IsBox;
        margin = Vector128.Create(shape.Margin);
        ball = Vector128.Create(shape.Radius - shape.Margin);
        slack = center.Greatest() * Vector128.Create(Rounding) + ball * Vector128.Create(Near);
        if (isBox)
        {
            var (first, second, third) = (shape.X, shape.Y, shape.Z);
            sides = new(
                Vector128.Create(first.X, second.X, third.X, 0), Vector128.Create(first.Y, second.Y, third.Y, 0),
                Vector128.Create(first.Z, second.Z, third.Z, 0));
            var squares = sides.Dot(sides);
            sideLengths = Vector128.Sqrt(squares);
            sideLimits = squares + sideLengths * radius;
        }
    }

    // Of each lane the next.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector128<float> Next(Vector128<float> lanes) => Vector128.Shuffle(lanes, Vector128.Create(1, 2, 3, 0));

    /// <summary>What is known of an edge in each lane, and of the shape beyond it.</summary>
    public struct Beyond
    {
        /// <summary>The edges.</summary>
        public Lanes Edges;
        /// <summary>How far the shape's centre is out of each, m, and above the triangle less the margin, or nothing.</summary>
        public Vector128<float> Beside, Rise;
        /// <summary>By how much the shape is beyond each along the direction that leans, times its length.</summary>
        public Vector128<float> Spare;
        /// <summary>How far the shape reaches to each side of its centre across each, m.</summary>
        public Vector128<float> Reach;
        /// <summary>How far the shape's centre is above the triangle, m.</summary>
        public Vector128<float> Height;
        /// <summary>Of what is round, its unit axis and the way to its end, m, out of each edge, and then along the normal.</summary>
        public Vector128<float> Axis, End;
        /// <summary>What counts as near, m.</summary>
        public Vector128<float> Near;
        /// <summary>Those that may be a neighbour's.</summary>
        public Vector128<float> Lanes;
    }

    /// <summary>Looks at a triangle. Where anything is beyond all numbers, nothing is known.</summary>
    /// <param name="corners">A, B, C and A, in the frame of the outline.</param>
    /// <param name="beyond">What is known of the edges, if the shape may be beyond one.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public OutlineSide Find(in Lanes corners, out Beyond beyond)
    {
        Unsafe.SkipInit(out beyond);
        // AB, BC, CA and nothing; from the corners to the shape.
        var edges = corners.ToNext();
        var ways = new Lanes(center.X - corners.X, center.Y - corners.Y, center.Z - corners.Z);
        var face = Cross(edges.Spread(0), edges.Spread(2));
        var outwards = Cross(face, edges);
        var isFace = Vector128.Create(0, 0, 0, -1).AsSingle();
        var directions = new Lanes(
            Vector128.ConditionalSelect(isFace, face.X * front, outwards.X),
            Vector128.ConditionalSelect(isFace, face.Y * front, outwards.Y),
            Vector128.ConditionalSelect(isFace, face.Z * front, outwards.Z));
        var squared = directions.Dot(directions);
        var lengths = Vector128.Sqrt(squared);
        var reach = ReachAlong(directions, squared);
        var length = edges.Greatest();
        var way = ways.Greatest();
        var rounding = length * length * way * Vector128.Create(Slack);
        rounding = Vector128.ConditionalSelect(isFace, rounding, rounding * length);
        var along = directions.Dot(ways);
        var isLarge = Vector128.GreaterThan(squared, Vector128.Create(LeastSquare));
        var isApart = Vector128.GreaterThan(along, reach + radius * lengths + rounding) & isLarge;
        if (isApart.ExtractMostSignificantBits() != 0)
            return OutlineSide.IsApart;
        if (isLarge.ExtractMostSignificantBits() != 15)
            return OutlineSide.Unknown;

        var inverse = Vector128<float>.One / lengths;
        var unit = new Lanes(directions.X * inverse, directions.Y * inverse, directions.Z * inverse);
        var beside = along * inverse;
        reach *= inverse;
        var height = Vector128.Create(beside[3]);
        if (isBox && height[0] > reach[3] && IsBeyondSide(ways, way))
            return OutlineSide.IsApart;
        var rise = BoxMath.Max(height - margin, Vector128<float>.Zero);
        var leaning = new Lanes(
            unit.X * beside + Vector128.Create(unit.X[3]) * rise, unit.Y * beside + Vector128.Create(unit.Y[3]) * rise,
            unit.Z * beside + Vector128.Create(unit.Z[3]) * rise);
        squared = beside * beside + rise * rise;
        lengths = Vector128.Sqrt(squared);
        var spare = beside * beside + rise * height - ReachAlong(leaning, squared) - ball * lengths;
        var near = slack + (length + way) * Vector128.Create(Near);
        var isBeside = Vector128.GreaterThan(beside, near);
        isApart = isBeside & Vector128.GreaterThan(spare, (margin + (length + way) * Vector128.Create(Slack)) * lengths);
        if ((isApart.ExtractMostSignificantBits() & Edges) != 0)
            return OutlineSide.IsApart;
        reach += ball;
        var isOutside = Vector128.GreaterThan(spare, margin * rise + near * lengths) | Vector128.GreaterThan(beside, reach + near);
        if (!isBox)
        {
            (beyond.Axis, beyond.End) = (unit.Dot(axis), unit.Dot(y));
            isOutside |= Vector128.GreaterThan(beside, Vector128.Abs(beyond.End) + near);
        }
        var isBeyond = isBeside & Vector128.GreaterThan(height, near) & isOutside;
        if ((isBeyond.ExtractMostSignificantBits() & Edges) == 0)
            return OutlineSide.Unknown;
        (beyond.Edges, beyond.Beside, beyond.Rise, beyond.Spare) = (edges, beside, rise, spare);
        (beyond.Reach, beyond.Height, beyond.Near, beyond.Lanes) = (reach, height, near, isBeyond);
        return OutlineSide.IsBeyondEdge;
    }

    // How far what the ball is around reaches along each direction, times its length.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    Vector128<float> ReachAlong(in Lanes directions, Vector128<float> squared)
    {
        var reach = Vector128.Abs(directions.Dot(y));
        if (isBox)
            return reach + Vector128.Abs(directions.Dot(x)) + Vector128.Abs(directions.Dot(z));
        var along = directions.Dot(axis);
        return reach + roundRadius * Vector128.Sqrt(BoxMath.Max(squared - along * along, Vector128<float>.Zero));
    }

    // Whether all corners are beyond one of the faces of a box.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    bool IsBeyondSide(in Lanes ways, Vector128<float> way)
    {
        var (a, b, c) = (sides.Dot(ways.Spread(0)), sides.Dot(ways.Spread(1)), sides.Dot(ways.Spread(2)));
        var limits = sideLimits + sideLengths * way * Vector128.Create(Slack);
        var least = BoxMath.Min(BoxMath.Min(a, b), c);
        var greatest = BoxMath.Max(BoxMath.Max(a, b), c);
        var isBeyond = Vector128.GreaterThan(least, limits) | Vector128.LessThan(greatest, -limits);
        return (isBeyond.ExtractMostSignificantBits() & Edges) != 0;
    }

    /// <summary>Whether all that is near a triangle with one side, whose corners follow each other clockwise seen from the front, is a neighbour's.</summary>
    /// <param name="beyond">What is known of its edges.</param>
    /// <param name="cone">What is next to it.</param>
    public bool IsOfNeighbour(in Beyond beyond, in TriangleCone cone)
    {
        var (cosines, sines) = (cone.Cosines.AsVector128(), cone.Sines.AsVector128());
        var isBound = Vector128.Equals(Vector128.Create(1, 2, 4, 0) & Vector128.Create(cone.FreeMask), Vector128<int>.Zero).AsSingle();
        var (beside, near) = (beyond.Beside, beyond.Near);
        // Both sides times the cosine.
        var along = beyond.Rise * cosines + beside * sines;
        var isOf =
            Vector128.GreaterThan(beyond.Spare * cosines, margin * along + near * (beside + beyond.Rise)) |
            Vector128.GreaterThan((beside - beyond.Reach) * cosines, margin * sines + near);
        // At an obtuse angle what is beyond the edge may be nearest to the other side, unless it is not beyond that.
        ref readonly var edges = ref beyond.Edges;
        var (turnNext, turnPrevious) = (edges.Dot(Following(edges)), edges.Dot(Preceding(edges)));
        var isWithin = Vector128.LessThan(beside + beyond.Reach, -near);
        isOf &= Vector128.LessThanOrEqual(turnNext, Vector128<float>.Zero) | Following(isWithin);
        isOf &= Vector128.LessThanOrEqual(turnPrevious, Vector128<float>.Zero) | Preceding(isWithin);
        var lengths = Vector128.Sqrt(edges.Dot(edges));
        if (!isBox && cone.FreeMask == 0 && Greatest(-cosines)[0] < -LeastCosine)
            isOf |= RollsBeyond(beyond, sines / cosines, turnNext / (lengths * Following(lengths)), turnPrevious);
        isOf &= isBound & beyond.Lanes & Vector128.GreaterThan(cosines, Vector128.Create(LeastCosine));
        // The normals of the other neighbours are not beyond the edge.
        isOf &= Vector128.LessThanOrEqual(cosines * Following(sines) * turnNext, sines * Following(cosines) * lengths * Following(lengths));
        isOf &= Vector128.LessThanOrEqual(cosines * Preceding(sines) * turnPrevious, sines * Preceding(cosines) * lengths * Preceding(lengths));
        return (isOf.ExtractMostSignificantBits() & Edges) != 0;
    }

    // Whether what is round touches nothing of the triangle, and what of it faces the triangle is beyond an edge, along whichever direction the
    // neighbours leave: d = n + a o + b u, with u along the edge. A point p of the shape that is farthest back along it is beyond the edge if
    // (p - e) (o - a n) > 0. The centre is by x - a h, and a is the tangent of the neighbour's angle at most. From the centre to p it is the way to the
    // end of the axis, to either side, and the way down on the disc there. That has R (d c) (c q) / |d - (d c) c| along q = o - a n, with the unit axis
    // c, as d and q are perpendicular: nothing, if the axis lies in the triangle's plane or along the edge. Tangents are bounded by those at the edges
    // over the sine of half the least angle, and a fifth.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    Vector128<float> RollsBeyond(in Beyond beyond, Vector128<float> tangents, Vector128<float> cosines, Vector128<float> turnPrevious)
    {
        const float greatestObtuse = 0.5f, room = 1.2f, greatestLean = 0.9f;
        var steepest = Greatest(tangents);
        var sharpest = Greatest(-cosines);
        var spread = steepest * Vector128.Create(room) * Vector128.Sqrt(Vector128.Create(2f) / (Vector128<float>.One - sharpest));
        var (axisUp, endUp) = (Vector128.Abs(Vector128.Create(beyond.Axis[3])), Vector128.Abs(Vector128.Create(beyond.End[3])));
        var lean = axisUp + spread;
        var isKnown = Vector128.LessThanOrEqual(Greatest(cosines), Vector128.Create(greatestObtuse)) &
            Vector128.LessThan(lean, Vector128.Create(greatestLean));
        var down = roundRadius * lean / Vector128.Sqrt(Vector128<float>.One - lean * lean);
        var low = Vector128.Abs(beyond.End) + spread * endUp + down * (Vector128.Abs(beyond.Axis) + spread * axisUp);
        // At an obtuse angle the bound at the edge is not always one.
        var isAcute = Vector128.LessThanOrEqual(cosines, Vector128<float>.Zero) & Vector128.LessThanOrEqual(turnPrevious, Vector128<float>.Zero);
        var bound = Vector128.ConditionalSelect(isAcute, tangents, spread);
        var (beside, height, near) = (beyond.Beside, beyond.Height, beyond.Near);
        var isBeyond = Vector128.GreaterThan(beside - bound * height, low + near);
        // From the edge to the centre all of the shape is farther than the edge.
        var squared = beside * beside + height * height;
        var end = beside * beyond.End + height * Vector128.Create(beyond.End[3]);
        var across = beside * beyond.Axis + height * Vector128.Create(beyond.Axis[3]);
        var reach = Vector128.Abs(end) + roundRadius * Vector128.Sqrt(BoxMath.Max(squared - across * across, Vector128<float>.Zero));
        var isApart = Vector128.GreaterThan(squared - reach, (ball + near) * Vector128.Sqrt(squared));
        return isKnown & isBeyond & isApart;
    }

    // Of the lanes of edges, in all.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector128<float> Greatest(Vector128<float> lanes)
    {
        var greatest = BoxMath.Max(BoxMath.Max(lanes, Following(lanes)), Preceding(lanes));
        return Vector128.Create(greatest[0]);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector128<float> Following(Vector128<float> lanes) => Vector128.Shuffle(lanes, Vector128.Create(1, 2, 0, 3));

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Lanes Following(in Lanes lanes) => new(Following(lanes.X), Following(lanes.Y), Following(lanes.Z));

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector128<float> Preceding(Vector128<float> lanes) => Vector128.Shuffle(lanes, Vector128.Create(2, 0, 1, 3));

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Lanes Preceding(in Lanes lanes) => new(Preceding(lanes.X), Preceding(lanes.Y), Preceding(lanes.Z));

    /// <summary>The cross products of vectors side by side.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Lanes Cross(in Lanes a, in Lanes b) => new(a.Y * b.Z - a.Z * b.Y, a.Z * b.X - a.X * b.Z, a.X * b.Y - a.Y * b.X);
}
