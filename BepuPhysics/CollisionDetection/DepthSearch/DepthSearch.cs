using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>
/// Finds the direction of least penetration of any two convex shapes, or of their closest points, from nothing but the farthest points of
/// the shapes in a direction; for bundles of pairs.
/// </summary>
/// <remarks>
/// The depth in a direction is the height of the support plane of the Minkowski difference A - B over the origin; wanted is the least over
/// all directions. A descent finds a local minimum for all lanes at once: it seeks the origin's projection on the best plane so far (the
/// "tootbird") with a simplex, as GJK seeks the origin. Where the shapes overlap deeply there are many local minima. Bounds in the lanes
/// show cheaply that most shallow results are the least of all; for the other lanes a polytope is expanded until it shows that, one lane at
/// a time. From step to step the pair remembers its simplex, and how deep it was when this was last shown.
/// What a lane returns depends on that lane alone.
/// </remarks>
/// <typeparam name="TShapeWideA">Wide form of A's shape.</typeparam>
/// <typeparam name="TSupportA">Farthest points of A.</typeparam>
/// <typeparam name="TShapeWideB">Wide form of B's shape.</typeparam>
/// <typeparam name="TSupportB">Farthest points of B.</typeparam>
public static partial class DepthSearch<TShapeWideA, TSupportA, TShapeWideB, TSupportB>
    where TShapeWideA : unmanaged where TShapeWideB : unmanaged
    where TSupportA : struct, ISupport<TShapeWideA> where TSupportB : struct, ISupport<TShapeWideB>
{
    // A result is shown again to be the least of all directions when it has become deeper by this factor, and after this many steps at the
    // latest.
    const float DeeperFactor = 1.25f;
    const int LongestAge = 16;
    // A remembered minimum is left only for one that is better by this part of its depth, and the slack: it must not flicker between two.
    const float Hysteresis = 0.95f;

    /// <summary>Searches a bundle of pairs.</summary>
    /// <param name="a">First shapes.</param>
    /// <param name="b">Second shapes.</param>
    /// <param name="localOffsetB">Position of B in A's frame, m.</param>
    /// <param name="localOrientationB">Orientation of B in A's frame: the rows are B's axes.</param>
    /// <param name="speculativeMargin">Distance up to which pairs are wanted, m; zero or more.</param>
    /// <param name="state">What is remembered of each pair; <c>default</c> for a pair that is new.</param>
    /// <param name="result">Normal, depth and a witness point of each pair.</param>
    public static void Find(in TShapeWideA a, in TShapeWideB b, in Vector3Wide localOffsetB, in Matrix3x3Wide localOrientationB,
        Vector<float> speculativeMargin, ref DepthSearchStateWide state, out DepthSearchResult result)
    {
        var statistics = default(NoSearchStatistics);
        Find(a, b, localOffsetB, localOrientationB, speculativeMargin, ref state, ref statistics, out result);
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    internal static void Find<TStatistics>(in TShapeWideA a, in TShapeWideB b, in Vector3Wide localOffsetB,
        in Matrix3x3Wide localOrientationB, Vector<float> speculativeMargin, ref DepthSearchStateWide state, ref TStatistics statistics,
        out DepthSearchResult result)
        where TStatistics : struct, ISearchStatistics
    {
        Unsafe.SkipInit(out result);
        SearchFrame.Create<TShapeWideA, TSupportA, TShapeWideB, TSupportB>(
            a, b, localOffsetB, localOrientationB, speculativeMargin, out var frame);
        Unsafe.SkipInit(out SearchDescent descent);
        var knownMask = descent.Start(state, frame);
        Descend(a, b, frame, Vector<int>.AllBitsSet, ref knownMask, ref descent, ref statistics);

        result.Depth = descent.Depth * frame.InverseScale + frame.Margins;
        result.Near = Vector.GreaterThanOrEqual(descent.Depth, frame.LeastDepth) & Vector.GreaterThanOrEqual(result.Depth, -speculativeMargin);
        if (result.Near == Vector<int>.Zero)
        {
            descent.Remember(frame, Vector<int>.Zero, Vector<int>.Zero, Vector<float>.Zero, ref state);
            return;
        }
        var certified = Wide.Mask(knownMask, state.CertifiedDepth * frame.Scale);
        var deep = Vector.GreaterThan(descent.Depth, frame.CertificateSlack);
        var grown = Vector.GreaterThan(descent.Depth, certified * new Vector<float>(DeeperFactor) + frame.CertificateSlack);
        var old = Vector.GreaterThanOrEqual(state.Age, new Vector<int>(LongestAge));
        var dueMask = deep & (grown | old | Vector.OnesComplement(knownMask));
        if (dueMask != Vector<int>.Zero)
            Certify(a, b, frame, dueMask, knownMask, ref descent, ref statistics);
        descent.Remember(frame, deep, dueMask, certified, ref state);

        result.Normal = -descent.Direction;
        result.Depth = descent.Depth * frame.InverseScale + frame.Margins;
        result.PointOnA = PointOnA(frame, descent, TSupportA.Margin(a), TSupportB.Margin(b));
    }

    /// <summary>The witness on A's surface.</summary>
    // A direction that is wrong by an angle misses the point that it looks for by as much of the margin that it is followed through: with a
    // margin that is large beside the other shape, by more than that shape's size. So it starts on the shape with the smaller margin.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector3Wide PointOnA(in SearchFrame frame, in SearchDescent descent, Vector<float> marginA, Vector<float> marginB)
    {
        ref readonly var simplex = ref descent.Simplex;
        var weights = simplex.GetWeights(descent.Target());
        var onA = simplex.A.OnA * weights.X + simplex.B.OnA * weights.Y + simplex.C.OnA * weights.Z;
        var fromA = onA + descent.Direction * marginA;
        var isOnB = Vector.GreaterThan(marginA, marginB);
        if (isOnB == Vector<int>.Zero)
            return fromA;
        var onB = simplex.A.OnB * weights.X + simplex.B.OnB * weights.Y + simplex.C.OnB * weights.Z;
        var fromB = frame.OffsetB + Matrix3x3Wide.TransposeTimes(frame.OrientationB, onB) +
            descent.Direction * (descent.Depth * frame.InverseScale + marginA);
        return Vector3Wide.Select(isOnB, fromB, fromA);
    }

    /// <summary>Farthest point of the difference along a direction.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void Support(in TShapeWideA a, in TShapeWideB b, in SearchFrame frame, in Vector3Wide direction, Vector<int> doneMask,
        out SearchVertex vertex)
    {
        vertex.OnA = TSupportA.Support(a, direction, doneMask);
        vertex.OnB = TSupportB.Support(b, -(frame.OrientationB * direction), doneMask);
        vertex.Point = frame.Difference(vertex.OnA, vertex.OnB);
    }
}
