using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>A triangle of a surface as it lies in the world, and the directions from which its neighbours leave it.</summary>
/// <remarks>
/// What is asked of one edge is asked of all three, so AB, BC and CA are in the first three lanes of vectors, and what is kept of edges is too. Each operation
/// is that of <see cref="Exact"/>, so that a lane has the bits that it would have alone.
/// </remarks>
struct TriangleSurface
{
    /// <summary>Sine by which a direction may be beyond a neighbour's.</summary>
    public const float Beyond = 1e-4f;

    /// <summary>A vector along the normal.</summary>
    public Vector3 Face;
    /// <summary>The normal; there once <see cref="Bound"/> was said.</summary>
    public Vector3 Normal;

    // A vector for each edge.
    struct Lanes(Vector128<float> x, Vector128<float> y, Vector128<float> z)
    {
        public Vector128<float> X = x, Y = y, Z = z;

        public readonly Vector3 this[int edge] => new(X[edge], Y[edge], Z[edge]);

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public readonly Vector128<float> Dot(in Vector3 v) => v.X * X + v.Y * Y + v.Z * Z;

        // v x each.
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public readonly Lanes CrossedBy(in Vector3 v) => new(v.Y * Z - v.Z * Y, v.Z * X - v.X * Z, v.X * Y - v.Y * X);
    }

    // The edges; bounds of directions at each, zero where there is none.
    Lanes edges, bounds;
    /// <summary>Length of a side, if not of the longest, m; there once <see cref="Bound"/> was said.</summary>
    public float Size;

    /// <summary>Puts a triangle where it is.</summary>
    public TriangleSurface(in Triangle triangle, in Quaternion orientation)
    {
        Unsafe.SkipInit(out this);
        Place(triangle, orientation);
    }

    /// <summary>Puts a triangle where it is, as one that is made anew, in place: three hundred bytes are not cleared and copied.</summary>
    public void Place(in Triangle triangle, in Quaternion orientation)
    {
        var x = Vector128.Create(triangle.A.X, triangle.B.X, triangle.C.X, triangle.A.X);
        var y = Vector128.Create(triangle.A.Y, triangle.B.Y, triangle.C.Y, triangle.A.Y);
        var z = Vector128.Create(triangle.A.Z, triangle.B.Z, triangle.C.Z, triangle.A.Z);
        edges = Rotate(new(Next(x) - x, Next(y) - y, Next(z) - z), orientation);
        Face = Exact.Cross(edges[0], edges[2]);
    }

    // Of each lane the next.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector128<float> Next(Vector128<float> lanes) => Vector128.Shuffle(lanes, Vector128.Create(1, 2, 3, 0));

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Lanes Rotate(in Lanes v, in Quaternion q)
    {
        var axis = new Vector3(q.X, q.Y, q.Z);
        var t = v.CrossedBy(axis);
        t = new(t.X + t.X, t.Y + t.Y, t.Z + t.Z);
        var across = t.CrossedBy(axis);
        return new(v.X + t.X * q.W + across.X, v.Y + t.Y * q.W + across.Y, v.Z + t.Z * q.W + across.Z);
    }

    /// <summary>Finds the bounds of directions at the edges.</summary>
    public void Bound(in TriangleCone cone)
    {
        Normal = Exact.Normalize(Face);
        var across = edges.CrossedBy(Normal);
        var lengths = Vector128.Sqrt(across.X * across.X + across.Y * across.Y + across.Z * across.Z);
        var scales = Vector128.ConditionalSelect(Vector128.Equals(lengths, Vector128<float>.Zero), Vector128<float>.Zero, Vector128<float>.One / lengths);
        var outwards = new Lanes(across.X * scales, across.Y * scales, across.Z * scales);
        var (cosines, sines) = (cone.Cosines.AsVector128(), cone.Sines.AsVector128());
        var isBound = Vector128.Equals(Vector128.Create(1, 2, 4, 0) & Vector128.Create(cone.FreeMask), Vector128<int>.Zero).AsSingle();
        bounds = new(
            (outwards.X * cosines - Normal.X * sines) & isBound,
            (outwards.Y * cosines - Normal.Y * sines) & isBound,
            (outwards.Z * cosines - Normal.Z * sines) & isBound);
        Size = MathHelper.Max(Exact.Length(edges[0]), Exact.Length(edges[2]));
    }

    /// <summary>The direction of the bound that a direction is farthest beyond; zero where it is beyond none.</summary>
    public readonly Vector3 Violated(in Vector3 direction)
    {
        // What touches the triangle elsewhere is not at an edge: where the triangle is obtuse, it may lean beyond that all the same. An edge is touched if the
        // farthest point is one of it, by how far its ends and the corner opposite are: not that corner, unless the edge is as far as a whole.
        var beyond = bounds.Dot(direction);
        var isBeyond = Vector128.GreaterThan(beyond, Vector128.Create(Beyond));
        if ((isBeyond.ExtractMostSignificantBits() & 7) == 0)
            return default;
        var (reachB, reachC) = (Exact.Dot(direction, edges[0]), Exact.Dot(direction, -edges[2]));
        // A corner must be nearer than the farthest by that part of the size not to be as far.
        var farthest = Vector128.Create(MathHelper.Max(0, MathHelper.Max(reachB, reachC)) - Beyond * Size);
        var starts = Vector128.Create(0, reachB, reachC, 0);
        var ends = Vector128.Create(reachB, reachC, 0, 0);
        var opposite = Vector128.Create(reachC, 0, reachB, 0);
        var isAtEdge = Vector128.LessThan(opposite, farthest) | (Vector128.GreaterThanOrEqual(starts, farthest) & Vector128.GreaterThanOrEqual(ends, farthest));
        var violated = (isBeyond & isAtEdge).ExtractMostSignificantBits() & 7;
        var (most, bound) = (Beyond, default(Vector3));
        for (; violated != 0; violated &= violated - 1)
        {
            var edge = BitOperations.TrailingZeroCount(violated);
            if (beyond[edge] > most)
                (most, bound) = (beyond[edge], bounds[edge]);
        }
        return bound;
    }
}
