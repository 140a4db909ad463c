using System;
using System.Numerics;
using System.Runtime.CompilerServices;

namespace BepuPhysics.Constraints;

// The rows of the joints of all structures are read bundle by bundle, as the sweeps would read them, and each joint's are written where its structure has them.
sealed unsafe partial class DirectStage
{
    // Of what is as stiff as can be where it may not be rigid, as a part of its own K: 1 / (w h (w h + 2)).
    static readonly double hardSoftness = SubstepStiffness.DirectSoftness;

    // Returns whether any joint is on its way from the sweeps.
    bool ReadBundles(in Substep substep, int block)
    {
        var anyEases = false;
        var start = bundleCount * block / BundleBlocks;
        var end = bundleCount * (block + 1) / BundleBlocks;
        var awake = new SolverBodies(bodies.Awake);
        Span<ConstraintRowWide> wide = stackalloc ConstraintRowWide[DirectPlan.MostRows];
        // What a type does not write, it does not have.
        wide.Clear();
        var ofJoints = substep.Directly();
        var ofBounds = substep.DirectlyWithBounds();
        int first = 0;
        foreach (ref var batch in LeftOut.TypeBatches.AsSpan())
        {
            var processor = solver.Processor(batch.TypeId);
            var kind = new JointKind(processor);
            var rows = wide[..kind.RowCount];
            for (int bundle = Math.Max(0, start - first); bundle < Math.Min(end - first, batch.BundleCount); ++bundle)
            {
                processor.ReadRows(ref batch, awake, kind.HasBounds ? ofBounds : ofJoints, bundle, rows);
                for (int lane = 0; lane < Vector<float>.Count; lane += DirectPlan.Lanes)
                {
                    var index = bundle * Vector<float>.Count + lane;
                    var count = Math.Min(DirectPlan.Lanes, batch.ConstraintCount - index);
                    if (count <= 0)
                        continue;
                    var member = first * Vector<float>.Count + index;
                    var easing = anyMayEase ? LanesThatEase(memberOfLane.Memory + member, count) : 0;
                    anyEases |= easing != 0;
                    ReadLanes(kind, rows, lane, ref processor.BodyReference(ref batch, index, 0), member, count, easing, substep);
                }
            }
            first += batch.BundleCount;
        }
        return anyEases;
    }

    // A bit for each joint that is on its way from the sweeps, or closes a gap that it was added with.
    int LanesThatEase(int* members, int count)
    {
        var lanes = 0;
        for (int lane = 0; lane < count; ++lane)
        {
            ref var need = ref solver.NeedOf(plan.Members[members[lane]].Handle);
            lanes |= (need.Eases > 0 || need.Closes ? 1 : 0) << lane;
        }
        return lanes;
    }

    // The joints of a bundle, or as many of them as structures can be side by side.
    void ReadLanes(
        in JointKind kind, ReadOnlySpan<ConstraintRowWide> rows, int firstLane, ref int references, int first, int count, int easing, in Substep substep)
    {
        Span<double> targets = stackalloc double[DirectPlan.MostRows * DirectPlan.MostLanes];
        var members = memberOfLane.Memory + first;
        var isWhole = count == DirectPlan.Lanes && AreOfOneIsland(members);
        var lessened = easing | LanesToLessen(kind, rows, ref references, firstLane, count, substep);
        var mayLessen = lessened != 0;
        for (int row = 0; row < rows.Length && (mayLessen || !isWhole); ++row)
        {
            for (int lane = 0; lane < count; ++lane)
                targets[row * DirectPlan.MostLanes + lane] = JointLane.LaneOf(rows[row].TargetVelocity, firstLane + lane);
        }
        for (var left = lessened; left != 0; left &= left - 1)
        {
            var lane = BitOperations.TrailingZeroCount(left);
            var joint = new JointLane(kind, rows, firstLane + lane, ref Unsafe.Add(ref references, lane), ref targets[lane]);
            Lessen(joint, members[lane], (easing >> lane & 1) != 0, substep);
        }
        if (isWhole)
        {
            if (DirectPlan.Lanes == DirectPlan.FourLanes)
                WriteAll<FourNumbers>(kind, rows, firstLane, mayLessen ? targets : default, members[0] / DirectPlan.Lanes);
            else
                WriteAll<EightNumbers>(kind, rows, firstLane, mayLessen ? targets : default, members[0] / DirectPlan.Lanes);
        }
        for (int lane = 0; lane < count && !isWhole; ++lane)
        {
            var joint = new JointLane(kind, rows, firstLane + lane, ref Unsafe.Add(ref references, lane), ref targets[lane]);
            var lanes = plan.IslandOf(members[lane]).Lanes;
            if (lanes == 1)
                Write<OneVector, OneNumber>(joint, members[lane]);
            else if (lanes == DirectPlan.FourLanes)
                Write<ManyVectors<FourNumbers>, FourNumbers>(joint, members[lane]);
            else
                Write<ManyVectors<EightNumbers>, EightNumbers>(joint, members[lane]);
        }
        for (var left = lessened; left != 0; left &= left - 1)
        {
            var lane = BitOperations.TrailingZeroCount(left);
            GiveWay(new(kind, rows, firstLane + lane, ref Unsafe.Add(ref references, lane), ref targets[lane]), members[lane]);
        }
    }

