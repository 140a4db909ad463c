using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>
/// Finds the least depth of one pair by expanding a polytope inside its Minkowski difference where its surface is nearest to the origin,
/// until that is no nearer than the best depth that was found: then no direction is better.
/// </summary>
/// <remarks>
/// <para>
/// The expanding polytope algorithm of van den Bergen ("Proximity queries and penetration depth computation on 3D game objects", 2001), started
/// from what the descent has found. Asks for support points one after the other: <see cref="Next"/> says in which direction, <c>Add</c> takes
/// the answer. Points are floats, the geometry between them is in double precision.
/// </para>
/// <para>
/// First a tetrahedron is needed. The descent's triangle is three of its corners; the fourth is a point of the inner ball beyond the origin, or the
/// support point away from the triangle (Opposite). Where that is flat, corners are looked for one by one, each as far as possible from the
/// point, line or plane of those before (Corner); where none is far enough, the difference has no volume, and its thin side has been looked at. Then
/// the face that is nearest to the origin is expanded again and again (Expand):
/// </para>
/// <code>
///   First -&gt; Corner &lt;- Start &lt;- Opposite
///              |         |
///              v         v
///        Ended (Flat)  Expand -&gt; Ended (Certified, Apart or Limit) -&gt; Restart with smaller cores: First
/// </code>
/// <para>
/// Invariants: <see cref="best"/> is the least depth of all directions asked for, so an upper bound; no direction is less deep than the least height
/// of the polytope's planes, a lower bound; it ends when the two meet, to the slack. Whatever ends it, <see cref="best"/> holds.
/// </para>
/// </remarks>
unsafe struct DepthExpansion
{
    // Six times the volume of a tetrahedron that is too flat to begin with, as a part of its span cubed.
    const double LeastVolume = 1e-9;
    // As a part of the span: how far a point that is at hand must be from the others to begin with.
    const double GoodDistance = 1e-2;
    // As a part of the span: what is no farther out than this has no extent in a direction.
    const double LeastDistance = 2e-6;
    // As parts of the span: what a support point must gain for its face to be no face of the difference, and how far a vertex must be over
    // a face's plane for the face to go. Support points are floats: they are that well known.
    const double FaceRounding = 2e-6;
    const double Visibility = 1e-6;
    const int None = -1;
    // In depths: how far beyond the origin a point inside of the difference must be to serve as a corner.
    const double LeastBallReach = 2;
    const int GreatestEvaluationCount = 2 * PolytopeMemory.VertexCapacity;

    enum Phase
    {
        /// <summary>The first corner, where nothing is at hand: in the best direction.</summary>
        First,
        /// <summary>The fourth corner: away from the descent's triangle.</summary>
        Opposite,
        /// <summary>Corners one by one, where the first four are flat.</summary>
        Corner,
        Expand,
        Ended,
    }

    readonly double slack;
    double span;
    double rounding;
    int evaluationLimit;
    int innerCorner;
    readonly double wanted;
    ExpandingPolytope polytope;
    Phase phase;
    int cornerCount;
    int probe;
    double probedDistance;
    DoubleVector3 probed;
    int face;
    int seed0, seed1, seed2;
    bool hasSeed;
    double best;
    DoubleVector3 bestDirection;

    /// <summary>Number of support points asked for.</summary>
    public int Evaluations;
    /// <summary>Why it ended.</summary>
    public ExpansionEnd End;
    /// <summary>Whether a direction was found that is better than wanted.</summary>
    public bool HasSwitched;

