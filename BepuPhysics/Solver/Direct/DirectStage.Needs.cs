using System;
using System.Numerics;
using System.Runtime.Intrinsics;
using BepuUtilities;

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
    internal void ReadNeeds(in Substep substep, float time, int start, int end)
    {
        ref var set = ref bodies.Awake;
        var awake = new SolverBodies(set);
        int first = 0;
        foreach (ref var batch in LeftOut.TypeBatches.AsSpan())
        {
            var processor = solver.Processor(batch.TypeId);
            for (int bundle = Math.Max(0, start - first); bundle < Math.Min(end - first, batch.BundleCount); ++bundle)
            {
                processor.ReadRigidErrors(ref batch, awake, bundle, out var errors);
                var lanes = Math.Min(Vector<float>.Count, batch.ConstraintCount - bundle * Vector<float>.Count);
                for (int lane = 0; lane < lanes; ++lane)
                {
                    ref var node = ref plan.Nodes[nodeOfLane[(first + bundle) * Vector<float>.Count + lane]];
                    ref var need = ref solver.NeedOf(node.Handle);
                    var size = JointNeedStage.SizeSquared(processor, ref batch, node.Index, errors, lane, set);
                    var (sag, turn) = Yield(node, processor, ref batch, substep);
                    if (errors.RigidMask[lane] != 0 && IsHeavy(processor, sag, turn, size))
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

    static bool IsHeavy(TypeProcessor processor, double sag, double turn, float sizeSquared) =>
        turn > JointNeed.QuietTolerance || processor.MakesHubs && sag * sag > JointNeed.QuietTolerance * (double)JointNeed.QuietTolerance * sizeSquared;

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
    void Ease(in DirectNode node, TypeProcessor processor, ReadOnlySpan<ConstraintRowWide> wide, int lane, float substepDt)
    {
        ref var need = ref solver.NeedOf(node.Handle);
        if (need.Eases <= 0)
            return;
        double linear = 0, angular = 0;
        for (int row = 0; row < node.RowCount; ++row)
        {
            double error = wide[row].PositionError[lane];
            if (processor.IsLinear(row))
                linear += error * error;
            else
                angular += error * error;
        }
        var linearPart = need.CorrectedPart(ref need.Gap, Math.Sqrt(linear), substepDt);
        var angularPart = need.CorrectedPart(ref need.Turn, Math.Sqrt(angular), substepDt);
        need.GoOn(substepDt);
        for (int row = 0; row < node.RowCount; ++row)
            rows[node.FirstRow + row].Target *= processor.IsLinear(row) ? linearPart : angularPart;
    }
}
