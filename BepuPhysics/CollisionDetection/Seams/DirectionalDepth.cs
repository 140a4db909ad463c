using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>How deep shapes are in each other along directions that are given, by their farthest points.</summary>
/// <typeparam name="TShapeWideA">Wide form of A's shape.</typeparam>
/// <typeparam name="TSupportA">Farthest points of A.</typeparam>
/// <typeparam name="TShapeWideB">Wide form of B's shape.</typeparam>
/// <typeparam name="TSupportB">Farthest points of B.</typeparam>
static class DirectionalDepth<TShapeWideA, TSupportA, TShapeWideB, TSupportB>
    where TShapeWideA : unmanaged where TSupportA : unmanaged, ISupport<TShapeWideA>
    where TShapeWideB : unmanaged where TSupportB : unmanaged, ISupport<TShapeWideB>
{
    /// <summary>Measures a bundle of pairs.</summary>
    /// <param name="a">First shapes.</param>
    /// <param name="b">Second shapes.</param>
    /// <param name="localOffsetB">Positions of B in A's frame.</param>
    /// <param name="localOrientationB">Axes of B in A's frame, in the rows.</param>
    /// <param name="normal">Unit directions in A's frame.</param>
    /// <param name="fromB">Lanes in which the point is that of the plane beside B's outermost point; A's own outermost point elsewhere.</param>
    /// <param name="done">All bits set in lanes without a pair.</param>
    /// <param name="depth">By how much A has to move along the direction to be off B, m; negative where it is apart.</param>
    /// <param name="point">A point on the plane across the direction that supports A, in A's frame.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Measure(in TShapeWideA a, in TShapeWideB b, in Vector3Wide localOffsetB, in Matrix3x3Wide localOrientationB,
        in Vector3Wide normal, Vector<int> fromB, Vector<int> done, out Vector<float> depth, out Vector3Wide point)
    {
        var pointOnA = TSupportA.Support(a, -normal, done) - normal * TSupportA.Margin(a);
        var pointOnB = Matrix3x3Wide.TransposeTimes(localOrientationB, TSupportB.Support(b, localOrientationB * normal, done)) + localOffsetB +
            normal * TSupportB.Margin(b);
        depth = Vector3Wide.Dot(pointOnB - pointOnA, normal);
        point = Vector3Wide.Select(fromB, pointOnB - normal * depth, pointOnA);
    }
}