    /// <summary>Starts with the simplex of a descent.</summary>
    /// <param name="memory">Memory.</param>
    /// <param name="frame">Tolerances.</param>
    /// <param name="descent">Where the descent ended.</param>
    /// <param name="lane">Which of its lanes.</param>
    /// <param name="wanted">Depth below which a direction is of interest.</param>
    public DepthExpansion(PolytopeMemory* memory, in SearchFrame frame, in SearchDescent descent, int lane, double wanted)
    {
        span = frame.Span[lane];
        slack = frame.CertificateSlack[lane];
        this.wanted = wanted;
        best = descent.Depth[lane];
        bestDirection = new(descent.Direction.X[lane], descent.Direction.Y[lane], descent.Direction.Z[lane]);
        polytope = new(memory, Visibility * span);
        Read(descent.Simplex.A, lane, out polytope[0]);
        Read(descent.Simplex.B, lane, out polytope[1]);
        Read(descent.Simplex.C, lane, out polytope[2]);
        evaluationLimit = GreatestEvaluationCount;
        innerCorner = None;
        phase = Phase.Opposite;
        // The fourth corner costs nothing where the ball inside of the difference reaches well beyond the origin.
        var center = new DoubleVector3(frame.Center.X[lane], frame.Center.Y[lane], frame.Center.Z[lane]);
        var below = center - bestDirection * frame.Inner[lane];
        if (-DoubleVector3.Dot(below, bestDirection) > LeastBallReach * best)
        {
            innerCorner = 3;
            Unsafe.SkipInit(out PolytopeVertex corner);
            corner.Point = below;
            polytope[3] = corner;
            Start();
        }
    }

    /// <summary>Starts once more, with the difference of smaller cores that a radius is to be added to.</summary>
    /// <param name="coreSpan">Radius of a ball about the difference's centre that holds it, or the distance of the origin if that is more.</param>
    /// <param name="coreRounding">Radius; what is found is at least as much deeper in any direction.</param>
    public void Restart(double coreSpan, double coreRounding)
    {
        span = coreSpan;
        rounding = coreRounding;
        hasSeed = false;
        innerCorner = None;
        polytope.Restart(Visibility * span);
        phase = Phase.First;
        evaluationLimit = Evaluations + GreatestEvaluationCount;
    }

    /// <summary>Takes a point of the difference that is at hand, once there is a polytope.</summary>
    public void Offer(in SearchVertex found, int lane)
    {
        if (phase != Phase.Expand)
            return;
        Read(found, lane, out polytope[polytope.VertexCount]);
        if (polytope.TryExpand())
            Choose();
    }

    /// <summary>Says which support point is wanted next; false when the expansion has ended.</summary>
    public bool Next(out Vector3 direction)
    {
        var wantedDirection = phase switch
        {
            Phase.First => bestDirection,
            Phase.Opposite => -bestDirection,
            Phase.Corner => probed,
            Phase.Expand => polytope.Normal(face),
            _ => default,
        };
        direction = wantedDirection.ToSingle();
        return phase != Phase.Ended;
    }

    /// <summary>Takes the support point that was asked for.</summary>
    public void Add(in SearchVertex found, int lane, in Vector3 direction)
    {
        Read(found, lane, out var vertex);
        Add(vertex, DoubleVector3.Dot(vertex.Point, new(direction)), direction);
    }

    /// <summary>Takes the support point of the smaller cores, and that of the shapes themselves.</summary>
    public void Add(in SearchVertex foundOfCores, in SearchVertex found, int lane, in Vector3 direction)
    {
        Read(found, lane, out var vertex);
        var depth = DoubleVector3.Dot(vertex.Point, new(direction));
        Read(foundOfCores, lane, out vertex);
        ++Evaluations;
        Add(vertex, depth, direction);
    }

    void Add(in PolytopeVertex vertex, double depth, in Vector3 direction)
    {
        ++Evaluations;
        var isBest = depth < best;
        if (isBest)
        {
            best = depth;
            bestDirection = new(direction);
            hasSeed = false;
        }
        if (best <= 0)
        {
            Finish(ExpansionEnd.Apart);
            return;
        }
        switch (phase)
        {
            case Phase.First:
                polytope[0] = vertex;
                phase = Phase.Corner;
                cornerCount = 1;
                StartProbing();
                break;
            case Phase.Opposite:
                polytope[3] = vertex;
                Start();
                break;
            case Phase.Corner:
                TakeCorner(vertex);
                break;
            case Phase.Expand:
                Expand(vertex, DoubleVector3.Dot(vertex.Point, new(direction)), isBest);
                break;
        }
    }

