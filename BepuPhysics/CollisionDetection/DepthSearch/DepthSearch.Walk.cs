using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

public static partial class DepthSearch<TShapeWideA, TSupportA, TShapeWideB, TSupportB>
{
    // Steps of a walk. One pair in a hundred of deep cylinders gets there; all others stop long before.
    const int MaximumSteps = 50;
    // Steps that may be steered, by the curvature of round shapes: one in a hundred walks takes as many. A steered step may undo what the one
    // before has won, so those that go around in circles go on without.
    const int SteeredSteps = 20;
    // A direction that is farther than 60 degrees from the best one is not taken as it is: the best direction is tilted towards it by a half.
    const float TiltCosine = 0.5f;
    const float Tilt = 0.5f;
    // Where the simplex comes no closer to its target, tilting is given up.
    const float StalledRatio = 0.9999f;

    /// <summary>Walks from the state's direction to a local minimum of the depth.</summary>
    /// <param name="a">First shapes.</param>
    /// <param name="b">Second shapes.</param>
    /// <param name="frame">Where B is, scale and tolerances.</param>
    /// <param name="activeMask">Lanes to walk in; nothing changes in others.</param>
    /// <param name="knownMask">
    /// Lanes that have a simplex. The others start with the first support point, and so do those whose simplex turns out not to be of the
    /// shapes as they are now.
    /// </param>
    /// <param name="walk">Direction to start in, and simplex; direction, depth and simplex of the minimum.</param>
    /// <param name="statistics">Counts.</param>
    [MethodImpl(MethodImplOptions.NoInlining)]
    static void Walk<TStatistics>(in TShapeWideA a, in TShapeWideB b, in SearchFrame frame, Vector<int> activeMask,
        ref Vector<int> knownMask, ref SearchWalk walk, ref TStatistics statistics)
        where TStatistics : struct, ISearchStatistics
    {
        var seenMask = activeMask;
        var metMask = Vector<int>.Zero;
        if (MayMeet)
        {
            // The simplex of what is known is tried first, unless it is the one point of a meeting: that moves with every tilt.
            var triedMask = activeMask & (Vector.OnesComplement(knownMask) | walk.Simplex.IsPoint());
            if (triedMask != Vector<int>.Zero)
            {
                metMask = Meet(a, b, frame, triedMask, ref walk, ref statistics, out var doneMask);
                seenMask = Vector.AndNot(activeMask, metMask);
                activeMask = Vector.AndNot(activeMask, doneMask);
            }
        }
        if (seenMask != Vector<int>.Zero)
            See(a, b, frame, seenMask, ref knownMask, ref walk, ref statistics);
        // All stops are comparisons that NaN loses, so that lanes without a pair stop.
        activeMask &= Vector.GreaterThanOrEqual(walk.Depth, frame.LeastDepth);
        if (activeMask == Vector<int>.Zero)
            return;
        var wholeMask = knownMask & activeMask;
        if (wholeMask != Vector<int>.Zero)
        {
            // The remembered triangle still is what is closest: most pairs that rest are done here.
            var insideMask = wholeMask & walk.Simplex.FaceOffset(walk.Target(), out var faceOffset);
            var doneMask = Vector.AndNot(insideMask, IsFar(frame, faceOffset.Length(), walk.Depth));
            if (IsRound)
                doneMask |= Vector.AndNot(wholeMask, IsFar(frame, walk.Simplex.EdgeOffset(walk.Target()).Length(), walk.Depth));
            activeMask = Vector.AndNot(activeMask, doneMask);
            if (activeMask == Vector<int>.Zero)
                return;
            wholeMask &= activeMask;
            var triedMask = Vector.AndNot(wholeMask, metMask);
            if (MayMeet && triedMask != Vector<int>.Zero)
            {
                Meet(a, b, frame, triedMask, ref walk, ref statistics, out doneMask);
                activeMask = Vector.AndNot(activeMask, doneMask) & Vector.GreaterThanOrEqual(walk.Depth, frame.LeastDepth);
                if (activeMask == Vector<int>.Zero)
                    return;
                wholeMask &= activeMask;
            }
        }
        var isNew = wholeMask == Vector<int>.Zero;
        ref var curvature = ref walk.Curvature;
        ref var form = ref walk.Form;
        if (IsRound)
            Follow(frame, walk.Vertex, walk.Direction, activeMask, isNew ? 0 : 3, ref curvature, ref walk.Simplex);
        var best = walk.Depth;
        var bestDirection = walk.Direction;
        var betterMask = activeMask;
        var rawMask = Vector<int>.Zero;
        var previousLength = new Vector<float>(float.MaxValue);
        var walkedMask = activeMask;
        for (int i = 1; ; ++i)
        {
            // The tootbird: the origin's projection on the best plane; the origin itself once there is a plane between it and the shape.
            var target = bestDirection * Wide.Max(best, Vector<float>.Zero);
            Vector3Wide offset;
            if (isNew && i == 1)
            {
                offset = target - walk.Vertex.Point;
                form.PointMask = Vector<int>.AllBitsSet;
                form.EdgeMask = Vector<int>.Zero;
                form.Edge = Vector3Wide.Zero;
            }
            else
            {
                walk.Simplex.Add(walk.Vertex, target, activeMask, wholeMask, isNew ? i - 1 : 3, out offset, out form);
            }
            wholeMask = Vector<int>.Zero;
            var length = offset.Length();
            activeMask &= IsFar(frame, length, best) & Vector.GreaterThanOrEqual(best, frame.LeastDepth);
            if (activeMask == Vector<int>.Zero)
                break;
            if (i == MaximumSteps)
            {
                statistics.Capped(activeMask);
                break;
            }
            var stalled = Vector.GreaterThanOrEqual(length, previousLength * new Vector<float>(StalledRatio));
            rawMask = Vector.AndNot(rawMask | stalled, betterMask);
            previousLength = length;

            var straight = offset * (Vector<float>.One / length);
            var direction = straight;
            var freeMask = Vector.AndNot(activeMask, rawMask);
            var steerMask = Vector<int>.Zero;
            var isSteered = IsRound && i <= SteeredSteps;
            if (isSteered)
            {
                // Where a step leads to nothing better and the simplex comes no closer, neither is done any more.
                steerMask = freeMask & curvature.CanSteer(form, bestDirection);
                if (steerMask != Vector<int>.Zero)
                    curvature.Steer(form, offset, length, best, bestDirection, steerMask, IsBothRound, ref direction);
            }
            var tiltMask = Vector.AndNot(freeMask, steerMask) & Vector.GreaterThan(best, Vector<float>.Zero) &
                Vector.LessThan(Vector3Wide.Dot(straight, bestDirection), new Vector<float>(TiltCosine));
            if (tiltMask != Vector<int>.Zero)
            {
                var tilted = bestDirection + straight * new Vector<float>(Tilt);
                direction = Vector3Wide.Select(tiltMask, tilted * (Vector<float>.One / tilted.Length()), direction);
            }
            // A support point that is no farther out than the simplex is to rounding: the simplex is what is closest.
            var limit = Vector3Wide.Dot(target - offset, straight) + frame.Rounding;
            statistics.Evaluated(activeMask);
            Support(a, b, frame, direction, Vector.OnesComplement(activeMask), out walk.Vertex);
            var depth = Vector3Wide.Dot(walk.Vertex.Point, direction);
            betterMask = activeMask & Vector.LessThan(depth, best);
            best = Wide.Select(betterMask, depth, best);
            bestDirection = Vector3Wide.Select(betterMask, direction, bestDirection);
            if (isSteered)
            {
                // Near the minimum steps change the depth by less than its rounding, and still bring the simplex nearer to the target.
                var followMask = betterMask | (activeMask & steerMask & Vector.LessThan(depth, best + frame.Rounding));
                bestDirection = Vector3Wide.Select(followMask, direction, bestDirection);
                if (followMask != Vector<int>.Zero)
                    Follow(frame, walk.Vertex, bestDirection, followMask, isNew ? i : 3, ref curvature, ref walk.Simplex);
            }
            activeMask &= betterMask | tiltMask | steerMask | Vector.GreaterThan(depth, limit);
        }
        walk.Direction = bestDirection;
        walk.Depth = best;
        // New pairs that are apart may never be looked at again.
        if (IsRound)
        {
            var nearMask = knownMask & Vector.GreaterThanOrEqual(best, frame.LeastDepth);
            Spread(frame, walkedMask & (nearMask | Vector.GreaterThan(best, frame.CertificateSlack)), ref walk);
        }
    }

