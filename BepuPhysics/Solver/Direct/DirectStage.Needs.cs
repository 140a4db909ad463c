using System;
using System.Numerics;
using System.Runtime.Intrinsics;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.Constraints;

// Where the solver chooses how joints are solved: what those that are solved at once bear.
sealed unsafe partial class DirectStage
{
    /// <summary>Bundles of the joints that are solved here.</summary>
    internal int BundleCount => plan.IsEmpty ? 0 : bundleCount;

    /// <summary>Whether there is a structure of which no joint asks to be solved at once any more.</summary>
    internal bool HasQuietIsland
    {
        get
        {
            for (int i = 0; i < plan.Islands.Count; ++i)
            {
                if (!plan.Islands[i].IsAskedFor)
                    return true;
            }
            return false;
        }
    }

    /// <summary>Before the joints say what they bear.</summary>
    internal void BeginNeeds()
    {
        for (int i = 0; i < plan.Islands.Count; ++i)
            plan.Islands[i].IsAskedFor = false;
    }

    /// <summary>Says of the joints of some bundles whether their load is one that sweeps hold. The last substep is over.</summary>
    internal void ReadNeeds(in Substep substep, float time, int start, int endBundle)
    {
        ref var set = ref bodies.Awake;
        var awake = new SolverBodies(set);
        var slip = JointNeed.GreatestSlip(substep.Joints.RigidFrequencyDt, substep.Dt);
        int first = 0;
        foreach (ref var batch in LeftOut.TypeBatches.AsSpan())
        {
            var processor = solver.Processor(batch.TypeId);
            var end = solver.MayAsk(batch.TypeId) ? endBundle - first : 0;
            for (int bundle = Math.Max(0, start - first); bundle < Math.Min(end, batch.BundleCount); ++bundle)
            {
                processor.ReadRigidErrors(ref batch, awake, substep, bundle, out var errors);
                var lanes = Math.Min(Vector<float>.Count, batch.ConstraintCount - bundle * Vector<float>.Count);
                for (int lane = 0; lane < lanes; ++lane)
                {
                    ref var node = ref plan.Nodes[nodeOfLane[(first + bundle) * Vector<float>.Count + lane]];
                    ref var need = ref solver.NeedOf(node.Handle);
                    var scale = JointScale.Of(processor, ref batch, node.Index, errors, lane, set);
                    var (sag, turn) = Yield(node, processor, ref batch, substep);
                    if (errors.RigidMask[lane] != 0 && IsHeavy(processor, sag, turn, scale, slip))
                        need.Ask();
                    else
                        need.Rest(time);
                    // Whoever writes it writes the same.
                    if (need.Asks > 0)
                        plan.Islands[node.Island].IsAskedFor = true;
                }
            }
            first += batch.BundleCount;
        }
    }

    // What turns has its gap turn with it as far as its arm goes; the least that it was found by is as much of what it is kept for.
    static bool IsHeavy(TypeProcessor processor, double sag, double turn, in JointScale scale, float slip)
    {
        var tolerance = JointNeed.QuietPart * (double)(scale.Rests ? JointNeed.TolerantAtRest : JointNeed.Tolerance);
        if (turn > tolerance)
            return true;
        return processor.MakesHubs && (sag * sag > tolerance * tolerance * scale.SizeSquared || sag * scale.Leverage > JointNeed.QuietPart * slip);
    }

    // What the load of a joint would bring it to by sweeps, along directions and about axes. A rigid one is a spring of w h = RigidFrequencyDt, which gives way
    // by K lambda h / (w h)^2 under an impulse lambda per substep.
    (double Sag, double Turn) Yield(in DirectNode node, TypeProcessor processor, ref TypeBatch batch, in Substep substep)
    {
        var frequencyDt = substep.Joints.RigidFrequencyDt;
        for (int slot = 0; slot < node.BodyCount; ++slot)
        {
            // The mark of a kinematic body is not looked at.
            if ((processor.BodyReference(ref batch, node.Index, slot) & EncodedBody.HubFlag) != 0)
                frequencyDt = MathHelper.Min(frequencyDt, substep.Hubs.RigidFrequencyDt);
        }
        var scale = (double)substep.Dt / (frequencyDt * frequencyDt);
        var (linear, angular) = VelocityByLoad(node, processor);
        return (scale * linear, scale * angular);
    }

    // Lengths of K lambda, along directions and about axes.
    (double Linear, double Angular) VelocityByLoad(in DirectNode node, TypeProcessor processor)
    {
        Span<DirectPair> changes = stackalloc DirectPair[Solver.MaximumBodiesPerConstraint];
        changes.Clear();
        for (int row = 0; row < node.RowCount; ++row)
        {
            for (int slot = 0; slot < node.BodyCount; ++slot)
                changes[slot].Add(weighted[node.Jacobian + row * node.BodyCount + slot], rows[node.FirstRow + row].Impulse);
        }
        double linear = 0, angular = 0;
        for (int row = 0; row < node.RowCount; ++row)
        {
            var sum = Vector256<double>.Zero;
            for (int slot = 0; slot < node.BodyCount; ++slot)
                sum += DirectPair.Multiply(jacobians[node.Jacobian + row * node.BodyCount + slot], changes[slot]);
            var value = DirectPair.Sum(sum);
            if (processor.IsLinear(row))
                linear += value * value;
            else
                angular += value * value;
        }
        return (Math.Sqrt(linear), Math.Sqrt(angular));
    }

    // A joint that comes from the sweeps is not put right at once. Each is read by one worker.
    void Ease(
        in DirectNode node, TypeProcessor processor, ReadOnlySpan<ConstraintRowWide> wide, int lane, Buffer<BodyInertia> inertias, float substepDt,
        bool corrects)
    {
        ref var need = ref solver.NeedOf(node.Handle);
        if (need.Eases <= 0)
            return;
        if (!corrects)
        {
            need.GoOn(substepDt);
            return;
        }
        double linear = 0, angular = 0;
        for (int row = 0; row < node.RowCount; ++row)
        {
            double error = wide[row].PositionError[lane];
            if (processor.IsLinear(row))
                linear += error * error;
            else
                angular += error * error;
        }
        (linear, angular) = (Math.Sqrt(linear), Math.Sqrt(angular));
        var reach = Correction.Reach(node, processor, jacobians.Memory + node.Jacobian, plan.Bodies, inertias);
        var pace = JointNeed.PaceOf(TurnSquared(node), Math.Max(linear / reach, angular));
        var linearPart = need.CorrectedPart(ref need.Gap, linear, substepDt, pace);
        var angularPart = need.CorrectedPart(ref need.Turn, angular, substepDt, pace);
        need.GoOn(pace * substepDt);
        for (int row = 0; row < node.RowCount; ++row)
            rows[node.FirstRow + row].Target *= processor.IsLinear(row) ? linearPart : angularPart;
    }

    // Of the body that turns fastest.
    float TurnSquared(in DirectNode node)
    {
        ref var motion = ref bodies.Awake.MotionStates;
        float greatest = 0;
        for (int slot = 0; slot < node.BodyCount; ++slot)
        {
            var reference = plan.Bodies[node.Bodies[slot]].Reference;
            greatest = MathHelper.Max(greatest, Exact.LengthSquared(motion[reference & EncodedBody.IndexMask].Velocity.Angular));
        }
        return greatest;
    }
}
