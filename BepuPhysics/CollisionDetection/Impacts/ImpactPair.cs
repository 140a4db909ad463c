using System;

namespace BepuPhysics.CollisionDetection;

/// <summary>Two convex shapes that move: when they first touch, by conservative advancement.</summary>
/// <remarks>
/// <para>At a time, GJK finds a plane between the cores, across a direction n, and how wide the gap along n is at least. As long as
/// neither shape can have crossed that gap they are apart; so the time goes on by that much, and again, until the gap is as small as what
/// counts as touching. The time is never later than the true one. Where nothing turns a round is a step of Newton's method, on a distance
/// that is convex in time: from below, doubling the digits.
/// </para>
/// <para>How far a shape can come along n is bounded three ways, and the best counts: by the speeds of its points now and how they
/// change; by what its turn makes of it, whatever the angle; and by where it reaches at a later time, since a support function is convex:
/// between two directions it is at most what a chord says and a part for their angle (<see cref="TryLater"/>).</para>
/// <para>Everything is in double precision and in world axes, from the position of A's body at the time zero. A pair is on its own, so
/// results depend on nothing but the pair.</para>
/// </remarks>
ref partial struct ImpactPair
{
    // Distance at which shapes count as touching, by the size of the smaller one, and by all lengths there are, for rounding.
    internal const double TouchingPart = 1e-5;
    const double RoundingPart = 4e-12;
    // What overlap is told by: beyond rounding, by all lengths there are.
    const double OverlapPart = 1e-12;
    // A plane is good enough to go by when it leaves this part of the distance.
    const double GapPart = 0.75;
    // Part of the distance that counts as touching by which a plane may leave less than that at a hit: 1e-6 of the size, of which the
    // root of the double bounds the error of the normal.
    const double NormalPart = 0.1;
    // A direction that leaves the front of a triangle by less is on the front: what contacts count as well.
    const double BackSlack = 1e-4;
    const int MaximumSupports = 256;
    // A turn and a little, rad: what only turns is then where it was.
    const double WholeTurn = 6.2832;

    ref ImpactBody a;
    ref ImpactBody b;
    readonly DoubleVector3 offsetB, linear;
    // A's body at the present time.
    DoubleVector3 centerA;
    readonly double margins, rounding;
    ImpactSimplex simplex;

    // The plane: unit direction from A to B, and the width of the gap between the surfaces along it. And the distance of two points of
    // theirs.
    DoubleVector3 normal;
    double gap, distance;

    ImpactPair(ref ImpactBody a, ref ImpactBody b, in DoubleVector3 offsetB, in DoubleVector3 linear)
    {
        this.a = ref a;
        this.b = ref b;
        this.offsetB = offsetB;
        this.linear = linear;
        margins = a.Core.Margin + b.Core.Margin;
        rounding = a.Reach + offsetB.Length + (b.Core.IsPlane ? 0 : b.Reach) + margins;
    }

    /// <summary>Finds when two shapes first touch.</summary>
    /// <param name="a">First shape.</param>
    /// <param name="b">Second shape; a half-space must be this one.</param>
    /// <param name="offsetB">Position of B's body less that of A's at the time zero, m.</param>
    /// <param name="linear">Velocity of A's body less that of B's, m/s.</param>
    /// <param name="maximumT">Length of the time that is of interest, s.</param>
    /// <param name="accuracy">How exactly.</param>
    /// <param name="impact">The impact.</param>
    /// <returns>Whether they touch in that time.</returns>
    public static bool Find(ref ImpactBody a, ref ImpactBody b, in DoubleVector3 offsetB, in DoubleVector3 linear, double maximumT,
        in ImpactAccuracy accuracy, out Impact impact)
    {
        var pair = new ImpactPair(ref a, ref b, offsetB, linear);
        return pair.Advance(maximumT, accuracy, out impact);
    }

    bool Advance(double maximumT, in ImpactAccuracy accuracy, out Impact impact)
    {
        impact = default;
        var start = b.Core.IsPlane ? 0 : ImpactBalls.FirstMeeting(
            offsetB + b.BallCenter - a.BallCenter, linear, a.BallRadius + b.BallRadius + accuracy.TouchingDistance);
        if (!(start <= maximumT))
            return false;
        Begin(start);
        // For rounding of places that are far apart, beside shapes that are tiny, balls that are apart may hold shapes that are not.
        if (start > 0 && !Separate(rounding * OverlapPart))
        {
            start = 0;
            Begin(start);
        }
        if (start == 0 && !Separate(rounding * OverlapPart))
        {
            impact.Overlaps = true;
            return IsInFront();
        }
        var touching = Math.Max(
            Math.Max(Math.Min(a.Core.Size, b.Core.Size) * TouchingPart, accuracy.TouchingDistance), WayIn(accuracy.ConvergenceThreshold));
        // What touches as good as it starts has an impact only if it comes nearer still: what leaves, or slides along, has none.
        touching = Math.Max(Math.Min(touching, gap * 0.5), rounding * RoundingPart);
        if (DoubleVector3.Dot(linear, linear) == 0 && a.Turns != b.Turns)
            maximumT = Math.Min(maximumT, WholeTurn / Math.Max(a.Speed, b.Speed));
        double t = start, lastT = start;
        for (int round = 0; round < accuracy.MaximumRoundCount; ++round)
        {
            ++impact.RoundCount;
            if (round > 0)
            {
                Place(t);
                if (!Separate(touching))
                    return Touch(t, lastT, touching, ref impact);
            }
            var dt = Math.Max(LongestSafe(Math.Max(gap - touching * 0.5, gap * 0.5), round, maximumT - t), accuracy.MinimumProgression);
            lastT = t;
            t += dt;
            if (!(t <= maximumT))
                return false;
        }
        impact.RanOut = true;
        return false;
    }

    // How far the greatest speed goes in a time that may be infinite.
    readonly double WayIn(double time)
    {
        var speed = linear.Length + a.SurfaceSpeed + b.SurfaceSpeed;
        return speed > 0 ? time * speed : 0;
    }

    bool Touch(double t, double lastT, double touching, ref Impact impact)
    {
        // Only a round that was longer than is safe ends in an overlap: then the shapes touch within it, and where they last were apart
        // tells how.
        if (distance < 0)
        {
            t = lastT;
            Place(t);
        }
        // The place and the normal are to be better than a plane need be to go by.
        Separate(0, touching * NormalPart);
        impact.T = t;
        impact.Normal = -normal;
        impact.Place = PlaceOnB();
        return MeetsFronts();
    }

    // The point of B's surface that is nearest to A.
    readonly DoubleVector3 PlaceOnB()
    {
        if (!b.Core.IsPlane)
            return offsetB + b.Point(simplex.NearestOnB) - normal * b.Core.Margin;
        var deepest = centerA + a.Point(simplex.NearestOnA) + normal * a.Core.Margin;
        return deepest + normal * DoubleVector3.Dot(offsetB + b.Arm - deepest, normal);
    }

    void Begin(double t)
    {
        a.Place(t);
        b.Place(t);
        centerA = linear * t;
        if (b.Core.IsPlane)
            return;
        var between = centerA + a.Arm - b.Arm - offsetB;
        var length = between.Length;
        simplex = default;
        AddSupport(length > 0 ? between * (1 / length) : new(0, 1, 0));
        simplex.Reduce();
    }

    void Place(double t)
    {
        centerA = linear * t;
        a.Place(t);
        b.Place(t);
        if (b.Core.IsPlane)
            return;
        simplex.Place(this);
        simplex.Reduce();
    }

    /// <summary>Puts a point of the difference where the shapes are now.</summary>
    public readonly void Place(ref ImpactVertex vertex) => vertex.Point = centerA + a.Point(vertex.OnA) - offsetB - b.Point(vertex.OnB);

    // The point of the difference that is farthest against a direction, which is one from B to A.
    void AddSupport(in DoubleVector3 fromB)
    {
        Support(fromB, out var vertex);
        simplex.Add(vertex);
    }

    readonly void Support(in DoubleVector3 fromB, out ImpactVertex vertex)
    {
        vertex.OnA = a.Support(-fromB);
        vertex.OnB = b.Support(fromB);
        vertex.Point = default;
        Place(ref vertex);
    }

    /// <summary>Finds a plane between the shapes, unless they are as near as a distance.</summary>
    /// <returns>Whether they are apart by more; then the plane leaves most of that.</returns>
    /// <param name="near">The distance.</param>
    /// <param name="slack">By how much the plane may leave less besides; infinite for one that is good enough to go by.</param>
    bool Separate(double near, double slack = double.PositiveInfinity)
    {
        if (b.Core.IsPlane)
            return SeparateFromPlane(near);
        if ((a.Core.IsPoint || b.Core.IsPoint) && FindNearest(out var pair))
            return SeparatePoint(pair, near);
        gap = double.MinValue;
        var nearest = DoubleVector3.Dot(simplex.Nearest, simplex.Nearest);
        for (int i = 0; i < MaximumSupports; ++i)
        {
            var length = Math.Sqrt(nearest);
            distance = length - margins;
            if (length <= rounding * OverlapPart)
                return Coincide();
            var fromB = simplex.Nearest * (1 / length);
            if (distance <= near)
            {
                normal = -fromB;
                return false;
            }
            Support(fromB, out var vertex);
            var height = DoubleVector3.Dot(vertex.Point, fromB) - margins;
            if (height > gap)
            {
                gap = height;
                normal = -fromB;
            }
            if (gap >= distance * GapPart && gap >= distance - slack)
                return true;
            var before = simplex;
            simplex.Add(vertex);
            if (!simplex.Reduce())
                return Coincide();
            var now = DoubleVector3.Dot(simplex.Nearest, simplex.Nearest);
            if (!(now < nearest))
            {
                // Rounding ends it: what there is, is as good as it gets.
                simplex = before;
                break;
            }
            nearest = now;
        }
        return gap > near;
    }

    // The nearest points of two cores of which one is a point.
    readonly bool FindNearest(out ImpactVertex vertex)
    {
        vertex = default;
        if (a.Core.IsPoint
            ? !b.Core.TryGetNearest(b.Axes.TurnBack(centerA + a.Arm - offsetB - b.Arm), out vertex.OnB)
            : !a.Core.TryGetNearest(a.Axes.TurnBack(offsetB + b.Arm - centerA - a.Arm), out vertex.OnA))
            return false;
        Place(ref vertex);
        return true;
    }

    bool SeparatePoint(in ImpactVertex vertex, double near)
    {
        simplex.Set(vertex);
        var length = vertex.Point.Length;
        gap = distance = length - margins;
        if (length <= rounding * OverlapPart)
            return Coincide();
        normal = vertex.Point * (-1 / length);
        return distance > near;
    }

    // Cores that overlap, or touch.
    bool Coincide()
    {
        distance = double.NegativeInfinity;
        return false;
    }

    bool SeparateFromPlane(double near)
    {
        normal = -b.Axes.Turn(b.Core.First);
        ImpactVertex vertex;
        vertex.OnA = a.Support(normal);
        vertex.OnB = vertex.Point = default;
        simplex.Count = 0;
        simplex.Add(vertex);
        var deepest = centerA + a.Point(vertex.OnA);
        gap = distance = DoubleVector3.Dot(normal, offsetB + b.Arm - deepest) - margins;
        return distance > near;
    }

    // Shapes that overlap a triangle from the start are on the side where their middle is.
    readonly bool IsInFront() => IsInFrontOf(b, offsetB - centerA - a.Arm) && IsInFrontOf(a, centerA - offsetB - b.Arm);

    static bool IsInFrontOf(in ImpactBody triangle, in DoubleVector3 fromOther)
    {
        var front = triangle.Axes.Turn(triangle.Core.Front);
        return DoubleVector3.Dot(front, fromOther + triangle.Point(triangle.Core.First)) <= 0;
    }

    readonly bool MeetsFronts() => IsOnFront(b, -normal) && IsOnFront(a, normal);

    static bool IsOnFront(in ImpactBody triangle, in DoubleVector3 outwards)
    {
        var front = triangle.Axes.Turn(triangle.Core.Front);
        return DoubleVector3.Dot(front, outwards) >= -BackSlack * front.Length;
    }
}