    /// <summary>Puts a descent where the best direction is.</summary>
    /// <param name="descent">Descent.</param>
    /// <param name="lane">Lane of it to write.</param>
    /// <param name="isSeeded">Whether it has a simplex there.</param>
    public readonly void Write(ref SearchDescent descent, int lane, out bool isSeeded)
    {
        Lanes.Write(bestDirection.ToSingle(), ref descent.Direction, lane);
        isSeeded = hasSeed;
        if (!hasSeed)
            return;
        WriteVertex(polytope[seed0], ref descent.Simplex.A, lane);
        WriteVertex(polytope[seed1], ref descent.Simplex.B, lane);
        WriteVertex(polytope[seed2], ref descent.Simplex.C, lane);
    }

    void Start()
    {
        var volume = polytope.Volume();
        if ((volume < 0 ? -volume : volume) > LeastVolume * span * span * span)
        {
            polytope.Start();
            phase = Phase.Expand;
            Choose();
            return;
        }
        // Corner by corner, each as far as possible from the point, line or plane of those before: those at hand where they are far enough.
        phase = Phase.Corner;
        cornerCount = 1;
        while (cornerCount < 3 && TryCornerAtHand())
            ++cornerCount;
        StartProbing();
    }

    /// <summary>Swaps the farthest of the vertices at hand into the place of the next corner.</summary>
    bool TryCornerAtHand()
    {
        var farthest = 0;
        var distance = GoodDistance * span;
        for (int i = cornerCount; i < 4; ++i)
        {
            var candidate = DistanceFromCorners(polytope[i].Point);
            if (candidate > distance)
            {
                distance = candidate;
                farthest = i;
            }
        }
        if (farthest == 0)
            return false;
        (polytope[cornerCount], polytope[farthest]) = (polytope[farthest], polytope[cornerCount]);
        innerCorner = innerCorner == farthest ? cornerCount : innerCorner == cornerCount ? farthest : innerCorner;
        return true;
    }

    void StartProbing()
    {
        probe = 0;
        probedDistance = LeastDistance * span;
        probed = GetProbe();
    }

    /// <summary>Takes a support point across the corners, and the farthest of them as the next corner.</summary>
    void TakeCorner(in PolytopeVertex vertex)
    {
        var distance = DistanceFromCorners(vertex.Point);
        if (distance > probedDistance)
        {
            probedDistance = distance;
            polytope[cornerCount] = vertex;
            innerCorner = innerCorner == cornerCount ? None : innerCorner;
        }
        // Both ways along each axis across the corners: three axes across a point, two across a line, one across a plane.
        if (++probe < 8 - 2 * cornerCount)
            probed = GetProbe();
        else if (probedDistance <= LeastDistance * span)
            // No thicker than this across some direction, which has just been looked along both ways.
            Finish(rounding == 0 ? ExpansionEnd.Flat : best - (rounding - DistanceToFirstEdge()) <= slack ? ExpansionEnd.Certified : ExpansionEnd.Limit);
        else if (++cornerCount < 4)
            StartProbing();
        else
        {
            polytope.Start();
            phase = Phase.Expand;
            Choose();
        }
    }

    /// <summary>Distance of the origin from the first corner, or from the edge to the second if there is one.</summary>
    readonly double DistanceToFirstEdge()
    {
        var start = polytope[0].Point;
        if (cornerCount == 1)
            return start.Length;
        var edge = polytope[1].Point - start;
        var place = -DoubleVector3.Dot(start, edge) / DoubleVector3.Dot(edge, edge);
        place = place < 0 ? 0 : place > 1 ? 1 : place;
        return (start - edge * -place).Length;
    }

