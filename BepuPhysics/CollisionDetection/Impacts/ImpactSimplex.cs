using System;

namespace BepuPhysics.CollisionDetection;

/// <summary>A point of the difference of two cores, and the points of the cores that it came from, each in its shape's frame.</summary>
struct ImpactVertex
{
    public DoubleVector3 OnA, OnB, Point;
}

/// <summary>
/// Up to four points of the difference of two cores, and which point of theirs is nearest to the origin (GJK, in double precision).
/// </summary>
/// <remarks>
/// By Voronoi regions, as in Ericson, Real-Time Collision Detection, 5.1: corner, edge, face, in turn. Cases that a rounded sign could
/// take for another are taken as what is smaller: a face without area as its edges, a tetrahedron without volume as its faces.
/// </remarks>
struct ImpactSimplex
{
    // Sine of the angle between a corner and the face opposite below which a tetrahedron has no volume: some roundings.
    const double FlatPart = 1e-14;

    ImpactVertex v0, v1, v2, v3;
    double w0, w1, w2;

    /// <summary>Number of points.</summary>
    public int Count;

    /// <summary>Point of the simplex that is nearest to the origin; zero if the origin is inside.</summary>
    public DoubleVector3 Nearest;

    /// <summary>The point of a triangle that is nearest to the origin.</summary>
    public static DoubleVector3 NearestToOrigin(in DoubleVector3 a, in DoubleVector3 b, in DoubleVector3 c)
    {
        var simplex = default(ImpactSimplex);
        simplex.v0.Point = a;
        simplex.v1.Point = b;
        simplex.v2.Point = c;
        simplex.Count = 3;
        simplex.ReduceFace();
        return simplex.Nearest;
    }

    /// <summary>Becomes a single point.</summary>
    public void Set(in ImpactVertex vertex) => KeepCorner(vertex);

    /// <summary>Adds a point; there may be three before.</summary>
    public void Add(in ImpactVertex vertex)
    {
        switch (Count++)
        {
            case 0: v0 = vertex; break;
            case 1: v1 = vertex; break;
            case 2: v2 = vertex; break;
            default: v3 = vertex; break;
        }
    }

    /// <summary>Puts the points where their shapes are now.</summary>
    public void Place(in ImpactPair pair)
    {
        pair.Place(ref v0);
        if (Count > 1)
            pair.Place(ref v1);
        if (Count > 2)
            pair.Place(ref v2);
    }

    /// <summary>Where the nearest point came from on A, in A's frame.</summary>
    public readonly DoubleVector3 NearestOnA => Mix(v0.OnA, v1.OnA, v2.OnA);

    /// <summary>Where the nearest point came from on B, in B's frame.</summary>
    public readonly DoubleVector3 NearestOnB => Mix(v0.OnB, v1.OnB, v2.OnB);

    readonly DoubleVector3 Mix(in DoubleVector3 a, in DoubleVector3 b, in DoubleVector3 c) => Count switch
    {
        1 => a,
        2 => a * w0 + b * w1,
        _ => a * w0 + b * w1 + c * w2,
    };

    /// <summary>Finds the nearest point, and leaves only what it lies on: at most three points.</summary>
    /// <returns>Whether there is one; false where the origin is inside.</returns>
    public bool Reduce()
    {
        switch (Count)
        {
            case 1:
                Nearest = v0.Point;
                return true;
            case 2:
                ReduceEdge();
                return true;
            case 3:
                ReduceFace();
                return true;
            default:
                return ReduceTetrahedron();
        }
    }

    void KeepCorner(in ImpactVertex vertex)
    {
        v0 = vertex;
        Count = 1;
        Nearest = vertex.Point;
    }

    void ReduceEdge()
    {
        var edge = v1.Point - v0.Point;
        var along = -DoubleVector3.Dot(v0.Point, edge);
        var length = DoubleVector3.Dot(edge, edge);
        if (!(along > 0))
        {
            KeepCorner(v0);
        }
        else if (along >= length)
        {
            KeepCorner(v1);
        }
        else
        {
            w1 = along / length;
            w0 = 1 - w1;
            Nearest = v0.Point + edge * w1;
        }
    }

