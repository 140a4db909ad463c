using System;
using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>
/// Finds the least depth of one pair by expanding a polytope inside its Minkowski difference where its surface is nearest to the origin,
/// until that is no nearer than the best depth that was found: then no direction is better.
/// </summary>
/// <remarks>
/// Asks for support points one after the other: <see cref="Next"/> says in which direction, <see cref="Add"/> takes the answer. Points are
/// floats, the geometry between them is in double precision.
/// </remarks>
ref struct DepthExpansion
{
    // Six times the volume of a tetrahedron that is flat, as a part of its span cubed.
    const double LeastVolume = 1e-9;
    // Squared length below which points of the difference are one, and area below which they are on a line; as parts of powers of the span.
    const double LeastEdge = 1e-7;
    const double LeastArea = 1e-9;
    // As parts of the span: what a support point must gain for its face to be no face of the difference, and how far a vertex must be over
    // a face's plane for the face to go. Support points are floats: they are that well known.
    const double FaceRounding = 2e-6;
    const double Visibility = 1e-6;
    // How often the tetrahedron is turned in which directions are tried before the difference is taken for flat.
    const int MaximumTurns = 6;

    enum Phase { Opposite, Tetrahedron, FlatSide, OtherFlatSide, Expand, Ended }

    readonly double span;
    readonly double slack;
    readonly double wanted;
    ExpandingPolytope polytope;
    Phase phase;
    int corner;
    int turn;
    int face;
    int seed0, seed1, seed2;
    bool hasSeed;
    double best;
    DoubleVector3 bestDirection;
    DoubleVector3 flatNormal;

    /// <summary>Number of support points asked for.</summary>
    public int Evaluations;
    /// <summary>Why it ended.</summary>
    public ExpansionEnd End;
    /// <summary>Whether a direction was found that is better than wanted.</summary>
    public bool HasSwitched;

    /// <summary>Starts with the simplex of a walk.</summary>
    /// <param name="vertices">Memory.</param>
    /// <param name="faces">Memory.</param>
    /// <param name="indices">Memory.</param>
    /// <param name="frame">Tolerances.</param>
    /// <param name="walk">Where the walk ended.</param>
    /// <param name="lane">Which of its lanes.</param>
    /// <param name="wanted">Depth below which a direction is of interest.</param>
    public DepthExpansion(Span<PolytopeVertex> vertices, Span<PolytopeFace> faces, Span<int> indices, in SearchFrame frame,
        in SearchWalk walk, int lane, double wanted)
    {
        span = frame.Span[lane];
        slack = frame.CertificateSlack[lane];
        this.wanted = wanted;
        best = walk.Depth[lane];
        bestDirection = new(walk.Direction.X[lane], walk.Direction.Y[lane], walk.Direction.Z[lane]);
        polytope = new(vertices, faces, indices[..(indices.Length / 2)], indices[(indices.Length / 2)..], Visibility * span);
        Read(walk.Simplex.A, lane, out vertices[0]);
        Read(walk.Simplex.B, lane, out vertices[1]);
        Read(walk.Simplex.C, lane, out vertices[2]);
        phase = Phase.Opposite;
    }

    /// <summary>Says which support point is wanted next; false when the expansion has ended.</summary>
    public bool Next(out Vector3 direction)
    {
        var wantedDirection = phase switch
        {
            Phase.Opposite => -bestDirection,
            Phase.Tetrahedron => GetCorner(corner, turn),
            Phase.FlatSide => flatNormal,
            Phase.OtherFlatSide => -flatNormal,
            Phase.Expand => polytope.Faces[face].Normal,
            _ => default,
        };
        direction = wantedDirection.ToSingle();
        return phase != Phase.Ended;
    }

    /// <summary>Takes the support point that was asked for.</summary>
    public void Add(in SearchVertex found, int lane, in Vector3 direction)
    {
        ++Evaluations;
        var place = phase switch
        {
            Phase.Opposite => 3,
            Phase.Tetrahedron => corner,
            Phase.Expand => polytope.VertexCount,
            _ => -1,
        };
        PolytopeVertex vertex;
        Read(found, lane, out vertex);
        if (place >= 0)
            polytope.Vertices[place] = vertex;
        var depth = DoubleVector3.Dot(vertex.Point, new(direction));
        var isBest = depth < best;
        if (isBest)
        {
            best = depth;
            bestDirection = new(direction);
            hasSeed = false;
        }
        switch (phase)
        {
            case Phase.Opposite:
                StartIfSolid();
                break;
            case Phase.Tetrahedron:
                if (++corner == 4)
                    StartIfSolid();
                break;
            case Phase.FlatSide:
                phase = Phase.OtherFlatSide;
                break;
            case Phase.OtherFlatSide:
                Finish(ExpansionEnd.Flat);
                break;
            case Phase.Expand:
                Expand(depth, isBest);
                break;
        }
    }

    /// <summary>Puts a walk where the best direction is.</summary>
    /// <param name="walk">Walk.</param>
    /// <param name="lane">Lane of it to write.</param>
    /// <param name="isSeeded">Whether it has a simplex there.</param>
    public readonly void Write(ref SearchWalk walk, int lane, out bool isSeeded)
    {
        Lanes.Write(bestDirection.ToSingle(), ref walk.Direction, lane);
        isSeeded = hasSeed;
        if (!hasSeed)
            return;
        WriteVertex(polytope.Vertices[seed0], ref walk.Simplex.A, lane);
        WriteVertex(polytope.Vertices[seed1], ref walk.Simplex.B, lane);
        WriteVertex(polytope.Vertices[seed2], ref walk.Simplex.C, lane);
    }

    void StartIfSolid()
    {
        if (best <= 0)
        {
            Finish(ExpansionEnd.Apart);
            return;
        }
        var volume = ExpandingPolytope.Volume(polytope.Vertices);
        if ((volume < 0 ? -volume : volume) > LeastVolume * span * span * span)
        {
            polytope.VertexCount = 4;
            polytope.Start();
            phase = Phase.Expand;
            Choose();
        }
        else if (turn < MaximumTurns)
        {
            phase = Phase.Tetrahedron;
            corner = 0;
            ++turn;
        }
        else
        {
            flatNormal = FindFlatNormal();
            phase = Phase.FlatSide;
        }
    }

    void Expand(double depth, bool isBest)
    {
        ref var expanded = ref polytope.Faces[face];
        if (best <= 0)
        {
            Finish(ExpansionEnd.Apart);
            return;
        }
        if (depth - expanded.Offset <= FaceRounding * span)
        {
            // A face of the difference itself: as far out as can be.
            expanded.Priority = double.PositiveInfinity;
            if (isBest)
                Seed(face);
        }
        else
        {
            ++polytope.VertexCount;
            if (!polytope.Expand(face))
            {
                Finish(ExpansionEnd.Limit);
                return;
            }
        }
        Choose();
    }

    /// <summary>Picks the face to expand, or ends.</summary>
    void Choose()
    {
        face = polytope.FindLeast();
        var bound = polytope.Faces[face].Priority;
        if (best - bound <= slack || bound >= wanted)
        {
            if (!hasSeed && bound < double.PositiveInfinity)
                Seed(face);
            Finish(ExpansionEnd.Certified);
        }
        else if (polytope.VertexCount == ExpandingPolytope.MaximumVertexCount || Evaluations >= 2 * ExpandingPolytope.MaximumExpansions)
            Finish(ExpansionEnd.Limit);
    }

    void Seed(int index)
    {
        ref var seed = ref polytope.Faces[index];
        hasSeed = true;
        seed0 = seed.Vertex0;
        seed1 = seed.Vertex1;
        seed2 = seed.Vertex2;
    }

    void Finish(ExpansionEnd end)
    {
        End = end;
        HasSwitched = best < wanted;
        phase = Phase.Ended;
    }

    /// <summary>A direction across a difference without volume.</summary>
    readonly DoubleVector3 FindFlatNormal()
    {
        var origin = polytope.Vertices[0].Point;
        var farthest = 0;
        var length = 0.0;
        for (int i = 1; i < 4; ++i)
        {
            var candidate = (polytope.Vertices[i].Point - origin).Length;
            if (candidate > length)
            {
                length = candidate;
                farthest = i;
            }
        }
        if (length <= LeastEdge * span)
            return bestDirection;
        var edge = (polytope.Vertices[farthest].Point - origin) * (1 / length);
        var normal = default(DoubleVector3);
        var area = 0.0;
        for (int i = 1; i < 4; ++i)
        {
            var candidate = DoubleVector3.Cross(edge, polytope.Vertices[i].Point - origin);
            if (candidate.Length > area)
            {
                area = candidate.Length;
                normal = candidate;
            }
        }
        if (area <= LeastArea * span)
        {
            // A segment: from the origin to its line, or anywhere across it.
            normal = origin - edge * DoubleVector3.Dot(origin, edge);
            area = normal.Length;
            if (area <= LeastEdge * span)
            {
                normal = DoubleVector3.Cross(edge, LeastAxis(edge));
                area = normal.Length;
            }
        }
        return normal * (1 / area);
    }

    static DoubleVector3 LeastAxis(in DoubleVector3 v)
    {
        double x = v.X * v.X, y = v.Y * v.Y, z = v.Z * v.Z;
        return x <= y && x <= z ? new(1, 0, 0) : y <= z ? new(0, 1, 0) : new(0, 0, 1);
    }

    /// <summary>A corner of a regular tetrahedron that has been turned a number of times.</summary>
    static DoubleVector3 GetCorner(int corner, int turns)
    {
        const double Coordinate = 0.57735026918962576;
        var v = corner switch
        {
            0 => new DoubleVector3(Coordinate, Coordinate, Coordinate),
            1 => new DoubleVector3(-Coordinate, -Coordinate, Coordinate),
            2 => new DoubleVector3(-Coordinate, Coordinate, -Coordinate),
            _ => new DoubleVector3(Coordinate, -Coordinate, -Coordinate),
        };
        // Not turned at all, its directions are diagonals of boxes, the least clear ones to ask a box for. The rotation is that of the
        // quaternion (1, 2, 3, 5): rational, and of no finite order.
        for (int i = 0; i < turns; ++i)
        {
            v = new(
                (13 * v.X - 26 * v.Y + 26 * v.Z) / 39,
                (34 * v.X + 19 * v.Y + 2 * v.Z) / 39,
                (-14 * v.X + 22 * v.Y + 29 * v.Z) / 39);
        }
        return v;
    }

    static void Read(in SearchVertex vertex, int lane, out PolytopeVertex result)
    {
        result.Point = new(vertex.Point.X[lane], vertex.Point.Y[lane], vertex.Point.Z[lane]);
        result.OnA = new(vertex.OnA.X[lane], vertex.OnA.Y[lane], vertex.OnA.Z[lane]);
        result.OnB = new(vertex.OnB.X[lane], vertex.OnB.Y[lane], vertex.OnB.Z[lane]);
        result.FaceFrom = result.FaceTo = -1;
    }

    static void WriteVertex(in PolytopeVertex vertex, ref SearchVertex target, int lane)
    {
        Lanes.Write(vertex.Point.ToSingle(), ref target.Point, lane);
        Lanes.Write(vertex.OnA, ref target.OnA, lane);
        Lanes.Write(vertex.OnB, ref target.OnB, lane);
    }
}
