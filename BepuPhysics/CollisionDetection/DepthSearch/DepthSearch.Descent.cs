using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

// The descent: from a direction to a local minimum of the depth, in all lanes at once. GJK (Gilbert, Johnson and Keerthi 1988) whose target is
// not the origin but its projection on the lowest support plane found so far, the "tootbird" of bepuphysics2. What a lane carries along:
//
//   best direction, best depth    the lowest support plane so far: an upper bound of the least depth, valid whenever the descent ends
//   target                        the origin's projection on that plane; the origin itself once the plane is between it and the shape
//   simplex                       one to three points of the difference A - B, those that span what is closest to the target
//   vertex                        the support point found last, not yet in the simplex
//
//   TryClosedForm | EvaluateStart      a first direction, its depth, its support point
//        |                             done where the remembered triangle still is what is closest
//        v
//   SearchSimplex.Add                  takes the vertex in; offset from the closest point of the simplex to the target
//        |                             done where the offset is within the tolerance, or the pair is apart by more than its margin
//        v
//   ChooseDirection                    along the offset | Newton's step, where a shape is round | blended with the best direction
//        v
//   Support                            a lower plane: new best, and with it a new target
//        |                             done where the point is no farther out than the simplex and nothing else has changed
//        +---> SearchSimplex.Add
//
// Invariants. The best depth never grows, so the target is never inside of the difference and cannot be chased in circles. The points of the
// simplex are points of the shapes. A lane that is done changes nothing any more, and no lane reads another: how long a bundle takes depends on its
// slowest lane, what it finds does not. Every stop is a comparison that NaN loses, so that lanes without a pair stop.
public static partial class DepthSearch<TShapeWideA, TSupportA, TShapeWideB, TSupportB>
{
    // Steps of a descent. One pair in a hundred of deep cylinders gets there; all others stop long before.
    const int MaximumSteps = 50;
    // Steps that may be Newton's, by the curvature of round shapes: one descent in a hundred takes as many. Such a step may undo what the one
    // before has won, so descents that go around in circles go on without.
    const int MaximumNewtonSteps = 20;
    // A direction that is farther than 60 degrees from the best one is blended: the best direction and a half of it.
    const float BlendCosine = 0.5f;
    const float Blend = 0.5f;
    // Where the simplex comes no closer to its target, blending is given up.
    const float StalledRatio = 0.9999f;

