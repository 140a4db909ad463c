using System;
using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Finds which joints the sweeps do not hold, and which of those that are solved at once they would (JointNeed.cs). At the end of a step.</summary>
// Joints that are swept over take turns. Whose turn it is is said by type and colour, which depend on what a joint hangs together with alone, and not on where
// it lies in memory: so what else there is in the world changes no bit of a structure.
sealed unsafe class JointNeedStage(Solver solver, DirectStage direct, Bodies bodies) : ISolverStage
{
    const int MaximumBlocks = 32;
    const int LeastBundlesPerBlock = 16;
    // Joints of the fallback batch have no colour.
    const int ColourOfFallback = 3;

    readonly bool[] hasChanged = new bool[MaximumBlocks];
    int blockCount;
    int sweptBundles;
    int directBundles;

    /// <summary>Whether the last step has found a joint that begins to ask, or a structure that does not any more.</summary>
    internal bool HasChanged => hasChanged.AsSpan(0, blockCount).Contains(true) || directBundles > 0 && direct.HasQuietIsland;

    bool ISolverStage.ChangesVelocities => false;

    bool ISolverStage.BeginStep()
    {
        blockCount = 0;
        return solver.ChoosesDirectJoints;
    }

    int ISolverStage.GetBlockCount(SolverPoint point)
    {
        if (point != SolverPoint.AfterSubsteps)
            return 0;
        sweptBundles = 0;
        var turn = new Turn(solver);
        while (turn.MoveNext())
            sweptBundles += turn.Current.BundleCount;
        // All in one step: a structure is let go when the last of its joints does not ask any more.
        directBundles = solver.NeedTurn == 0 ? direct.BundleCount : 0;
        if (directBundles > 0)
            direct.BeginNeeds();
        var bundles = sweptBundles + directBundles;
        blockCount = Math.Min(MaximumBlocks, (bundles + LeastBundlesPerBlock - 1) / LeastBundlesPerBlock);
        hasChanged.AsSpan(0, blockCount).Clear();
        return blockCount;
    }

    void ISolverStage.Execute(SolverPoint point, in Substep substep, int block)
    {
        var bundles = sweptBundles + directBundles;
        var start = (int)((long)bundles * block / blockCount);
        var end = (int)((long)bundles * (block + 1) / blockCount);
        // Since they were looked at before, if steps are all as long as this one.
        var time = substep.Dt * solver.LastSubstepCount * Solver.NeedTurns;
        if (start < sweptBundles)
            hasChanged[block] = ReadSwept(start, Math.Min(end, sweptBundles), time);
        if (end > sweptBundles)
            direct.ReadNeeds(substep, time, Math.Max(start - sweptBundles, 0), end - sweptBundles);
    }

    bool ReadSwept(int start, int end, float time)
    {
        ref var set = ref bodies.Awake;
        var awake = new SolverBodies(set);
        var anyNew = false;
        var first = 0;
        var turn = new Turn(solver);
        while (first < end && turn.MoveNext())
        {
            ref var batch = ref turn.Current;
            var processor = solver.Processor(batch.TypeId);
            for (int bundle = Math.Max(start - first, 0); bundle < Math.Min(end - first, batch.BundleCount); ++bundle)
            {
                processor.ReadRigidErrors(ref batch, awake, bundle, out var errors);
                if (!solver.RemembersNeeds && !MayBeOff(errors))
                    continue;
                var lanes = Math.Min(Vector<float>.Count, batch.ConstraintCount - bundle * Vector<float>.Count);
                for (int lane = 0; lane < lanes; ++lane)
                {
                    var index = bundle * Vector<float>.Count + lane;
                    ref var need = ref solver.NeedOf(batch.IndexToHandle[index]);
                    if (need.Refused <= 0 && IsOff(processor, ref batch, index, errors, lane, set))
                    {
                        anyNew |= need.Ask();
                        solver.RemembersNeeds = true;
                    }
                    else
                        need.Rest(time);
                }
            }
            first += batch.BundleCount;
        }
        return anyNew;
    }

    // Arms alone are no longer than what joints are judged by.
    static bool MayBeOff(in JointErrorWide errors)
    {
        var limit = new Vector<float>(JointNeed.Tolerance * JointNeed.Tolerance) * Wide.Min(errors.ArmASquared, errors.ArmBSquared);
        return Vector.LessThanAny(limit, errors.Linear * errors.Linear) ||
            Vector.LessThanAny(new Vector<float>(JointNeed.Tolerance), errors.Angular);
    }

    static bool IsOff(TypeProcessor processor, ref TypeBatch batch, int index, in JointErrorWide errors, int lane, in BodySet set)
    {
        if (errors.Angular[lane] > JointNeed.Tolerance)
            return true;
        var linear = errors.Linear[lane];
        return linear > 0 && linear * linear > JointNeed.Tolerance * JointNeed.Tolerance * SizeSquared(processor, ref batch, index, errors, lane, set);
    }

    /// <summary>Square of the length by which an error of a joint is judged: the least radius of gyration of its bodies about where it holds them.</summary>
    // Infinite where no body of it is moved and turned.
    internal static float SizeSquared(TypeProcessor processor, ref TypeBatch batch, int index, in JointErrorWide errors, int lane, in BodySet set)
    {
        var least = float.PositiveInfinity;
        for (int slot = 0; slot < processor.BodiesPerConstraint; ++slot)
        {
            var reference = processor.BodyReference(ref batch, index, slot);
            if ((reference & EncodedBody.KinematicFlag) != 0)
                continue;
            ref var inertia = ref set.LocalInertias[reference & EncodedBody.IndexMask];
            ref var inverse = ref inertia.InverseInertiaTensor;
            var trace = inverse.XX + inverse.YY + inverse.ZZ;
            var arm = slot == 0 ? errors.ArmASquared[lane] : errors.ArmBSquared[lane];
            // What nothing turns has its arm, or nothing to be judged by.
            if (trace > 0)
                arm += 3 * inertia.InverseMass / trace;
            if (arm > 0)
                least = MathHelper.Min(least, arm);
        }
        return least;
    }

    // The type batches whose joints are looked at in the present step.
    ref struct Turn(Solver solver)
    {
        int batch;
        int typeBatch = -1;
        int colour;

        public readonly ref TypeBatch Current => ref solver.ActiveSet.Batches[batch].TypeBatches[typeBatch];

        public bool MoveNext()
        {
            ref var batches = ref solver.ActiveSet.Batches;
            for (; batch < batches.Count; ++batch, typeBatch = -1)
            {
                ref var current = ref batches[batch];
                var isColoured = current.Kind == BatchKind.Coloured;
                if (!isColoured && current.Kind != BatchKind.Fallback)
                    continue;
                while (++typeBatch < current.TypeBatches.Count)
                {
                    var typeId = current.TypeBatches[typeBatch].TypeId;
                    if (((isColoured ? colour : ColourOfFallback) + typeId) % Solver.NeedTurns == solver.NeedTurn && solver.MayBeDirect(typeId))
                        return true;
                }
                colour += isColoured ? 1 : 0;
            }
            return false;
        }
    }
}
