using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.Constraints;

/// <summary>Solves all joints of a structure at once.</summary>
// A sweep moves a load over one joint: a chain of a hundred knows its weight after a hundred of them, and until then it stretches. Here the joints of a
// structure, which the sweeps leave out, are solved together in each substep, after the sweeps over contacts, limits and motors have said what these want. So
// these see the joints by the impulses of the last substep, and the joints see all that they have done.
sealed unsafe partial class DirectStage(Solver solver, Bodies bodies, BufferPool pool) : ISolverStage
{
    const int MaximumBlocks = 16;
    const int BundlesPerBlock = 8;
    // Of what is as stiff as can be where it may not be rigid, as a part of its own K: 1 / (w h (w h + 2)).
    static readonly double hardSoftness = SubstepStiffness.DirectSoftness;
    // Of a spring that is so soft that it does nothing.
    const double LeastMassScale = 1e-12;

    DirectPlan plan;
    // Which joint each lane of the type batches that are left out is, type batch by type batch.
    Buffer<int> nodeOfLane;
    Buffer<double> numbers;
    Buffer<DirectPair> jacobians;
    Buffer<DirectPair> weighted;
    Buffer<DirectRow> rows;
    int bundleCount;

    /// <summary>Chooses joints anew.</summary>
    internal void Replace(in DirectPlan next)
    {
        Dispose();
        plan = next;
        if (plan.IsEmpty)
        {
            plan.Dispose(pool);
            return;
        }
        pool.Take(plan.NumberCount, out numbers);
        pool.Take(plan.JacobianCount, out jacobians);
        pool.Take(plan.JacobianCount, out weighted);
        pool.Take(plan.RowCount, out rows);
        FindLanes();
    }

    // After the joints have gone where they are left out.
    void FindLanes()
    {
        bundleCount = 0;
        foreach (ref var batch in LeftOut.TypeBatches.AsSpan())
            bundleCount += batch.BundleCount;
        pool.Take(bundleCount * Vector<float>.Count, out nodeOfLane);
        for (int i = 0; i < plan.Nodes.Count; ++i)
        {
            ref var node = ref plan.Nodes[i];
            node.Index = solver.Locations[node.Handle.Slot].IndexInTypeBatch;
            nodeOfLane[FirstLane(node.TypeId) + node.Index] = i;
        }
    }

    int FirstLane(int typeId)
    {
        ref var typeBatches = ref LeftOut.TypeBatches;
        int first = 0;
        for (int i = 0; typeBatches[i].TypeId != typeId; ++i)
            first += typeBatches[i].BundleCount * Vector<float>.Count;
        return first;
    }

    /// <summary>Whether there is any joint to solve.</summary>
    internal bool HasJoints => !plan.IsEmpty;

    bool ISolverStage.BeginStep() => HasJoints;

    int ISolverStage.GetBlockCount(SolverPoint point) => point switch
    {
        SolverPoint.BeforeWarmStart => BundleBlocks,
        SolverPoint.AfterWarmStart or SolverPoint.AfterSolve => IslandBlocks,
        _ => 0,
    };

    int BundleBlocks => Math.Min(MaximumBlocks, (bundleCount + BundlesPerBlock - 1) / BundlesPerBlock);

    int IslandBlocks => Math.Min(MaximumBlocks, plan.Islands.Count);

    void ISolverStage.Execute(SolverPoint point, in Substep substep, int block)
    {
        switch (point)
        {
            case SolverPoint.BeforeWarmStart:
                ReadBundles(substep, block);
                break;
            case SolverPoint.AfterWarmStart:
                for (int i = block; i < plan.Islands.Count; i += IslandBlocks)
                    Begin(plan.Islands[i], substep);
                break;
            case SolverPoint.AfterSolve:
                for (int i = block; i < plan.Islands.Count; i += IslandBlocks)
                    Solve(plan.Islands[i]);
                break;
        }
    }

    DirectEquations Equations => new(plan, numbers.Memory, jacobians.Memory, weighted.Memory, rows.Memory);

    /// <summary>The joints that are solved here, as the sweeps leave them out. There are some.</summary>
    internal ref ConstraintBatch LeftOut => ref solver.ActiveSet.Batches[Solver.FindBatch(solver.ActiveSet, BatchKind.Direct)];

