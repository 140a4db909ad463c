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
            hasChanged[block] = ReadSwept(substep, start, Math.Min(end, sweptBundles), time);
        if (end > sweptBundles)
            direct.ReadNeeds(substep, time, Math.Max(start - sweptBundles, 0), end - sweptBundles);
    }

    bool ReadSwept(in Substep substep, int start, int end, float time)
    {
        var slip = JointNeed.GreatestSlip(substep.Joints.RigidFrequencyDt, substep.Dt);
        ref var set = ref bodies.Awake;
        var awake = new SolverBodies(set);
        var anyNew = false;
        var first = 0;
        var turn = new Turn(solver);
        while (first < end && turn.MoveNext())
        {
            ref var batch = ref turn.Current;
            var processor = solver.Processor(batch.TypeId);
            var isTurn = turn.IsOfCurrent;
            for (int bundle = Math.Max(start - first, 0); bundle < Math.Min(end - first, batch.BundleCount); ++bundle)
            {
                var lanes = Math.Min(Vector<float>.Count, batch.ConstraintCount - bundle * Vector<float>.Count);
                if (!isTurn && !AnyNew(batch, bundle * Vector<float>.Count, lanes))
                    continue;
                processor.ReadRigidErrors(ref batch, awake, substep, bundle, out var errors);
                if (!solver.RemembersNeeds && !MayBeOff(errors, slip * slip))
                    continue;
                for (int lane = 0; lane < lanes; ++lane)
                {
                    var index = bundle * Vector<float>.Count + lane;
                    ref var need = ref solver.NeedOf(batch.IndexToHandle[index]);
                    if (!isTurn && !solver.IsNew(need))
                        continue;
                    if (need.Refused <= 0 && IsOff(processor, ref batch, index, errors, lane, set, slip * slip))
                    {
                        anyNew |= need.Ask();
                        solver.RemembersNeeds = true;
                    }
                    else if (isTurn)
                        need.Rest(time);
                }
            }
            first += batch.BundleCount;
        }
        return anyNew;
    }

    bool AnyNew(in TypeBatch batch, int start, int count)
    {
        for (int i = start; i < start + count; ++i)
        {
            if (solver.IsNew(solver.NeedOf(batch.IndexToHandle[i])))
                return true;
        }
        return false;
    }

    // Arms alone are no longer than what joints are judged by.
    static bool MayBeOff(in JointErrorWide errors, float slipSquared)
    {
        var limit = new Vector<float>(JointNeed.Tolerance * JointNeed.Tolerance) * Wide.Min(errors.ArmASquared, errors.ArmBSquared);
        if (Vector.LessThanAny(limit, errors.Linear * errors.Linear) || Vector.LessThanAny(new Vector<float>(JointNeed.Tolerance), errors.Angular))
            return true;
        var slip = new Vector<float>(slipSquared);
        var speed = Wide.Max(errors.TurnASquared * errors.ArmASquared, errors.TurnBSquared * errors.ArmBSquared);
        return Vector.LessThanAny(slip * speed, errors.LinearSlipSquared) ||
            Vector.LessThanAny(slip * Wide.Max(errors.TurnASquared, errors.TurnBSquared), errors.AngularSlipSquared);
    }

    static bool IsOff(
        TypeProcessor processor, ref TypeBatch batch, int index, in JointErrorWide errors, int lane, in BodySet set, float slipSquared)
    {
        var scale = JointScale.Of(processor, ref batch, index, errors, lane, set);
        var tolerance = scale.Rests ? JointNeed.TolerantAtRest : JointNeed.Tolerance;
        var linear = errors.Linear[lane];
        if (errors.Angular[lane] > tolerance || linear > 0 && linear * linear > tolerance * tolerance * scale.SizeSquared)
            return true;
        return scale.Turns && (errors.AngularSlipSquared[lane] > slipSquared * scale.TurnSquared ||
            errors.LinearSlipSquared[lane] > slipSquared * scale.SpeedSquared);
    }

    // The type batches whose joints are looked at in the present step: all, where there are new joints, which are looked at in each.
    ref struct Turn(Solver solver)
    {
        int batch;
        int typeBatch = -1;
        int colour;
        int shuffledColour;

        public readonly ref TypeBatch Current => ref solver.ActiveSet.Batches[batch].TypeBatches[typeBatch];

        // Whether it is their turn.
        public bool IsOfCurrent { get; private set; }

        public bool MoveNext()
        {
            ref var batches = ref solver.ActiveSet.Batches;
            for (; batch < batches.Count; ++batch, typeBatch = -1)
            {
                ref var current = ref batches[batch];
                if (!current.IsSwept)
                    continue;
                var place = current.Kind == BatchKind.Coloured ? colour : current.Kind == BatchKind.Shuffled ? shuffledColour : ColourOfFallback;
                while (++typeBatch < current.TypeBatches.Count)
                {
                    var typeId = current.TypeBatches[typeBatch].TypeId;
                    IsOfCurrent = (place + typeId) % Solver.NeedTurns == solver.NeedTurn;
                    if ((IsOfCurrent || solver.HasNewJoints) && solver.MayAsk(typeId))
                        return true;
                }
                colour += current.Kind == BatchKind.Coloured ? 1 : 0;
                shuffledColour += current.Kind == BatchKind.Shuffled ? 1 : 0;
            }
            return false;
        }
    }
}