    readonly double DistanceFromCorners(in DoubleVector3 point)
    {
        var offset = point - polytope[0].Point;
        if (cornerCount == 1)
            return offset.Length;
        if (cornerCount == 2)
            return DoubleVector3.Cross(offset, Unit(1)).Length;
        var height = DoubleVector3.Dot(offset, Across());
        return height < 0 ? -height : height;
    }

    readonly DoubleVector3 GetProbe()
    {
        DoubleVector3 axis;
        if (cornerCount == 1)
            axis = new(probe >> 1 == 0 ? 1 : 0, probe >> 1 == 1 ? 1 : 0, probe >> 1 == 2 ? 1 : 0);
        else if (cornerCount == 2)
        {
            var along = Unit(1);
            axis = DoubleVector3.Cross(along, LeastAxis(along));
            axis *= 1 / axis.Length;
            if (probe >> 1 == 1)
                axis = DoubleVector3.Cross(along, axis);
        }
        else
            axis = Across();
        return (probe & 1) == 0 ? axis : -axis;
    }

    readonly DoubleVector3 Unit(int corner)
    {
        var edge = polytope[corner].Point - polytope[0].Point;
        return edge * (1 / edge.Length);
    }

    readonly DoubleVector3 Across()
    {
        var normal = DoubleVector3.Cross(Unit(1), Unit(2));
        return normal * (1 / normal.Length);
    }

    void Expand(in PolytopeVertex vertex, double depth, bool isBest)
    {
        if (depth - polytope.Priority(face) <= FaceRounding * span)
        {
            // A face of the difference itself: as far out as can be.
            polytope.Settle(face);
            if (isBest)
                Seed(face);
        }
        else
        {
            polytope[polytope.VertexCount] = vertex;
            polytope.Expand(face);
        }
        Choose();
    }

    /// <summary>Picks the face to expand, or ends.</summary>
    void Choose()
    {
        face = polytope.FindLeast();
        var height = polytope.Priority(face);
        // Outside of smaller cores the origin is farther from them than from the plane: there they bound nothing.
        var bound = rounding > 0 && height < 0 ? double.NegativeInfinity : height + rounding;
        if (best - bound <= slack || bound >= wanted)
        {
            if (!hasSeed && bound < double.PositiveInfinity)
                Seed(face);
            Finish(ExpansionEnd.Certified);
        }
        else if (polytope.VertexCount == PolytopeMemory.VertexCapacity || Evaluations >= evaluationLimit)
            Finish(ExpansionEnd.Limit);
    }

    void Seed(int index)
    {
        polytope.GetCorners(index, out seed0, out seed1, out seed2);
        // Points of smaller cores are inside of the difference, and the free corner is no point of the shapes.
        hasSeed = rounding == 0 && seed0 != innerCorner && seed1 != innerCorner && seed2 != innerCorner;
    }

    void Finish(ExpansionEnd end)
    {
        End = end;
        HasSwitched = best < wanted;
        phase = Phase.Ended;
    }

    static DoubleVector3 LeastAxis(in DoubleVector3 v)
    {
        double x = v.X * v.X, y = v.Y * v.Y, z = v.Z * v.Z;
        return x <= y && x <= z ? new(1, 0, 0) : y <= z ? new(0, 1, 0) : new(0, 0, 1);
    }

    static void Read(in SearchVertex vertex, int lane, out PolytopeVertex result)
    {
        result.Point = new(vertex.Point.X[lane], vertex.Point.Y[lane], vertex.Point.Z[lane]);
        result.OnA = new(vertex.OnA.X[lane], vertex.OnA.Y[lane], vertex.OnA.Z[lane]);
        result.OnB = new(vertex.OnB.X[lane], vertex.OnB.Y[lane], vertex.OnB.Z[lane]);
    }

    static void WriteVertex(in PolytopeVertex vertex, ref SearchVertex target, int lane)
    {
        Lanes.Write(vertex.Point.ToSingle(), ref target.Point, lane);
        Lanes.Write(vertex.OnA, ref target.OnA, lane);
        Lanes.Write(vertex.OnB, ref target.OnB, lane);
    }
}
