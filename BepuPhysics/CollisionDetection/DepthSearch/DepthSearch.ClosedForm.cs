using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

public static partial class DepthSearch<TShapeWideA, TSupportA, TShapeWideB, TSupportB>
{
    // Part of the smaller radius: what is deeper does not rest, and has many minima.
    const float GreatestRestingDepth = 0.1f;

    static bool HasClosedForm
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => TSupportB.IsCylinder && (TSupportA.IsCylinder || TSupportA.FaceVertexCount > 0);
    }

    /// <summary>
    /// Takes the descent to where shapes that rest on each other, or nearly, are least deep (<see cref="FlatClosedForm{TShapeWideF, TSupportF,
    /// TShapeWideG, TSupportG}"/>), with the point of the difference there in place of the simplex.
    /// </summary>
    /// <param name="a">First shapes.</param>
    /// <param name="b">Second shapes.</param>
    /// <param name="frame">Where B is.</param>
    /// <param name="mask">Lanes to look at.</param>
    /// <param name="descent">Direction, depth, simplex.</param>
    /// <param name="statistics">Counts.</param>
    /// <param name="doneMask">Lanes in which that point is the simplex's target: the descent is over.</param>
    /// <returns>Lanes that were taken there.</returns>
    [MethodImpl(MethodImplOptions.NoInlining)]
    static Vector<int> TryClosedForm<TStatistics>(in TShapeWideA a, in TShapeWideB b, in SearchFrame frame, Vector<int> mask, ref SearchDescent descent,
        ref TStatistics statistics, out Vector<int> doneMask)
        where TStatistics : struct, ISearchStatistics
    {
        doneMask = Vector<int>.Zero;
        var direction = descent.Direction;
        var closedFormMask = FindClosedForm(a, b, frame, mask, ref direction, out var start);
        if (closedFormMask == Vector<int>.Zero)
            return closedFormMask;
        statistics.Evaluated(closedFormMask);
        Support(a, b, frame, direction, Vector.OnesComplement(closedFormMask), out var vertex);
        var depth = Vector3Wide.Dot(vertex.Point, direction);
        closedFormMask &= Vector.LessThan(depth, frame.Smaller * new Vector<float>(GreatestRestingDepth));
        descent.Direction = Vector3Wide.Select(closedFormMask, direction, descent.Direction);
        descent.Depth = Wide.Select(closedFormMask, depth, descent.Depth);
        start.Point = frame.Difference(start.OnA, start.OnB);
        // The points are rounded in two frames.
        doneMask = Vector.AndNot(closedFormMask, IsFar(frame, (descent.Target() - start.Point).Length() - frame.Rounding, descent.Depth));
        var keepMask = Vector.OnesComplement(closedFormMask);
        descent.Vertex.Keep(keepMask, start);
        descent.Simplex.Keep(keepMask, start);
        return closedFormMask;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<int> FindClosedForm(in TShapeWideA a, in TShapeWideB b, in SearchFrame frame, Vector<int> mask, ref Vector3Wide direction,
        out SearchVertex start)
    {
        Unsafe.SkipInit(out start);
        Unsafe.SkipInit(out Vector3Wide onB);
        var closedFormMask = FlatClosedForm<TShapeWideA, TSupportA, TShapeWideB, TSupportB>.Find(
            a, b, frame.OffsetB, frame.OrientationB, mask, ref direction, ref start.OnA, ref onB);
        if (TSupportA.IsCylinder)
        {
            // The side of A and an end of B, or both sides.
            mask = Vector.AndNot(mask, closedFormMask);
            if (mask != Vector<int>.Zero)
            {
                var endMask = FindEndOfB(a, b, frame, mask, ref direction, ref start.OnA, ref onB);
                closedFormMask |= endMask;
                mask = Vector.AndNot(mask, endMask);
            }
            if (mask != Vector<int>.Zero)
            {
                TSupportA.GetCylinder(a, out var radiusA, out var halfA);
                TSupportB.GetCylinder(b, out var radiusB, out var halfB);
                closedFormMask |= SideClosedForm.Find(radiusA, halfA, radiusB, halfB, frame.OffsetB, frame.OrientationB.Y, mask,
                    ref direction, ref start.OnA, ref onB);
            }
        }
        if (closedFormMask != Vector<int>.Zero)
            start.OnB = frame.OrientationB * (onB - frame.OffsetB);
        return closedFormMask;
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
        mask = FlatClosedForm<TShapeWideB, TSupportB, TShapeWideA, TSupportA>.Find(
            b, a, offsetA, orientationA, mask, ref directionA, ref pointOnB, ref pointOnA);
        if (mask == Vector<int>.Zero)
            return mask;
        direction = Vector3Wide.Select(mask, -Matrix3x3Wide.TransposeTimes(axes, directionA), direction);
        onA = Vector3Wide.Select(mask, Matrix3x3Wide.TransposeTimes(axes, pointOnA) + frame.OffsetB, onA);
        onB = Vector3Wide.Select(mask, Matrix3x3Wide.TransposeTimes(axes, pointOnB) + frame.OffsetB, onB);
        return mask;
    }
}
