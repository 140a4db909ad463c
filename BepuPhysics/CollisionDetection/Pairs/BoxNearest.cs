using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>The nearest points of two boxes that are apart, in A's frame.</summary>
// Of two convex polyhedra the nearest points are a vertex and a point of the other, or points of two edges. So they are found among B's
// edges, each against the whole of A, and A's vertices against the whole of B.
struct BoxNearest
{
    /// <summary>Squared distance.</summary>
    public Vector<float> DistanceSquared;
    /// <summary>Point of A.</summary>
    public Vector3Wide OnA;
    /// <summary>From the point of A to that of B.</summary>
    public Vector3Wide Way;

    /// <summary>Finds the points.</summary>
    /// <param name="a">First boxes.</param>
    /// <param name="b">Second boxes.</param>
    /// <param name="axesB">B's axes in A's frame.</param>
    /// <param name="offsetB">B's centre in A's frame.</param>
    /// <param name="nearest">The points.</param>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static void Find(in BoxWide a, in BoxWide b, in Matrix3x3Wide axesB, in Vector3Wide offsetB, out BoxNearest nearest)
    {
        Vector3Wide halfA = new(a.HalfWidth, a.HalfHeight, a.HalfLength);
        Vector3Wide halfB = new(b.HalfWidth, b.HalfHeight, b.HalfLength);
        Unsafe.SkipInit(out nearest);
        nearest.DistanceSquared = new Vector<float>(float.MaxValue);
        var x = axesB.X * halfB.X;
        var y = axesB.Y * halfB.Y;
        var z = axesB.Z * halfB.Z;
        nearest.TryEdges(offsetB, axesB.X, halfB.X, y, z, halfA);
        nearest.TryEdges(offsetB, axesB.Y, halfB.Y, z, x, halfA);
        nearest.TryEdges(offsetB, axesB.Z, halfB.Z, x, y, halfA);
        for (int i = 0; i < 8; ++i)
        {
            Vector3Wide vertex = new(Side(halfA.X, i), Side(halfA.Y, i >> 1), Side(halfA.Z, i >> 2));
            var local = axesB * (vertex - offsetB);
            nearest.Offer(vertex, offsetB + Matrix3x3Wide.TransposeTimes(axesB, Clamp(local, halfB)));
        }
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<float> Side(Vector<float> half, int bit) => (bit & 1) == 0 ? -half : half;

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector3Wide Clamp(in Vector3Wide point, in Vector3Wide half) => new(
        Wide.Clamp(point.X, -half.X, half.X), Wide.Clamp(point.Y, -half.Y, half.Y), Wide.Clamp(point.Z, -half.Z, half.Z));

    /// <summary>Tries the four edges along one of B's axes.</summary>
    [MethodImpl(MethodImplOptions.NoInlining)]
    void TryEdges(in Vector3Wide offsetB, in Vector3Wide axis, Vector<float> half, in Vector3Wide across, in Vector3Wide other, in Vector3Wide halfA)
    {
        for (int i = 0; i < 4; ++i)
        {
            var middle = offsetB + ((i & 1) == 0 ? -across : across) + ((i & 2) == 0 ? -other : other);
            BoxLine.FindNearest(middle, axis, halfA, -half, half, out var place);
            var onB = middle + axis * place;
            Offer(Clamp(onB, halfA), onB);
        }
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    void Offer(in Vector3Wide onA, in Vector3Wide onB)
    {
        var way = onB - onA;
        var distanceSquared = way.LengthSquared();
        var better = Vector.LessThan(distanceSquared, DistanceSquared);
        DistanceSquared = Wide.Select(better, distanceSquared, DistanceSquared);
        OnA = Vector3Wide.Select(better, onA, OnA);
        Way = Vector3Wide.Select(better, way, Way);
    }
}