    void ReadBundles(in Substep substep, int block)
    {
        var start = bundleCount * block / BundleBlocks;
        var end = bundleCount * (block + 1) / BundleBlocks;
        ref var set = ref bodies.Awake;
        var awake = new SolverBodies(set);
        Span<ConstraintRowWide> wide = stackalloc ConstraintRowWide[DirectEquations.MostRows];
        var ofJoints = substep.Directly();
        var ofBounds = substep.DirectlyWithBounds();
        int first = 0;
        foreach (ref var batch in LeftOut.TypeBatches.AsSpan())
        {
            var processor = solver.Processor(batch.TypeId);
            var hasBounds = processor.LimitOf(0) != RowLimit.None;
            for (int bundle = Math.Max(0, start - first); bundle < Math.Min(end - first, batch.BundleCount); ++bundle)
            {
                var rowsOfBundle = wide[..processor.RowCount];
                processor.ReadRows(ref batch, awake, hasBounds ? ofBounds : ofJoints, bundle, rowsOfBundle);
                var lanes = Math.Min(Vector<float>.Count, batch.ConstraintCount - bundle * Vector<float>.Count);
                for (int lane = 0; lane < lanes; ++lane)
                {
                    ref var node = ref plan.Nodes[nodeOfLane[(first + bundle) * Vector<float>.Count + lane]];
                    ReadLane(rowsOfBundle, lane, ref node);
                    if (rowsOfBundle[0].HardMask[lane] == 0)
                        continue;
                    var corrects = !hasBounds || CorrectsAll(rowsOfBundle, lane, node, substep);
                    if (solver.ChoosesDirectJoints)
                        Ease(node, processor, rowsOfBundle, lane, set.LocalInertias, substep.Dt, corrects);
                    if (corrects && node.Limit != RowLimit.Length)
                        Limit(node, processor, set, substep.Dt);
                }
            }
            first += batch.BundleCount;
        }
    }

    void ReadLane(Span<ConstraintRowWide> wide, int lane, ref DirectNode node)
    {
        var j = jacobians.Memory + node.Jacobian;
        for (int i = 0; i < node.RowCount; ++i)
        {
            // Bodies of a Jacobian lie side by side.
            for (int slot = 0; slot < node.BodyCount; ++slot, ++j)
            {
                ref var ofBody = ref wide[i].Of(slot);
                j->Linear = ReadLane(ofBody.Linear, lane);
                j->Angular = ReadLane(ofBody.Angular, lane);
            }
            ref var row = ref rows[node.FirstRow + i];
            row.Target = wide[i].TargetVelocity[lane];
            row.Softness = Softness(wide[i], lane, node);
            row.Impulse = wide[i].Impulse[lane];
        }
        node.MostImpulse = wide[0].MaximumImpulse[lane];
    }

    // A structure without loops bears joints that do not give at all. What has bounds may say the same as the joint beside it.
    double Softness(in ConstraintRowWide row, int lane, in DirectNode node)
    {
        if (row.HardMask[lane] == 0)
            return row.ImpulseScale[lane] / Math.Max(row.MassScale[lane], LeastMassScale);
        if (node.HasBounds || HasLoops(node))
            return hardSoftness;
        return 0;
    }

    // A limit with slack left, a servo on its way at its greatest speed and a motor do not correct an error.
    static bool CorrectsAll(ReadOnlySpan<ConstraintRowWide> wide, int lane, in DirectNode node, in Substep substep)
    {
        if (node.Limit == RowLimit.Positive)
            return wide[0].PositionError[lane] < 0;
        double error = 0, target = 0;
        for (int row = 0; row < node.RowCount; ++row)
        {
            error += wide[row].PositionError[lane] * (double)wide[row].PositionError[lane];
            target += wide[row].TargetVelocity[lane] * (double)wide[row].TargetVelocity[lane];
        }
        var frequencyDt = (double)substep.Servos.RigidFrequencyDt;
        var whole = frequencyDt / (frequencyDt + 2) * substep.InverseDt;
        return error > 0 && target > 0.99 * 0.99 * whole * whole * error;
    }

    void Limit(in DirectNode node, TypeProcessor processor, in BodySet set, float dt) => Correction.Limit(
        node, processor, jacobians.Memory + node.Jacobian, rows.Memory + node.FirstRow, plan.Bodies, set.LocalInertias, set.MotionStates, dt);

    // By address: an element of a vector is a copy of it otherwise.
    static Vector256<double> ReadLane(in Vector3Wide wide, int lane)
    {
        ref var x = ref Unsafe.Add(ref Unsafe.As<Vector3Wide, float>(ref Unsafe.AsRef(in wide)), lane);
        return Vector256.Create(x, Unsafe.Add(ref x, Vector<float>.Count), Unsafe.Add(ref x, 2 * Vector<float>.Count), 0d);
    }