    // Whether they are the joints of all structures side by side, in this order.
    static bool AreOfOneIsland(int* members)
    {
        for (int lane = 1; lane < DirectPlan.Lanes; ++lane)
        {
            if (members[lane] != members[0] + lane)
                return false;
        }
        return members[0] % DirectPlan.Lanes == 0;
    }

    // A bit for each joint whose targets may be lessened, on its way from the sweeps or not. Most are not: nothing is corrected of limits that are not reached,
    // nor lessened of what is off by little.
    int LanesToLessen(in JointKind kind, ReadOnlySpan<ConstraintRowWide> rows, ref int references, int firstLane, int count, in Substep substep)
    {
        if (kind.Limit == RowLimit.Length)
            return (1 << count) - 1;
        var inertias = bodies.Awake.LocalInertias;
        var dt = substep.Dt;
        var lanes = 0;
        for (int lane = 0; lane < count; ++lane)
        {
            bool isLessened;
            if (kind.Limit == RowLimit.Positive)
                isLessened = JointLane.LaneOf(rows[0].PositionError, firstLane + lane) < 0;
            else
            {
                double linear = 0, angular = 0;
                for (int row = 0; row < rows.Length; ++row)
                {
                    double target = JointLane.LaneOf(rows[row].TargetVelocity, firstLane + lane);
                    if ((kind.LinearRows >> row & 1) != 0)
                        linear += target * target;
                    else
                        angular += target * target;
                }
                isLessened = !Correction.IsSmall(kind.BodyCount, ref Unsafe.Add(ref references, lane), linear * dt * dt, angular * dt * dt, inertias);
            }
            lanes |= (isLessened ? 1 : 0) << lane;
        }
        return lanes;
    }

    // Lessens what a joint is after.
    void Lessen(in JointLane joint, int member, bool eases, in Substep substep)
    {
        ref var set = ref bodies.Awake;
        var corrects = joint.IsHard && (joint.Limit == RowLimit.None || CorrectsAll(joint, substep));
        if (eases)
        {
            ref var need = ref solver.NeedOf(plan.Members[member].Handle);
            if (need.Closes)
            {
                need.Closing = corrects ? CloseSlowly(joint, set, need.Closing) : 0;
                need.Underway += substep.Dt;
                if (need.Closes)
                    return;
            }
            else
                Ease(joint, ref need, set, substep, corrects);
        }
        if (corrects && joint.Limit != RowLimit.Length)
            Correction.Limit(joint, set, substep.Dt);
    }

