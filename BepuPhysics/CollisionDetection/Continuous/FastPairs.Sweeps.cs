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
        motion.ThinnerPart = SkinParts[0];
        Sweep(ref pair, motion, temporary, out hit);
        if ((hit.Overlaps || hit.RanOut) && !TrySweepThinner(ref pair, motion, temporary, out hit))
            return;
        if (!hit.Exists)
            return;
        pair.Time = from + hit.T;
        pair.Normal = hit.Normal;
        pair.ArmA = hit.Place - motion.LinearA * hit.T;
        pair.ArmB = hit.Place - motion.OffsetB - motion.LinearB * hit.T;
    }

    // So many parts are tried before it is asked whether any will do: most that overlap do so by little.
    const int PartBeforeThinnest = 2;

    bool TrySweepThinner(ref FastPair pair, SweepMotion motion, BufferPool temporary, out SweepHit hit)
    {
        hit = default;
        for (int i = 1; i < SkinParts.Length; ++i)
        {
            // What is within each other however thin it is has no way at all.
            if (i == PartBeforeThinnest && OverlapsAtFirst(ref pair, motion, SkinParts[^1], temporary))
                return false;
            if (OverlapsAtFirst(ref pair, motion, SkinParts[i], temporary))
                continue;
            motion.ThinnerPart = SkinParts[i];
            Sweep(ref pair, motion, temporary, out hit);
            if (!hit.RanOut)
                return !hit.Overlaps;
        }
        return false;
    }

    // Whether shapes are apart at all is told without a way.
    bool OverlapsAtFirst(ref FastPair pair, SweepMotion motion, double part, BufferPool temporary)
    {
        (motion.ThinnerPart, motion.MaximumT) = (part, 0);
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
