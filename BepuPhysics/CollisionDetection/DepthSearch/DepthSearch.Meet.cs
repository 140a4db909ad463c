using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

public static partial class DepthSearch<TShapeWideA, TSupportA, TShapeWideB, TSupportB>
{
    // Part of the smaller radius: what is deeper does not rest, and has many minima.
    const float GreatestRestingDepth = 0.1f;

    static bool MayMeet
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => TSupportB.IsCylinder && (TSupportA.IsCylinder || TSupportA.FaceVertexCount > 0);
    }

    /// <summary>
    /// Takes the walk to where shapes that rest on each other, or nearly, are least deep (<see cref="FlatMeeting{TShapeWideF, TSupportF,
    /// TShapeWideG, TSupportG}"/>), with the point of the difference there in place of the simplex.
    /// </summary>
    /// <param name="a">First shapes.</param>
    /// <param name="b">Second shapes.</param>
    /// <param name="frame">Where B is.</param>
    /// <param name="mask">Lanes to look at.</param>
    /// <param name="walk">Direction, depth, simplex.</param>
    /// <param name="statistics">Counts.</param>
    /// <param name="doneMask">Lanes in which that point is the simplex's target: the walk is over.</param>
    /// <returns>Lanes that were taken there.</returns>
    [MethodImpl(MethodImplOptions.NoInlining)]
    static Vector<int> Meet<TStatistics>(in TShapeWideA a, in TShapeWideB b, in SearchFrame frame, Vector<int> mask, ref SearchWalk walk,
        ref TStatistics statistics, out Vector<int> doneMask)
        where TStatistics : struct, ISearchStatistics
    {
        doneMask = Vector<int>.Zero;
        var direction = walk.Direction;
        var metMask = FindMeeting(a, b, frame, mask, ref direction, out var met);
        if (metMask == Vector<int>.Zero)
            return metMask;
        statistics.Evaluated(metMask);
        Support(a, b, frame, direction, Vector.OnesComplement(metMask), out var vertex);
        var depth = Vector3Wide.Dot(vertex.Point, direction);
        metMask &= Vector.LessThan(depth, frame.Smaller * new Vector<float>(GreatestRestingDepth));
        walk.Direction = Vector3Wide.Select(metMask, direction, walk.Direction);
        walk.Depth = Wide.Select(metMask, depth, walk.Depth);
        met.Point = frame.Difference(met.OnA, met.OnB);
        // The points are rounded in two frames.
        doneMask = Vector.AndNot(metMask, IsFar(frame, (walk.Target() - met.Point).Length() - frame.Rounding, walk.Depth));
        var keepMask = Vector.OnesComplement(metMask);
        walk.Vertex.Keep(keepMask, met);
        walk.Simplex.Keep(keepMask, met);
        return metMask;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<int> FindMeeting(in TShapeWideA a, in TShapeWideB b, in SearchFrame frame, Vector<int> mask, ref Vector3Wide direction,
        out SearchVertex met)
    {
        Unsafe.SkipInit(out met);
        Unsafe.SkipInit(out Vector3Wide onB);
        var metMask = FlatMeeting<TShapeWideA, TSupportA, TShapeWideB, TSupportB>.Find(
            a, b, frame.OffsetB, frame.OrientationB, mask, ref direction, ref met.OnA, ref onB);
        if (TSupportA.IsCylinder)
        {
            // The side of A and an end of B, or both sides.
            mask = Vector.AndNot(mask, metMask);
            if (mask != Vector<int>.Zero)
            {
                var endMask = FindEndOfB(a, b, frame, mask, ref direction, ref met.OnA, ref onB);
                metMask |= endMask;
                mask = Vector.AndNot(mask, endMask);
            }
            if (mask != Vector<int>.Zero)
            {
                TSupportA.GetCylinder(a, out var radiusA, out var halfA);
                TSupportB.GetCylinder(b, out var radiusB, out var halfB);
                metMask |= SideMeeting.Find(radiusA, halfA, radiusB, halfB, frame.OffsetB, frame.OrientationB.Y, mask, ref direction, ref met.OnA, ref onB);
            }
        }
        if (metMask != Vector<int>.Zero)
            met.OnB = frame.OrientationB * (onB - frame.OffsetB);
        return metMask;
    }

    /// <summary>The same with the parts of A and B exchanged, in B's frame.</summary>
    [MethodImpl(MethodImplOptions.NoInlining)]
    static Vector<int> FindEndOfB(in TShapeWideA a, in TShapeWideB b, in SearchFrame frame, Vector<int> mask, ref Vector3Wide direction,
        ref Vector3Wide onA, ref Vector3Wide onB)
    {
        ref readonly var axes = ref frame.OrientationB;
        var orientationA = new Matrix3x3Wide(new(axes.X.X, axes.Y.X, axes.Z.X), new(axes.X.Y, axes.Y.Y, axes.Z.Y), new(axes.X.Z, axes.Y.Z, axes.Z.Z));
        var offsetA = -(axes * frame.OffsetB);
        var directionA = -(axes * direction);
        Unsafe.SkipInit(out Vector3Wide pointOnA);
        Unsafe.SkipInit(out Vector3Wide pointOnB);
        mask = FlatMeeting<TShapeWideB, TSupportB, TShapeWideA, TSupportA>.Find(
            b, a, offsetA, orientationA, mask, ref directionA, ref pointOnB, ref pointOnA);
        if (mask == Vector<int>.Zero)
            return mask;
        direction = Vector3Wide.Select(mask, -Matrix3x3Wide.TransposeTimes(axes, directionA), direction);
        onA = Vector3Wide.Select(mask, Matrix3x3Wide.TransposeTimes(axes, pointOnA) + frame.OffsetB, onA);
        onB = Vector3Wide.Select(mask, Matrix3x3Wide.TransposeTimes(axes, pointOnB) + frame.OffsetB, onB);
        return mask;
    }
}