    void Write<TVectors, TNumbers>(in JointLane joint, int member)
        where TVectors : unmanaged, IVectors<TVectors, TNumbers> where TNumbers : unmanaged, INumbers<TNumbers>
    {
        ref var node = ref plan.Nodes[member / DirectPlan.Lanes];
        ref var island = ref plan.Islands[node.Island];
        var equations = new DirectMemory<TVectors, TNumbers>(memory.Memory, island);
        var softness = HardSoftness(joint.Kind, island);
        var lane = member % DirectPlan.Lanes;
        var pair = equations.Jacobians + node.Jacobian;
        for (int row = 0; row < joint.RowCount; ++row)
        {
            // Bodies of a Jacobian lie side by side.
            for (int slot = 0; slot < joint.BodyCount; ++slot, ++pair)
            {
                ref var j = ref joint.Jacobian(row, slot);
                if (joint.Kind.SeesLinear)
                {
                    DirectLane.Write<TVectors, TNumbers>(
                        ref pair->Linear, lane, j, Unsafe.Add(ref j, Vector<float>.Count), Unsafe.Add(ref j, 2 * Vector<float>.Count));
                }
                DirectLane.Write<TVectors, TNumbers>(
                    ref pair->Angular, lane, Unsafe.Add(ref j, 3 * Vector<float>.Count), Unsafe.Add(ref j, 4 * Vector<float>.Count),
                    Unsafe.Add(ref j, 5 * Vector<float>.Count));
            }
            ref var ofRow = ref equations.Rows[node.FirstRow + row];
            DirectLane.Of(ref ofRow.Target, lane) = joint.Target(row);
            DirectLane.Of(ref ofRow.Softness, lane) = joint.Softness(row, softness);
            DirectLane.Of(ref ofRow.Impulse, lane) = joint.Impulse(row);
        }
        DirectLane.Of(ref equations.Holds[member / DirectPlan.Lanes].MostImpulse, lane) = joint.MaximumImpulse;
    }

    // The joints of all structures side by side at once. Without targets these are what the rows say.
    void WriteAll<TNumbers>(in JointKind kind, ReadOnlySpan<ConstraintRowWide> rows, int firstLane, ReadOnlySpan<double> targets, int joint)
        where TNumbers : unmanaged, INumbers<TNumbers>
    {
        ref var node = ref plan.Nodes[joint];
        ref var island = ref plan.Islands[node.Island];
        var equations = new DirectMemory<ManyVectors<TNumbers>, TNumbers>(memory.Memory, island);
        var softness = HardSoftness(kind, island);
        var isHard = Vector.EqualsAll(rows[0].HardMask, Vector<int>.AllBitsSet);
        // Linear and angular parts, component by component.
        var j = (TNumbers*)(equations.Jacobians + node.Jacobian);
        for (int row = 0; row < rows.Length; ++row)
        {
            for (int slot = 0; slot < kind.BodyCount; ++slot)
            {
                ref var first = ref JointLane.LaneOf(Unsafe.AsRef(in rows[row]).Of(slot).Linear.X, firstLane);
                j += kind.SeesLinear ? 0 : 3;
                for (int i = kind.SeesLinear ? 0 : 3; i < 6; ++i)
                    *j++ = TNumbers.Read(ref Unsafe.Add(ref first, i * Vector<float>.Count));
            }
            ref var ofRow = ref equations.Rows[node.FirstRow + row];
            ofRow.Target = targets.IsEmpty
                ? TNumbers.Read(ref JointLane.LaneOf(rows[row].TargetVelocity, firstLane))
                : TNumbers.Read(ref Unsafe.AsRef(in targets[row * DirectPlan.MostLanes]));
            ofRow.Impulse = TNumbers.Read(ref JointLane.LaneOf(rows[row].Impulse, firstLane));
            ofRow.Softness = TNumbers.Of(softness);
            for (int lane = 0; lane < TNumbers.Count && !isHard; ++lane)
            {
                DirectLane.Of(ref ofRow.Softness, lane) = JointLane.Softness(rows, row, firstLane + lane, softness);
            }
        }
        equations.Holds[joint].MostImpulse = TNumbers.Read(ref JointLane.LaneOf(rows[0].MaximumImpulse, firstLane));
    }

    // A structure without loops bears joints that do not give at all. What has bounds may say the same as the joint beside it.
    static double HardSoftness(in JointKind kind, in DirectIsland island) => kind.HasBounds || island.HasLoops ? hardSoftness : 0;

    // A limit with slack left, a servo on its way at its greatest speed and a motor do not correct an error.
    static bool CorrectsAll(in JointLane joint, in Substep substep)
    {
        if (joint.Limit == RowLimit.Positive)
            return joint.PositionError(0) < 0;
        double error = 0, target = 0;
        for (int row = 0; row < joint.RowCount; ++row)
        {
            error += joint.PositionError(row) * (double)joint.PositionError(row);
            target += joint.TargetVelocity(row) * (double)joint.TargetVelocity(row);
        }
        var frequencyDt = (double)substep.Servos.RigidFrequencyDt;
        var whole = frequencyDt / (frequencyDt + 2) * substep.InverseDt;
        return error > 0 && target > 0.99 * 0.99 * whole * whole * error;
    }
}