    /// <summary>Finds the depth in the walk's direction, and forgets simplices that are not of the shapes as they are now.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void See<TStatistics>(in TShapeWideA a, in TShapeWideB b, in SearchFrame frame, Vector<int> seenMask, ref Vector<int> knownMask,
        ref SearchWalk walk, ref TStatistics statistics)
        where TStatistics : struct, ISearchStatistics
    {
        statistics.Evaluated(seenMask);
        if (seenMask == Vector<int>.AllBitsSet && knownMask == Vector<int>.Zero)
        {
            // Nothing to keep.
            Support(a, b, frame, walk.Direction, Vector<int>.Zero, out walk.Vertex);
            walk.Depth = Vector3Wide.Dot(walk.Vertex.Point, walk.Direction);
            walk.Simplex.Set(walk.Vertex);
            return;
        }
        Support(a, b, frame, walk.Direction, Vector.OnesComplement(seenMask), out var vertex);
        walk.Vertex.Keep(Vector.OnesComplement(seenMask), vertex);
        walk.Depth = Wide.Select(seenMask, Vector3Wide.Dot(vertex.Point, walk.Direction), walk.Depth);
        knownMask = Vector.AndNot(knownMask, seenMask & walk.Simplex.IsBeyond(walk.Direction, walk.Depth + frame.Tolerance + frame.Rounding));
        walk.Simplex.Keep(knownMask | Vector.OnesComplement(seenMask), walk.Vertex);
    }

    /// <summary>Whether the simplex is farther from its target than a result may be.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<int> IsFar(in SearchFrame frame, Vector<float> length, Vector<float> depth) =>
        Vector.GreaterThan(length + Wide.Min(depth, Vector<float>.Zero), frame.ToleranceAt(depth));
}