    bool HasLoops(in DirectNode node) => plan.Islands[node.Island].HasLoops;

    // What is beyond all numbers is not written into a whole structure because of one of its bodies: that one will be stopped.
    void Begin(in DirectIsland island, in Substep substep)
    {
        ReadBodies(island);
        Equations.WarmStart(island, substep.WarmStartScale);
        if (IsSound(island))
        {
            WriteVelocities(island);
            return;
        }
        for (int i = island.FirstRow; i < island.EndRow; ++i)
            rows[i].Impulse = 0;
        WriteImpulses(island);
    }

    void Solve(in DirectIsland island)
    {
        ReadVelocities(island);
        Equations.Solve(island);
        if (!IsSound(island))
            return;
        WriteVelocities(island);
        WriteImpulses(island);
    }

    // No comparison holds of what is no number.
    bool IsSound(in DirectIsland island)
    {
        for (int i = island.FirstBody; i < island.EndBody; ++i)
        {
            if (!(DirectPair.Sum(DirectPair.Multiply(plan.Bodies[i].Velocity, plan.Bodies[i].Velocity)) <= Limits.GreatestSoundSquare))
                return false;
        }
        return true;
    }

    void WriteImpulses(in DirectIsland island)
    {
        ref var leftOut = ref LeftOut;
        for (int i = island.FirstNode; i < island.EndNode; ++i)
        {
            ref var node = ref plan.Nodes[i];
            ref var batch = ref leftOut.TypeBatches[leftOut.Find(node.TypeId)];
            var processor = solver.Processor(node.TypeId);
            for (int row = 0; row < node.RowCount; ++row)
                processor.Impulse(ref batch, node.Index, row) = (float)rows[node.FirstRow + row].Impulse;
        }
    }

    void ReadBodies(in DirectIsland island)
    {
        ref var set = ref bodies.Awake;
        for (int i = island.FirstBody; i < island.EndBody; ++i)
        {
            ref var body = ref plan.Bodies[i];
            ref var inertia = ref set.WorldInertias[body.Reference & EncodedBody.IndexMask];
            body.InverseMass = inertia.InverseMass;
            ref var tensor = ref inertia.InverseInertiaTensor;
            body.InverseInertiaX = Vector256.Create(tensor.XX, tensor.YX, tensor.ZX, 0d);
            body.InverseInertiaY = Vector256.Create(tensor.YX, tensor.YY, tensor.ZY, 0d);
            body.InverseInertiaZ = Vector256.Create(tensor.ZX, tensor.ZY, tensor.ZZ, 0d);
        }
        ReadVelocities(island);
    }

    void ReadVelocities(in DirectIsland island)
    {
        ref var set = ref bodies.Awake;
        for (int i = island.FirstBody; i < island.EndBody; ++i)
        {
            ref var body = ref plan.Bodies[i];
            ref var velocity = ref set.MotionStates[body.Reference & EncodedBody.IndexMask].Velocity;
            body.Velocity.Linear = Widen(velocity.Linear);
            body.Velocity.Angular = Widen(velocity.Angular);
        }
    }

    // Kinematic bodies may be of several structures, and nothing moves them.
    void WriteVelocities(in DirectIsland island)
    {
        ref var set = ref bodies.Awake;
        for (int i = island.FirstBody; i < island.EndBody; ++i)
        {
            ref var body = ref plan.Bodies[i];
            if ((body.Reference & EncodedBody.KinematicFlag) != 0)
                continue;
            ref var velocity = ref set.MotionStates[body.Reference & EncodedBody.IndexMask].Velocity;
            velocity.Linear = Narrow(body.Velocity.Linear);
            velocity.Angular = Narrow(body.Velocity.Angular);
        }
    }

    static Vector256<double> Widen(Vector3 v) => Vector256.Create(v.X, v.Y, v.Z, 0d);

    static Vector3 Narrow(Vector256<double> v) => new((float)v[0], (float)v[1], (float)v[2]);

    /// <summary>Gives all memory back.</summary>
    internal void Dispose()
    {
        plan.Dispose(pool);
        if (!numbers.Allocated)
            return;
        pool.Return(ref numbers);
        pool.Return(ref jacobians);
        pool.Return(ref weighted);
        pool.Return(ref rows);
        pool.Return(ref nodeOfLane);
    }

    /// <summary>Forgets all memory, which the pool has given back to the system.</summary>
    internal void Abandon()
    {
        plan = default;
        numbers = default;
        jacobians = weighted = default;
        rows = default;
        nodeOfLane = default;
    }
}
