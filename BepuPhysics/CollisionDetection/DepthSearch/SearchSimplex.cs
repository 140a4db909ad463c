using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>A point of the Minkowski difference A - B, in A's frame and scaled, and the points of A and B that it came from.</summary>
struct SearchVertex
{
    public Vector3Wide Point;
    /// <summary>In A's frame, m.</summary>
    public Vector3Wide OnA;
    /// <summary>In B's frame, m.</summary>
    public Vector3Wide OnB;

    /// <summary>Whether two points are the same, to the bit.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector<int> AreOne(in Vector3Wide a, in Vector3Wide b) => Vector.Equals(a.X, b.X) & Vector.Equals(a.Y, b.Y) & Vector.Equals(a.Z, b.Z);

    // Row by row: copied as a whole, 288 bytes are a call.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public void Set(in SearchVertex other)
    {
        Point = other.Point;
        OnA = other.OnA;
        OnB = other.OnB;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public void Keep(Vector<int> keepMask, in SearchVertex other)
    {
        Point = Vector3Wide.Select(keepMask, Point, other.Point);
        OnA = Vector3Wide.Select(keepMask, OnA, other.OnA);
        OnB = Vector3Wide.Select(keepMask, OnB, other.OnB);
    }
}

/// <summary>What a simplex is after it has taken in a vertex: that vertex alone, an edge at it, or else a triangle.</summary>
struct SimplexForm
{
    public Vector<int> PointMask, EdgeMask;
    /// <summary>From the new vertex to the other one.</summary>
    public Vector3Wide Edge;
}

/// <summary>Up to three points of the Minkowski difference. A segment or a single point repeats some of its vertices.</summary>
/// <remarks>
/// <para>
/// The subproblem of GJK: of a new vertex and the old ones, which span what is closest to the target? <see cref="Add"/> tries the vertex alone, the
/// three segments and the three triangles at it, each by projection (Ericson, Real-Time Collision Detection, 5.1), keeps the closest, and with it
/// the vertices that span it. The old triangle competes only where it was remembered: a descent's own old triangle has been left already.
/// </para>
/// <para>
/// Invariants: a simplex is never farther from the target than the new vertex; its three places always hold points of the difference, so that no lane
/// needs a count; all three masks of a lane that is done say "keep". Where two trials are equal to the bit, the last one wins, on
/// which the shorter paths for new pairs rely.
/// </para>
/// </remarks>
struct SearchSimplex
{
    // Squared ratio of lengths below which a triangle at a vertex is a needle: its far side is that short.
    const float SquaredNeedle = 1e-2f;
    // Part of an edge that rounding may move a point along it; less than what the descent tolerates.
    const float GreatestSlip = 1e-5f;

    public SearchVertex A, B, C;

    /// <summary>Makes a point of the simplex.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public void Set(in SearchVertex vertex)
    {
        A.Set(vertex);
        B.Set(vertex);
        C.Set(vertex);
    }

    /// <summary>Makes a point of the simplices that are not to be kept.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public void Keep(Vector<int> keepMask, in SearchVertex vertex)
    {
        A.Keep(keepMask, vertex);
        B.Keep(keepMask, vertex);
        C.Keep(keepMask, vertex);
    }

    /// <summary>Whether a vertex is farther along a direction than a height, which no point of the difference is.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly Vector<int> IsBeyond(in Vector3Wide direction, Vector<float> height) =>
        Vector.GreaterThan(Vector3Wide.Dot(A.Point, direction), height) |
        Vector.GreaterThan(Vector3Wide.Dot(B.Point, direction), height) |
        Vector.GreaterThan(Vector3Wide.Dot(C.Point, direction), height);

    /// <summary>Whether all three vertices are one.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly Vector<int> IsPoint() => SearchVertex.AreOne(A.Point, B.Point) & SearchVertex.AreOne(A.Point, C.Point);

    /// <summary>From the closest point to the target, where that is inside of the triangle; where it is not, the mask is not set.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly Vector<int> FaceOffset(in Vector3Wide target, out Vector3Wide offset)
    {
        offset = default;
        var distance = new Vector<float>(float.MaxValue);
        return TryOldTriangle(target, Vector<int>.AllBitsSet, ref offset, ref distance);
    }

