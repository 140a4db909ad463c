using System;
using BepuPhysics.Collidables;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

// Sweeps of pairs that are no balls.
sealed unsafe partial class FastPairs
{
    void FindOfAny(ref FastPair pair, double from, double dt, BufferPool temporary)
    {
        PlaceCentre(pair.A, pair.PoseA, from, out var linearA, out var positionA);
        PlaceCentre(pair.B, pair.PoseB, from, out var linearB, out var positionB);
        if (!pair.Gate.MayMeet(positionA, positionB, linearA, linearB, dt - from))
            return;
        var motion = new SweepMotion
        {
            MaximumT = dt - from,
            Accuracy = new(0, 0, MaximumRoundCount) { TouchingDistance = TouchingPart * pair.Inner },
            LinearA = linearA,
            LinearB = linearB,
            OffsetB = positionB - positionA,
            ReachOfB = pair.Gate.ReachOfB,
        };
        Place(pair.A, pair.ShapeA, pair.PoseA, from, out motion.AngularA, out motion.OrientationA);
        Place(pair.B, pair.ShapeB, pair.PoseB, from, out motion.AngularB, out motion.OrientationB);
        SweepHit hit = default;
        if (pair.IsSensor)
        {
            Sweep(ref pair, motion, temporary, out hit);
            pair.Time = hit.Overlaps ? from : hit.Exists ? from + hit.T : FastPair.Never;
            return;
        }
        motion.MostThinnerOf = pair.SmallerInner;
        if (!TrySweepApart(ref pair, motion, temporary, out hit))
            return;
        if (!hit.Exists)
            return;
        pair.Time = from + hit.T;
        pair.Normal = hit.Normal;
        pair.ArmA = hit.Place - motion.LinearA * hit.T;
        pair.ArmB = hit.Place - motion.OffsetB - motion.LinearB * hit.T;
    }

    // With the thickest cores that are apart; those whose ways take too many rounds are swept with thinner ones. Where these were in the last sweep of the step
    // is where they most likely are, and most pairs never overlap: so these are swept at once.
    bool TrySweepApart(ref FastPair pair, SweepMotion motion, BufferPool temporary, out SweepHit hit)
    {
        if (pair.Level > 0)
            pair.Level = FirstApart(ref pair, motion, pair.Level, -1, temporary);
        for (int level = pair.Level; level < SkinParts.Length; ++level)
        {
            motion.ThinnerPart = SkinParts[level];
            Sweep(ref pair, motion, temporary, out hit);
            if (hit.Overlaps)
            {
                // Most that overlap do so by little.
                pair.Level = FirstApart(ref pair, motion, level + 1, level, temporary);
                level = pair.Level - 1;
            }
            else if (!hit.RanOut)
                return true;
        }
        hit = default;
        return false;
    }

    // Of cores that are not apart all thicker ones overlap too: so the first that are is found by halves. What is within each other however thin it is has
    // none, and no way at all.
    int FirstApart(ref FastPair pair, in SweepMotion motion, int first, int within, BufferPool temporary)
    {
        first = Math.Min(first, SkinParts.Length - 1);
        var apart = SkinParts.Length;
        for (int level = first; apart - within > 1;)
        {
            if (OverlapsAtFirst(ref pair, motion, SkinParts[level], temporary))
                within = level;
            else
                apart = level;
            level = apart == SkinParts.Length ? apart - 1 : apart == first && within < 0 ? first - 1 : (within + apart) / 2;
        }
        return apart;
    }

    // Whether shapes are apart at all is told without a way, and without a turn.
    bool OverlapsAtFirst(ref FastPair pair, SweepMotion motion, double part, BufferPool temporary)
    {
        (motion.ThinnerPart, motion.MaximumT) = (part, 0);
        motion.LinearA = motion.LinearB = motion.AngularA = motion.AngularB = default;
        Sweep(ref pair, motion, temporary, out var hit);
        return hit.Overlaps;
    }

    void PlaceCentre(int body, in RigidPose still, double time, out DoubleVector3 linear, out DoubleVector3 position)
    {
        if (body < 0)
        {
            linear = default;
            position = new(still.Position);
            return;
        }
        ref var mover = ref movers[body];
        linear = mover.Linear;
        position = mover.PositionAt(time);
    }

    void Place(int body, TypedIndex shape, in RigidPose still, double time, out DoubleVector3 angular, out DoubleMatrix3x3 axes)
    {
        angular = default;
        axes = default;
        // The core of a ball is a point.
        if (shape.Type == Sphere.Id)
            return;
        if (body < 0)
        {
            axes = DoubleMatrix3x3.FromQuaternion(still.Orientation);
            return;
        }
        ref var mover = ref movers[body];
        angular = mover.Angular;
        axes = mover.AxesAt(time);
    }

    void Sweep(ref FastPair pair, in SweepMotion motion, BufferPool temporary, out SweepHit hit)
    {
        var children = new AllChildren();
        SweepPairs.Test(motion, pair.ShapeA.Type, PointerTo(pair.ShapeA), pair.ShapeB.Type, PointerTo(pair.ShapeB), ref children, simulation.Shapes,
            temporary, out hit);
        pair.RoundCount += hit.RoundCount;
    }

    struct AllChildren : ISweepFilter
    {
        public readonly bool AllowTest(int childA, int childB) => true;
    }
}
