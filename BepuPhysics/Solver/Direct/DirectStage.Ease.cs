using System;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.Constraints;

// How joints that come from the sweeps are put right.
sealed unsafe partial class DirectStage
{
    // A joint that comes from the sweeps is not put right at once. Each is read by one worker. What corrects nothing now, or is a spring, has only to wait.
    static void Ease(in JointLane joint, ref JointNeed need, in BodySet set, in Substep substep, bool corrects)
    {
        var substepDt = substep.Dt;
        if (!corrects)
        {
            need.GoOn(substepDt);
            return;
        }
        var (linear, angular) = joint.Error();
        var turn = TurnSquared(joint, set);
        var opened = OpenedByLoad(joint, set.WorldInertias, substep, need.Shrunk * linear, need.Shrunk * angular);
        var error = Math.Max(linear > 0 ? linear / Correction.Reach(joint, set.LocalInertias) : 0, angular);
        var pace = JointNeed.PaceOf(turn, error);
        if (opened > 1)
            pace *= JointNeed.PaceUnder(opened, error);
        double linearPart = 0, angularPart = 0;
        if (joint.Kind.HasLinear)
            linearPart = need.CorrectedPart(ref need.Gap, linear, substepDt, pace);
        if (joint.Kind.HasAngular)
            angularPart = need.CorrectedPart(ref need.Turn, angular, substepDt, pace);
        need.GoOn(substepDt, pace);
        for (int row = 0; row < joint.RowCount; ++row)
            joint.Target(row) *= joint.IsLinear(row) ? linearPart : angularPart;
    }

    // A joint that was added with a gap closes it as fast as sweeps would. The least way yet; zero where hardly any is left, or where it is another gap.
    static float CloseSlowly(in JointLane joint, in BodySet set, float least)
    {
        var (linear, angular) = joint.Error();
        var way = Math.Max(linear > 0 ? linear / Correction.Reach(joint, set.LocalInertias) : 0, angular);
        if (way <= JointGap.Near || (way > JointGap.GreatestGrowth * least && HasFixed(joint, set)))
            return 0;
        double target = 0;
        for (int row = 0; row < joint.RowCount; ++row)
            target += joint.Target(row) * joint.Target(row);
        var closing = JointGap.RateOf(way) * Math.Sqrt(linear * linear + angular * angular);
        var part = Math.Min(1, closing / Math.Sqrt(target));
        for (int row = 0; row < joint.RowCount && target > 0; ++row)
            joint.Target(row) *= part;
        return Math.Min((float)way, least);
    }

    static bool HasFixed(in JointLane joint, in BodySet set)
    {
        for (int slot = 0; slot < joint.BodyCount; ++slot)
        {
            if (set.LocalInertias[joint.Body(slot)].InverseMass == 0)
                return true;
        }
        return false;
    }

    // Of the body that turns fastest.
    static float TurnSquared(in JointLane joint, in BodySet set)
    {
        float greatest = 0;
        for (int slot = 0; slot < joint.BodyCount; ++slot)
            greatest = MathHelper.Max(greatest, Exact.LengthSquared(set.MotionStates[joint.Body(slot)].Velocity.Angular));
        return greatest;
    }

    // Whether any row has an impulse against its error. Most have none while an error goes.
    static bool BearsAny(in JointLane joint)
    {
        for (int row = 0; row < joint.RowCount; ++row)
        {
            if (-(double)joint.Impulse(row) * joint.PositionError(row) > 0)
                return true;
        }
        return false;
    }

    // What the sweeps would let a joint open to under the load that it bears now, as a part of what it came with, along what it is off by: the greater of that
    // of directions and that of axes.
    static double OpenedByLoad(in JointLane joint, Buffer<BodyInertia> inertias, in Substep substep, double linear, double angular)
    {
        double alongLinear = 0, alongAngular = 0;
        if (!BearsAny(joint))
            return 0;
        for (int row = 0; row < joint.RowCount; ++row)
        {
            // An impulse against the error is what holds a load.
            var along = -(double)joint.Impulse(row) * joint.PositionError(row);
            if (along == 0)
                continue;
            along *= joint.InverseMass(row, inertias);
            if (joint.IsLinear(row))
                alongLinear += along;
            else
                alongAngular += along;
        }
        // As a spring of w h = RigidFrequencyDt it gives way by K lambda h / (w h)^2.
        var frequencyDt = (double)substep.Joints.RigidFrequencyDt;
        var scale = substep.Dt / (frequencyDt * frequencyDt);
        var part = linear > 0 ? scale * alongLinear / (linear * linear) : 0;
        return angular > 0 ? Math.Max(part, scale * alongAngular / (angular * angular)) : part;
    }
}
