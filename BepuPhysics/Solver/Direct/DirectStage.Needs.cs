using System;
using System.Numerics;
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
                ref var island = ref plan.Islands[i];
                for (int lane = 0; lane < island.MemberCount; ++lane)
                {
                    if (!island.IsAskedFor[lane])
                        return true;
                }
            }
            return false;
        }
    }

    /// <summary>Before the joints say what they bear.</summary>
    internal void BeginNeeds()
    {
        for (int i = 0; i < plan.Islands.Count; ++i)
            plan.Islands[i].IsAskedFor = default;
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
                    var member = memberOfLane[(first + bundle) * Vector<float>.Count + lane];
                    ref var need = ref solver.NeedOf(plan.Members[member].Handle);
                    var scale = JointScale.Of(processor, ref batch, plan.Members[member].Index, errors, lane, set);
                    var (sag, turn) = Yield(member, processor, ref batch, substep);
                    if (errors.RigidMask[lane] != 0 && IsHeavy(processor, sag, turn, scale, slip))
                        need.Ask();
                    else
                        need.Rest(time);
                    // Whoever writes it writes the same.
                    if (need.Asks > 0)
                        plan.IslandOf(member).IsAskedFor[member % DirectPlan.Lanes] = true;
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
    (double Sag, double Turn) Yield(int member, TypeProcessor processor, ref TypeBatch batch, in Substep substep)
    {
        var frequencyDt = substep.Joints.RigidFrequencyDt;
        for (int slot = 0; slot < processor.BodiesPerConstraint; ++slot)
        {
            // The mark of a kinematic body is not looked at.
            if ((processor.BodyReference(ref batch, plan.Members[member].Index, slot) & EncodedBody.HubFlag) != 0)
                frequencyDt = MathHelper.Min(frequencyDt, substep.Hubs.RigidFrequencyDt);
        }
        var scale = (double)substep.Dt / (frequencyDt * frequencyDt);
        var (linear, angular) = plan.IslandOf(member).Lanes switch
        {
            1 => VelocityByLoad<OneVector, OneNumber>(member, processor),
            DirectPlan.FourLanes => VelocityByLoad<ManyVectors<FourNumbers>, FourNumbers>(member, processor),
            _ => VelocityByLoad<ManyVectors<EightNumbers>, EightNumbers>(member, processor),
        };
        return (scale * linear, scale * angular);
    }

    // Lengths of K lambda, along directions and about axes.
    (double Linear, double Angular) VelocityByLoad<TVectors, TNumbers>(int member, TypeProcessor processor)
        where TVectors : unmanaged, IVectors<TVectors, TNumbers> where TNumbers : unmanaged, INumbers<TNumbers>
    {
        ref var node = ref plan.Nodes[member / DirectPlan.Lanes];
        var equations = new DirectMemory<TVectors, TNumbers>(memory.Memory, plan.Islands[node.Island]);
        Span<DirectPair<TVectors, TNumbers>> changes = stackalloc DirectPair<TVectors, TNumbers>[Solver.MaximumBodiesPerConstraint];
        changes.Clear();
        for (int row = 0; row < node.RowCount; ++row)
        {
            for (int slot = 0; slot < node.BodyCount; ++slot)
                changes[slot].Add(equations.Weighted[node.Jacobian + row * node.BodyCount + slot], equations.Rows[node.FirstRow + row].Impulse);
        }
        double linear = 0, angular = 0;
        for (int row = 0; row < node.RowCount; ++row)
        {
            TVectors sum = default;
            for (int slot = 0; slot < node.BodyCount; ++slot)
                sum += DirectPair<TVectors, TNumbers>.Multiply(equations.Jacobians[node.Jacobian + row * node.BodyCount + slot], changes[slot]);
            var values = TVectors.Sum(sum);
            var value = DirectLane.Of(ref values, member % DirectPlan.Lanes);
            if (processor.IsLinear(row))
                linear += value * value;
            else
                angular += value * value;
        }
        return (Math.Sqrt(linear), Math.Sqrt(angular));
    }
}