    void KeepEdge(in ImpactVertex start, in ImpactVertex end)
    {
        // One at a time: both may be vertices of this.
        var last = end;
        v0 = start;
        v1 = last;
        Count = 2;
        ReduceEdge();
    }

    void ReduceFace()
    {
        var ab = v1.Point - v0.Point;
        var ac = v2.Point - v0.Point;
        double abA = -DoubleVector3.Dot(ab, v0.Point), acA = -DoubleVector3.Dot(ac, v0.Point);
        if (abA <= 0 && acA <= 0)
        {
            KeepCorner(v0);
            return;
        }
        double abB = -DoubleVector3.Dot(ab, v1.Point), acB = -DoubleVector3.Dot(ac, v1.Point);
        if (abB >= 0 && acB <= abB)
        {
            KeepCorner(v1);
            return;
        }
        double abC = -DoubleVector3.Dot(ab, v2.Point), acC = -DoubleVector3.Dot(ac, v2.Point);
        if (acC >= 0 && abC <= acC)
        {
            KeepCorner(v2);
            return;
        }
        var partC = abA * acB - abB * acA;
        if (partC <= 0 && abA >= 0 && abB <= 0)
        {
            KeepEdge(v0, v1);
            return;
        }
        var partB = abC * acA - abA * acC;
        if (partB <= 0 && acA >= 0 && acC <= 0)
        {
            KeepEdge(v0, v2);
            return;
        }
        var partA = abB * acC - abC * acB;
        if (partA <= 0 && acB >= abB && abC >= acC)
        {
            KeepEdge(v1, v2);
            return;
        }
        var normal = DoubleVector3.Cross(ab, ac);
        var squared = DoubleVector3.Dot(normal, normal);
        var sum = partA + partB + partC;
        if (!(sum > 0 && squared > 0))
        {
            ReduceToNearestEdge();
            return;
        }
        w1 = partB / sum;
        w2 = partC / sum;
        w0 = 1 - w1 - w2;
        // The plane tells where it is better than the weights do, once the origin is far away.
        Nearest = normal * (DoubleVector3.Dot(normal, v0.Point) / squared);
    }

    void ReduceToNearestEdge()
    {
        ImpactSimplex first = this, second = this, third = this;
        first.KeepEdge(v0, v1);
        second.KeepEdge(v0, v2);
        third.KeepEdge(v1, v2);
        this = Nearer(Nearer(first, second), third);
    }

    static ImpactSimplex Nearer(in ImpactSimplex a, in ImpactSimplex b) =>
        DoubleVector3.Dot(b.Nearest, b.Nearest) < DoubleVector3.Dot(a.Nearest, a.Nearest) ? b : a;

    bool ReduceTetrahedron()
    {
        var best = default(ImpactSimplex);
        var bestDistance = double.MaxValue;
        TryFace(v0, v1, v2, v3, ref best, ref bestDistance);
        TryFace(v0, v1, v3, v2, ref best, ref bestDistance);
        TryFace(v0, v2, v3, v1, ref best, ref bestDistance);
        TryFace(v1, v2, v3, v0, ref best, ref bestDistance);
        if (best.Count == 0)
        {
            Nearest = default;
            return false;
        }
        this = best;
        return true;
    }

    static void TryFace(in ImpactVertex a, in ImpactVertex b, in ImpactVertex c, in ImpactVertex opposite,
        ref ImpactSimplex best, ref double bestDistance)
    {
        var normal = DoubleVector3.Cross(b.Point - a.Point, c.Point - a.Point);
        var toOrigin = -DoubleVector3.Dot(normal, a.Point);
        var opposing = opposite.Point - a.Point;
        var toOpposite = DoubleVector3.Dot(normal, opposing);
        // The origin is on this face's inner side: beside the opposite corner. A flat tetrahedron has no such side.
        var isFlat = !(Math.Abs(toOpposite) > FlatPart * normal.Length * opposing.Length);
        if (!isFlat && toOrigin != 0 && (toOrigin > 0) == (toOpposite > 0))
            return;
        var face = new ImpactSimplex { v0 = a, v1 = b, v2 = c, Count = 3 };
        face.ReduceFace();
        var distance = DoubleVector3.Dot(face.Nearest, face.Nearest);
        if (distance < bestDistance)
        {
            bestDistance = distance;
            best = face;
        }
    }
}
