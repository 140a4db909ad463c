using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;

namespace BepuPhysics.Collidables;

/// <summary>What a ball is to a triangle of a surface, as far as it is known without a test.</summary>
enum BallSide
{
    /// <summary>Nothing is known.</summary>
    Unknown,
    /// <summary>It touches the triangle, or is within its margin, and from where no neighbour is in the way.</summary>
    Touches,
    /// <summary>Whatever it touches of the triangle it touches beyond a neighbour: that has it.</summary>
    IsOfNeighbour,
}

/// <summary>Tells which triangles of a surface a ball touches beyond a neighbour only: of those that it would touch as if they were alone, most.</summary>
/// <remarks>
/// What touches the edge of a triangle and its neighbour is between the normals of the two. A centre that is beyond the plane of the edge and the neighbour's
/// normal, and to which nothing of the triangle is nearer than that edge or an end of it, is the neighbour's. Outside of an edge nothing else is nearer, but
/// where the angle at an end is obtuse: beyond a plane across the other side there. Tests of directions come to the same (TriangleNeighbours), for each of
/// those that they choose from; all lengths here have room for what they count as near.
/// </remarks>
readonly struct BallSides
{
    // Of the sizes and distances: five times what those tests count as near.
    const float Near = 5e-4f;
    // Of coordinates: by how much places of the ball and of corners may be rounded.
    const float Rounding = 4e-6f;
    // Cosine of the greatest angle to a neighbour.
    const float LeastCosine = .02f;
    // Squares below it have lost digits.
    const float LeastSquare = 1e-34f;
    const int Edges = 7;

    readonly OutlineSides.Lanes center;
    readonly Vector128<float> radius, slack;

    public BallSides(in ShapeOutline ball)
    {
        center = new(ball.Center);
        radius = Vector128.Create(ball.Radius);
        slack = radius * Vector128.Create(Near) + center.Greatest() * Vector128.Create(Rounding);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector128<float> Next(Vector128<float> lanes) => Vector128.Shuffle(lanes, Vector128.Create(1, 2, 0, 3));

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector128<float> Previous(Vector128<float> lanes) => Vector128.Shuffle(lanes, Vector128.Create(2, 0, 1, 3));

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector128<float> IsLess(Vector128<float> a, Vector128<float> b) => Vector128.LessThan(a, b);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static bool HasAny(Vector128<float> mask) => (mask.ExtractMostSignificantBits() & Edges) != 0;

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static bool HasAll(Vector128<float> mask) => (mask.ExtractMostSignificantBits() & Edges) == Edges;

    /// <summary>Looks at a triangle with one side, whose corners follow each other clockwise seen from the front.</summary>
    /// <param name="corners">A, B, C and A, in the frame of the outline.</param>
    /// <param name="cone">What is next to it.</param>
    // A lane is an edge: AB, BC and CA. Where anything is beyond all numbers, nothing is known.
    public BallSide Find(in OutlineSides.Lanes corners, in TriangleCone cone)
    {
        var edges = corners.ToNext();
        var ways = new OutlineSides.Lanes(center.X - corners.X, center.Y - corners.Y, center.Z - corners.Z);
        var face = OutlineSides.Cross(edges.Spread(0), edges.Spread(2));
        var across = OutlineSides.Cross(face, edges);
        var acrossSquared = across.Dot(across);
        if (!HasAll(IsLess(Vector128.Create(LeastSquare), acrossSquared)))
            return BallSide.Unknown;
        var height = face.Dot(ways) / Vector128.Sqrt(face.Dot(face));
        var beside = across.Dot(ways) / Vector128.Sqrt(acrossSquared);
        var length = edges.Greatest();
        var near = slack + (length + ways.Greatest()) * Vector128.Create(Near);
        var isInFront = IsLess(near, height);
        if (!HasAll(isInFront))
            return BallSide.Unknown;
        var (cosines, sines) = (cone.Cosines.AsVector128(), cone.Sines.AsVector128());
        var isBound = Vector128.Equals(Vector128.Create(1, 2, 4, 0) & Vector128.Create(cone.FreeMask), Vector128<int>.Zero).AsSingle();
        var beyond = beside * cosines - height * sines;
        var nearAlong = near * length;
        // From the end of each edge to the centre.
        var ends = new OutlineSides.Lanes(Next(ways.X), Next(ways.Y), Next(ways.Z));
        if (IsTouched(edges, ways, ends, height, beside, near, nearAlong, ~(isBound & IsLess(-near, beyond))))
            return BallSide.Touches;
        var isBeyond = isBound & IsLess(near, beyond) & IsLess(near, beside) & IsLess(Vector128.Create(LeastCosine), cosines);
        if (!HasAny(isBeyond))
            return BallSide.Unknown;
        var next = new OutlineSides.Lanes(Next(edges.X), Next(edges.Y), Next(edges.Z));
        var previous = new OutlineSides.Lanes(Previous(edges.X), Previous(edges.Y), Previous(edges.Z));
        var lengths = Vector128.Sqrt(edges.Dot(edges));
        var (turnNext, turnPrevious) = (edges.Dot(next), edges.Dot(previous));
        // At an obtuse angle.
        isBeyond &= ~IsLess(Vector128<float>.Zero, turnNext) | IsLess(ends.Dot(next), -nearAlong);
        isBeyond &= ~IsLess(Vector128<float>.Zero, turnPrevious) | IsLess(nearAlong, ways.Dot(previous));
        // The normals of the other neighbours are not beyond the edge.
        isBeyond &= Vector128.LessThanOrEqual(cosines * Next(sines) * turnNext, sines * Next(cosines) * lengths * Next(lengths));
        isBeyond &= Vector128.LessThanOrEqual(cosines * Previous(sines) * turnPrevious, sines * Previous(cosines) * lengths * Previous(lengths));
        return HasAny(isBeyond) ? BallSide.IsOfNeighbour : BallSide.Unknown;
    }

    // The centre is over the face, or beside an inner part of an edge and not beyond its neighbour.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    bool IsTouched(in OutlineSides.Lanes edges, in OutlineSides.Lanes ways, in OutlineSides.Lanes ends, Vector128<float> height,
        Vector128<float> beside, Vector128<float> near, Vector128<float> nearAlong, Vector128<float> isNotBeyond)
    {
        var reach = radius - near;
        if (HasAll(IsLess(beside, -near)))
            return HasAll(IsLess(height, reach));
        var isBesideEdge = IsLess(near, beside) & IsLess(nearAlong, ways.Dot(edges)) & IsLess(ends.Dot(edges), -nearAlong);
        var isNear = IsLess(Vector128<float>.Zero, reach) & IsLess(beside * beside + height * height, reach * reach);
        return HasAny(isBesideEdge & isNear & isNotBeyond);
    }
}