    /// <summary>Descends from the state's direction to a local minimum of the depth.</summary>
    /// <param name="a">First shapes.</param>
    /// <param name="b">Second shapes.</param>
    /// <param name="frame">Where B is, scale and tolerances.</param>
    /// <param name="activeMask">Lanes to search; nothing changes in others.</param>
    /// <param name="knownMask">
    /// Lanes that have a simplex. The others start with the first support point, and so do those whose simplex turns out not to be of the
    /// shapes as they are now.
    /// </param>
    /// <param name="descent">Direction to start in, and simplex; direction, depth and simplex of the minimum.</param>
    /// <param name="statistics">Counts.</param>
    // A JIT root of its own; the parts below are inlined into it.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static void Descend<TStatistics>(in TShapeWideA a, in TShapeWideB b, in SearchFrame frame, Vector<int> activeMask,
        ref Vector<int> knownMask, ref SearchDescent descent, ref TStatistics statistics)
        where TStatistics : struct, ISearchStatistics
    {
        activeMask = Start(a, b, frame, activeMask, ref knownMask, out var triangleMask, ref descent, ref statistics);
        if (activeMask == Vector<int>.Zero)
            return;
        var isNew = triangleMask == Vector<int>.Zero;
        ref var curvature = ref descent.Curvature;
        ref var form = ref descent.Form;
        if (IsRound)
            Follow(frame, descent.Vertex, descent.Direction, activeMask, isNew ? 0 : 3, ref curvature, ref descent.Simplex);
        var best = descent.Depth;
        var bestDirection = descent.Direction;
        var betterMask = activeMask;
        var straightMask = Vector<int>.Zero;
        var previousLength = new Vector<float>(float.MaxValue);
        var descendedMask = activeMask;
        for (int i = 1; ; ++i)
        {
            var target = bestDirection * Wide.Max(best, Vector<float>.Zero);
            Vector3Wide offset;
            if (isNew && i == 1)
            {
                offset = target - descent.Vertex.Point;
                form.PointMask = Vector<int>.AllBitsSet;
                form.EdgeMask = Vector<int>.Zero;
                form.Edge = Vector3Wide.Zero;
            }
            else
            {
                descent.Simplex.Add(descent.Vertex, target, activeMask, triangleMask, isNew ? i - 1 : 3, out offset, out form);
            }
            triangleMask = Vector<int>.Zero;
            var length = offset.Length();
            activeMask &= IsFar(frame, length, best) & Vector.GreaterThanOrEqual(best, frame.LeastDepth);
            if (activeMask == Vector<int>.Zero)
                break;
            if (i == MaximumSteps)
            {
                statistics.Capped(activeMask);
                break;
            }
            // Where a step leads to nothing better and the simplex comes no closer, the direction is the offset's as it is, until something is better.
            var stalled = Vector.GreaterThanOrEqual(length, previousLength * new Vector<float>(StalledRatio));
            straightMask = Vector.AndNot(straightMask | stalled, betterMask);
            previousLength = length;

            var straight = offset * (Vector<float>.One / length);
            var takesNewtonSteps = IsRound && i <= MaximumNewtonSteps;
            var direction = ChooseDirection(curvature, form, offset, straight, length, best, bestDirection,
                Vector.AndNot(activeMask, straightMask), takesNewtonSteps, out var newtonMask, out var blendMask);
            // A support point that is no farther out than the simplex is to rounding: the simplex is what is closest.
            var limit = Vector3Wide.Dot(target - offset, straight) + frame.Rounding;
            statistics.Evaluated(activeMask);
            Support(a, b, frame, direction, Vector.OnesComplement(activeMask), out descent.Vertex);
            var depth = Vector3Wide.Dot(descent.Vertex.Point, direction);
            betterMask = activeMask & Vector.LessThan(depth, best);
            best = Wide.Select(betterMask, depth, best);
            bestDirection = Vector3Wide.Select(betterMask, direction, bestDirection);
            if (takesNewtonSteps)
            {
                // Near the minimum steps change the depth by less than its rounding, and still bring the simplex nearer to the target.
                var followMask = betterMask | (activeMask & newtonMask & Vector.LessThan(depth, best + frame.Rounding));
                bestDirection = Vector3Wide.Select(followMask, direction, bestDirection);
                if (followMask != Vector<int>.Zero)
                    Follow(frame, descent.Vertex, bestDirection, followMask, isNew ? i : 3, ref curvature, ref descent.Simplex);
            }
            activeMask &= betterMask | blendMask | newtonMask | Vector.GreaterThan(depth, limit);
        }
        descent.Direction = bestDirection;
        descent.Depth = best;
        // New pairs that are apart may never be looked at again.
        if (IsRound)
        {
            var nearMask = knownMask & Vector.GreaterThanOrEqual(best, frame.LeastDepth);
            Spread(frame, descendedMask & (nearMask | Vector.GreaterThan(best, frame.CertificateSlack)), ref descent);
        }
    }

    /// <summary>Finds the first direction, its depth and its support point.</summary>
    /// <returns>Lanes that are not done.</returns>
    /// <param name="a">First shapes.</param>
    /// <param name="b">Second shapes.</param>
    /// <param name="frame">Where B is, scale and tolerances.</param>
    /// <param name="activeMask">Lanes to search.</param>
    /// <param name="knownMask">Lanes that have a simplex.</param>
    /// <param name="triangleMask">Of the lanes that are not done, those whose simplex is a triangle of an earlier search.</param>
    /// <param name="descent">Direction and simplex to start with.</param>
    /// <param name="statistics">Counts.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<int> Start<TStatistics>(in TShapeWideA a, in TShapeWideB b, in SearchFrame frame, Vector<int> activeMask,
        ref Vector<int> knownMask, out Vector<int> triangleMask, ref SearchDescent descent, ref TStatistics statistics)
        where TStatistics : struct, ISearchStatistics
    {
        var startMask = activeMask;
        var closedFormMask = Vector<int>.Zero;
        if (HasClosedForm)
        {
            // The simplex of what is known is tried first, unless it is the one point of a closed form: that moves with every tilt.
            var triedMask = activeMask & (Vector.OnesComplement(knownMask) | descent.Simplex.IsPoint());
            if (triedMask != Vector<int>.Zero)
            {
                closedFormMask = TryClosedForm(a, b, frame, triedMask, ref descent, ref statistics, out var doneMask);
                startMask = Vector.AndNot(activeMask, closedFormMask);
                activeMask = Vector.AndNot(activeMask, doneMask);
            }
        }
        if (startMask != Vector<int>.Zero)
            EvaluateStart(a, b, frame, startMask, ref knownMask, ref descent, ref statistics);
        activeMask &= Vector.GreaterThanOrEqual(descent.Depth, frame.LeastDepth);
        triangleMask = knownMask & activeMask;
        if (triangleMask == Vector<int>.Zero)
            return activeMask;

        // The remembered triangle still is what is closest: most pairs that rest are done here.
        var insideMask = triangleMask & descent.Simplex.FaceOffset(descent.Target(), out var faceOffset);
        var restingMask = Vector.AndNot(insideMask, IsFar(frame, faceOffset.Length(), descent.Depth));
        if (IsRound)
            restingMask |= Vector.AndNot(triangleMask, IsFar(frame, descent.Simplex.EdgeOffset(descent.Target()).Length(), descent.Depth));
        activeMask = Vector.AndNot(activeMask, restingMask);
        triangleMask &= activeMask;
        if (HasClosedForm)
        {
            var triedMask = Vector.AndNot(triangleMask, closedFormMask);
            if (triedMask != Vector<int>.Zero)
            {
                TryClosedForm(a, b, frame, triedMask, ref descent, ref statistics, out var doneMask);
                activeMask = Vector.AndNot(activeMask, doneMask) & Vector.GreaterThanOrEqual(descent.Depth, frame.LeastDepth);
                triangleMask &= activeMask;
            }
        }
        return activeMask;
    }

    /// <summary>Finds the depth in the descent's direction, and forgets simplices that are not of the shapes as they are now.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void EvaluateStart<TStatistics>(in TShapeWideA a, in TShapeWideB b, in SearchFrame frame, Vector<int> startMask, ref Vector<int> knownMask,
        ref SearchDescent descent, ref TStatistics statistics)
        where TStatistics : struct, ISearchStatistics
    {
        statistics.Evaluated(startMask);
        if (startMask == Vector<int>.AllBitsSet && knownMask == Vector<int>.Zero)
        {
            // Nothing to keep.
            Support(a, b, frame, descent.Direction, Vector<int>.Zero, out descent.Vertex);
            descent.Depth = Vector3Wide.Dot(descent.Vertex.Point, descent.Direction);
            descent.Simplex.Set(descent.Vertex);
            return;
        }
        var keepMask = Vector.OnesComplement(startMask);
        Support(a, b, frame, descent.Direction, keepMask, out var vertex);
        descent.Vertex.Keep(keepMask, vertex);
        descent.Depth = Wide.Select(startMask, Vector3Wide.Dot(vertex.Point, descent.Direction), descent.Depth);
        knownMask = Vector.AndNot(
            knownMask, startMask & descent.Simplex.IsBeyond(descent.Direction, descent.Depth + frame.Tolerance + frame.Rounding));
        descent.Simplex.Keep(knownMask | keepMask, descent.Vertex);
    }

    /// <summary>The direction of the next support point.</summary>
    /// <param name="curvature">How the farthest point moves, of round shapes.</param>
    /// <param name="form">What the simplex is.</param>
    /// <param name="offset">From the closest point of the simplex to the target.</param>
    /// <param name="straight">Unit direction of the offset.</param>
    /// <param name="length">Length of the offset.</param>
    /// <param name="best">Depth in the best direction.</param>
    /// <param name="bestDirection">Best direction.</param>
    /// <param name="freeMask">Lanes in which it may be another than straight.</param>
    /// <param name="takesNewtonSteps">Whether Newton's steps are among them.</param>
    /// <param name="newtonMask">Lanes that take Newton's step.</param>
    /// <param name="blendMask">Lanes whose direction is blended with the best one.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector3Wide ChooseDirection(in SearchCurvature curvature, in SimplexForm form, in Vector3Wide offset, in Vector3Wide straight,
        Vector<float> length, Vector<float> best, in Vector3Wide bestDirection, Vector<int> freeMask, bool takesNewtonSteps, out Vector<int> newtonMask,
        out Vector<int> blendMask)
    {
        var direction = straight;
        newtonMask = Vector<int>.Zero;
        if (takesNewtonSteps)
        {
            newtonMask = freeMask & curvature.HasNewtonStep(form, bestDirection);
            if (newtonMask != Vector<int>.Zero)
                curvature.NewtonStep(form, offset, length, best, bestDirection, newtonMask, IsBothRound, ref direction);
        }
        blendMask = Vector.AndNot(freeMask, newtonMask) & Vector.GreaterThan(best, Vector<float>.Zero) &
            Vector.LessThan(Vector3Wide.Dot(straight, bestDirection), new Vector<float>(BlendCosine));
        if (blendMask != Vector<int>.Zero)
        {
            var blended = bestDirection + straight * new Vector<float>(Blend);
            direction = Vector3Wide.Select(blendMask, blended * (Vector<float>.One / blended.Length()), direction);
        }
        return direction;
    }

    /// <summary>Whether the simplex is farther from its target than a result may be.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<int> IsFar(in SearchFrame frame, Vector<float> length, Vector<float> depth) =>
        Vector.GreaterThan(length + Wide.Min(depth, Vector<float>.Zero), frame.ToleranceAt(depth));
}