    /// <summary>From the closest point of the longest edge at A to the target.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly Vector3Wide EdgeOffset(in Vector3Wide target)
    {
        var b = B.Point - A.Point;
        var c = C.Point - A.Point;
        var squaredB = b.LengthSquared();
        var squaredC = c.LengthSquared();
        var longIsB = Vector.GreaterThan(squaredB, squaredC);
        var offset = target - A.Point;
        var distance = offset.LengthSquared();
        TrySegment(offset, Vector3Wide.Select(longIsB, b, c), Wide.Select(longIsB, squaredB, squaredC), ref offset, ref distance);
        return offset;
    }

    /// <summary>
    /// Takes in a new vertex and keeps those that span, with it, what is closest to the target.
    /// </summary>
    /// <param name="vertex">New vertex.</param>
    /// <param name="target">What the search aims at.</param>
    /// <param name="activeMask">Lanes to change.</param>
    /// <param name="triangleMask">Lanes in which the old triangle competes, too.</param>
    /// <param name="oldCount">
    /// How many vertices there may be in an active lane, at least 1: of one, all three are that; of two, the third is the second. What
    /// is the same as something else then need not be tried, and would change nothing.
    /// </param>
    /// <param name="offset">From the closest point to the target.</param>
    /// <param name="form">What the simplex is now.</param>
    // Exact: all three segments and all three triangles at the new vertex are tried. Choosing between them by plane tests alone is wrong
    // where the target is beside all of them, and then the search may never end.
    // A vertex that is not kept is overwritten by the new one in its place, so that three masks say everything.
    // With two vertices the triangle is c, a and not a, b: of triangles that are alike the last one wins.
    [MethodImpl(MethodImplOptions.NoInlining)]
    public void Add(in SearchVertex vertex, in Vector3Wide target, Vector<int> activeMask, Vector<int> triangleMask, int oldCount,
        out Vector3Wide offset, out SimplexForm form)
    {
        var q = target - vertex.Point;
        var a = A.Point - vertex.Point;
        var b = B.Point - vertex.Point;
        var c = C.Point - vertex.Point;
        // Row by row: copied as a whole, it would wait for its rows.
        var closest = new Vector3Wide(q.X, q.Y, q.Z);
        var distance = q.LengthSquared();
        var squaredA = a.LengthSquared();
        var squaredB = b.LengthSquared();
        var squaredC = c.LengthSquared();
        var keepA = TrySegment(q, a, squaredA, ref closest, ref distance);
        var keepB = Vector<int>.Zero;
        var keepC = Vector<int>.Zero;
        if (oldCount > 1)
        {
            var useB = TrySegment(q, b, squaredB, ref closest, ref distance);
            var useC = Vector<int>.Zero;
            var useAB = Vector<int>.Zero;
            var useBC = Vector<int>.Zero;
            var qa = Vector3Wide.Cross(q, a);
            var qc = Vector3Wide.Cross(q, c);
            if (oldCount > 2)
            {
                useC = TrySegment(q, c, squaredC, ref closest, ref distance);
                var qb = Vector3Wide.Cross(q, b);
                useAB = TryTriangle(q, a, b, A.Point, B.Point, qa, qb, squaredA, squaredB, ref closest, ref distance);
                useBC = TryTriangle(q, b, c, B.Point, C.Point, qb, qc, squaredB, squaredC, ref closest, ref distance);
            }
            var useCA = TryTriangle(q, c, a, C.Point, A.Point, qc, qa, squaredC, squaredA, ref closest, ref distance);
            useAB = Vector.AndNot(useAB, useBC | useCA);
            useBC = Vector.AndNot(useBC, useCA);
            keepA = Vector.AndNot(Vector.AndNot(keepA, useB | useC), useBC) | useAB | useCA;
            keepB = Vector.AndNot(Vector.AndNot(useB, useC), useCA) | useAB | useBC;
            keepC = Vector.AndNot(useC, useAB) | useBC | useCA;
        }
        // An offset that is across a long edge to a part in 1e7 of the edge may be off by much of its own length: once more. An offset from
        // the far end of an edge is not across it, and stays.
        var edge = Vector3Wide.Select(keepA, a, Vector3Wide.Select(keepB, b, c));
        var squaredEdge = Wide.Select(keepA, squaredA, Wide.Select(keepB, squaredB, squaredC));
        var hasEdge = (keepA | keepB | keepC) & Vector.GreaterThan(squaredEdge, new Vector<float>(SearchTolerances.SquaredSamePoint));
        var slip = Vector3Wide.Dot(closest, edge) / squaredEdge;
        closest -= edge * Wide.Mask(hasEdge & Vector.LessThan(Vector.Abs(slip), new Vector<float>(GreatestSlip)), slip);
        if (triangleMask != Vector<int>.Zero)
        {
            var old = TryOldTriangle(target, triangleMask, ref closest, ref distance);
            keepA |= old;
            keepB |= old;
            keepC |= old;
        }
        form.PointMask = Vector.OnesComplement(keepA | keepB | keepC);
        form.EdgeMask = Vector.AndNot(keepA ^ keepB ^ keepC, keepA & keepB & keepC);
        form.Edge = edge;
        A.Keep(Vector.OnesComplement(activeMask) | keepA, vertex);
        B.Keep(Vector.OnesComplement(activeMask) | keepB, vertex);
        C.Keep(Vector.OnesComplement(activeMask) | keepC, vertex);
        offset = closest;
    }

    /// <summary>Weights of the vertices in the point of the simplex that is closest to the target.</summary>
    // The simplex is what is closest, as a whole: the point is inside of it, to rounding. First across the longer edge, then along it, so that
    // in a triangle as thin as a needle what rounding does to the one weight is made good by the other.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly Vector3Wide GetWeights(in Vector3Wide target)
    {
        var one = Vector<float>.One;
        var zero = Vector<float>.Zero;
        var q = target - A.Point;
        var b = B.Point - A.Point;
        var c = C.Point - A.Point;
        var squaredB = b.LengthSquared();
        var squaredC = c.LengthSquared();
        var longIsB = Vector.GreaterThanOrEqual(squaredB, squaredC);
        var longEdge = Vector3Wide.Select(longIsB, b, c);
        var shortEdge = Vector3Wide.Select(longIsB, c, b);
        var squaredLong = Wide.Select(longIsB, squaredB, squaredC);
        var squaredShort = Wide.Select(longIsB, squaredC, squaredB);
        var hasEdge = Vector.GreaterThan(squaredLong, new Vector<float>(SearchTolerances.SquaredSamePoint));
        var inverse = Wide.Mask(hasEdge, one / squaredLong);
        var across = shortEdge - longEdge * (Vector3Wide.Dot(shortEdge, longEdge) * inverse);
        across -= longEdge * (Vector3Wide.Dot(across, longEdge) * inverse);
        var squaredAcross = across.LengthSquared();
        var isTriangle = Vector.GreaterThan(squaredAcross, squaredShort * new Vector<float>(SearchTolerances.SquaredSineOfLine));
        var shortWeight = Wide.Clamp(Wide.Mask(isTriangle, Vector3Wide.Dot(q, across) / squaredAcross), zero, one);
        var longWeight = Vector3Wide.Dot(q - shortEdge * shortWeight, longEdge) * inverse;
        // Where edges are all but parallel, the first weight may be off by any part of one, and then no second weight makes that good. The point
        // seems to be beside the triangle, and is on the side that it seems to be beside of.
        var beforeMask = Vector.LessThan(longWeight, zero);
        var beyondMask = Vector.GreaterThan(longWeight, one - shortWeight);
        if ((beforeMask | beyondMask) != Vector<int>.Zero)
        {
            var side = longEdge - shortEdge;
            var alongSide = Wide.Clamp(Wide.DivideOrZero(Vector3Wide.Dot(q - shortEdge, side), side.LengthSquared()), zero, one);
            var alongShort = Wide.Clamp(Wide.DivideOrZero(Vector3Wide.Dot(q, shortEdge), squaredShort), zero, one);
            // Not by a maximum: in lanes that are neither, that would turn a zero that is negative.
            longWeight = Wide.Select(beyondMask, alongSide, Wide.Mask(Vector.OnesComplement(beforeMask), longWeight));
            shortWeight = Wide.Select(beyondMask, one - alongSide, Wide.Select(beforeMask, alongShort, shortWeight));
        }
        return new(one - longWeight - shortWeight, Wide.Select(longIsB, longWeight, shortWeight), Wide.Select(longIsB, shortWeight, longWeight));
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    readonly Vector<int> TryOldTriangle(in Vector3Wide target, Vector<int> wantedMask, ref Vector3Wide closest, ref Vector<float> distance)
    {
        var e1 = B.Point - A.Point;
        var e2 = C.Point - A.Point;
        var q = target - A.Point;
        return TryTriangle(q, e1, e2, B.Point, C.Point, Vector3Wide.Cross(q, e1), Vector3Wide.Cross(q, e2), e1.LengthSquared(), e2.LengthSquared(),
            wantedMask, ref closest, ref distance);
    }

    // Like a triangle's, a JIT root of its own: inlined, the trials would push each other out of the registers.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static Vector<int> TrySegment(
        in Vector3Wide q, in Vector3Wide edge, Vector<float> squaredEdge, ref Vector3Wide closest, ref Vector<float> distance)
    {
        var hasEdge = Vector.GreaterThan(squaredEdge, new Vector<float>(SearchTolerances.SquaredSamePoint));
        var along = Wide.Clamp(
            Wide.Mask(hasEdge, Vector3Wide.Dot(q, edge) / squaredEdge), Vector<float>.Zero, Vector<float>.One);
        var candidate = q - edge * along;
        var squared = candidate.LengthSquared();
        var better = Vector.LessThan(squared, distance);
        closest = Vector3Wide.Select(better, candidate, closest);
        distance = Wide.Select(better, squared, distance);
        return better;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<int> TryTriangle(in Vector3Wide q, in Vector3Wide e1, in Vector3Wide e2, in Vector3Wide end1, in Vector3Wide end2,
        in Vector3Wide qe1, in Vector3Wide qe2, in Vector<float> squared1, in Vector<float> squared2, ref Vector3Wide closest, ref Vector<float> distance) =>
        TryTriangle(q, e1, e2, end1, end2, qe1, qe2, squared1, squared2, Vector<int>.AllBitsSet, ref closest, ref distance);

    // The cross products of q and the edges are the caller's, who has two triangles for each.
    // A needle's two long edges are all but parallel: their product is a small difference of what is ten to a million times as large. The short
    // edge, taken between the ends as they are, and the median are better, n = e1 x e2 = (e1 + e2) / 2 x e3; and how far along the needle
    // q is shows better across the short edge, u + v = (q x e3).n. Turned about, the triangle gives the same bits.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static Vector<int> TryTriangle(in Vector3Wide q, in Vector3Wide e1, in Vector3Wide e2, in Vector3Wide end1, in Vector3Wide end2,
        in Vector3Wide qe1, in Vector3Wide qe2, in Vector<float> squared1, in Vector<float> squared2, Vector<int> wantedMask,
        ref Vector3Wide closest, ref Vector<float> distance)
    {
        var normal = Vector3Wide.Cross(e1, e2);
        var u = Vector3Wide.Dot(qe2, normal);
        var v = -Vector3Wide.Dot(qe1, normal);
        var sum = u + v;
        var along = Vector3Wide.Dot(e1, e2);
        var needle = Vector.LessThan(squared1 + squared2 - (along + along), Wide.Min(squared1, squared2) * new Vector<float>(SquaredNeedle));
        if (needle != Vector<int>.Zero)
        {
            var e3 = end2 - end1;
            normal = Vector3Wide.Select(needle, Vector3Wide.Cross((e1 + e2) * new Vector<float>(0.5f), e3), normal);
            u = Vector3Wide.Dot(qe2, normal);
            v = -Vector3Wide.Dot(qe1, normal);
            sum = Wide.Select(needle, Vector3Wide.Dot(Vector3Wide.Cross(q, e3), normal), u + v);
        }
        var determinant = normal.LengthSquared();
        var height = Vector3Wide.Dot(q, normal);
        var scaled = height / determinant;
        var squared = height * scaled;
        var better = wantedMask &
            Vector.GreaterThan(determinant, squared1 * squared2 * new Vector<float>(SearchTolerances.SquaredSineOfLine)) &
            Vector.GreaterThanOrEqual(u, Vector<float>.Zero) & Vector.GreaterThanOrEqual(v, Vector<float>.Zero) &
            Vector.LessThanOrEqual(sum, determinant) & Vector.LessThanOrEqual(squared, distance);
        closest = Vector3Wide.Select(better, normal * scaled, closest);
        distance = Wide.Select(better, squared, distance);
        return better;
    }
}
