using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
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
    DirectPlan plan;
    // Which member of the plan each lane of the type batches that are left out is, type batch by type batch.
    Buffer<int> memberOfLane;
    // The equations of all structures (DirectMemory.cs).
    Buffer<Vector256<double>> memory;
    // What the loads of joints that are swept over stiffen the rotation of the bodies of the plan by: all of the step.
    Buffer<BodyInertia> sweptStiffness;
    int bundleCount;
    // Whether any joint of a block of bundles was on its way from the sweeps when the block was last read, and whether any was when the step began. When
    // joints have been chosen anew all may be.
    readonly bool[] mayEase = new bool[MaximumBlocks];
    bool anyMayEase;

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
        plan.PlaceMemory();
        pool.Take(plan.MemoryCount, out memory);
        // Lanes without a structure have zeros.
        memory.Clear(0, plan.MemoryCount);
        pool.Take(plan.Bodies.Count, out sweptStiffness);
        pool.Take(plan.Bodies.Count, out blowLoads);
        CountJoints();
        mayEase.AsSpan().Fill(true);
        new DirectArrangement(solver, plan, pool).Arrange(ref LeftOut);
        FindLanes();
    }

    // After the joints have gone where they are left out.
    void FindLanes()
    {
        bundleCount = 0;
        foreach (ref var batch in LeftOut.TypeBatches.AsSpan())
            bundleCount += batch.BundleCount;
        pool.Take(bundleCount * Vector<float>.Count, out memberOfLane);
        for (int i = 0; i < plan.Nodes.Count; ++i)
        {
            ref var node = ref plan.Nodes[i];
            var firstLane = FirstLane(node.TypeId);
            for (int lane = 0; lane < plan.Islands[node.Island].MemberCount; ++lane)
            {
                ref var member = ref plan.Members[i * DirectPlan.Lanes + lane];
                member.Index = solver.Locations[member.Handle.Slot].IndexInTypeBatch;
                memberOfLane[firstLane + member.Index] = i * DirectPlan.Lanes + lane;
            }
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

    /// <summary>Number of structures, equal ones that are solved side by side as one.</summary>
    internal int IslandCount => plan.Islands.Count;

    /// <summary>Whether factors stay that do not depend on who is held, when that changes.</summary>
    internal bool KeepsFactors { get; set; } = true;

    /// <summary>Whether there is any joint to solve.</summary>
    internal bool HasJoints => !plan.IsEmpty;

    bool ISolverStage.BeginStep()
    {
        anyMayEase = HasJoints && mayEase.AsSpan(0, BundleBlocks).Contains(true);
        return HasJoints;
    }

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
                mayEase[block] = ReadBundles(substep, block);
                break;
            case SolverPoint.AfterWarmStart or SolverPoint.AfterSolve:
                for (int i = block; i < plan.Islands.Count; i += IslandBlocks)
                {
                    ref var island = ref plan.Islands[i];
                    if (island.Lanes == 1)
                        Execute<OneVector, OneNumber>(point, island, substep);
                    else if (island.Lanes == DirectPlan.FourLanes)
                        Execute<ManyVectors<FourNumbers>, FourNumbers>(point, island, substep);
                    else
                        Execute<ManyVectors<EightNumbers>, EightNumbers>(point, island, substep);
                }
                break;
        }
    }

    void Execute<TVectors, TNumbers>(SolverPoint point, in DirectIsland island, in Substep substep)
        where TVectors : unmanaged, IVectors<TVectors, TNumbers> where TNumbers : unmanaged, INumbers<TNumbers>
    {
        if (point == SolverPoint.AfterWarmStart)
            Begin<TVectors, TNumbers>(island, substep);
        else
            Solve<TVectors, TNumbers>(island, substep);
    }

    /// <summary>The joints that are solved here, as the sweeps leave them out. There are some.</summary>
    internal ref ConstraintBatch LeftOut => ref solver.ActiveSet.Batches[Solver.FindBatch(solver.ActiveSet, BatchKind.Direct)];

    // What is beyond all numbers is not written into a whole structure because of one of its bodies: that one will be stopped.
    void Begin<TVectors, TNumbers>(in DirectIsland island, in Substep substep)
        where TVectors : unmanaged, IVectors<TVectors, TNumbers> where TNumbers : unmanaged, INumbers<TNumbers>
    {
        var equations = new DirectMemory<TVectors, TNumbers>(memory.Memory, island);
        ReadInertias(island, equations);
        ReadVelocities(island, equations);
        var system = new DirectEquations<TVectors, TNumbers>(plan, island, equations, KeepsFactors);
        system.WarmStart(substep.WarmStartScale);
        if (substep.Index == 0)
            FindTouched(island);
        if (touched[IndexOf(island)] is var lanes and not 0)
        {
            system.Solve(DirectLane.MaskOf<TNumbers>(lanes));
            SolveBlows(island, equations, substep, lanes);
        }
        var sound = SoundLanes(island, equations);
        WriteVelocities(island, equations, sound);
        for (int lane = 0; lane < island.MemberCount; ++lane)
        {
            if ((sound >> lane & 1) != 0)
                continue;
            for (int i = island.FirstRow; i < island.EndRow; ++i)
                DirectLane.Of(ref equations.Rows[i].Impulse, lane) = 0;
            WriteImpulses(island, equations, 1 << lane);
        }
    }

    void Solve<TVectors, TNumbers>(in DirectIsland island, in Substep substep)
        where TVectors : unmanaged, IVectors<TVectors, TNumbers> where TNumbers : unmanaged, INumbers<TNumbers>
    {
        var equations = new DirectMemory<TVectors, TNumbers>(memory.Memory, island);
        ReadVelocities(island, equations);
        new DirectEquations<TVectors, TNumbers>(plan, island, equations, KeepsFactors).Solve(TNumbers.All, isFactored: touched[IndexOf(island)] != 0);
        SolveBlows(island, equations, substep, (1 << island.MemberCount) - 1);
        var sound = SoundLanes(island, equations);
        WriteVelocities(island, equations, sound);
        WriteImpulses(island, equations, sound);
    }

    // No comparison holds of what is no number.
    static int SoundLanes<TVectors, TNumbers>(in DirectIsland island, in DirectMemory<TVectors, TNumbers> equations)
        where TVectors : unmanaged, IVectors<TVectors, TNumbers> where TNumbers : unmanaged, INumbers<TNumbers>
    {
        var sound = TNumbers.All;
        for (int i = island.FirstBody; i < island.EndBody; ++i)
        {
            ref var velocity = ref equations.Bodies[i].Velocity;
            var square = TVectors.Sum(DirectPair<TVectors, TNumbers>.Multiply(velocity, velocity));
            sound &= TNumbers.AtMost(square, TNumbers.Of(Limits.GreatestSoundSquare));
        }
        return TNumbers.Bits(sound);
    }

    void WriteImpulses<TVectors, TNumbers>(in DirectIsland island, in DirectMemory<TVectors, TNumbers> equations, int lanes)
        where TVectors : unmanaged, IVectors<TVectors, TNumbers> where TNumbers : unmanaged, INumbers<TNumbers>
    {
        ref var leftOut = ref LeftOut;
        for (int i = island.FirstNode; i < island.EndNode; ++i)
        {
            ref var node = ref plan.Nodes[i];
            ref var batch = ref leftOut.TypeBatches[leftOut.Find(node.TypeId)];
            var processor = solver.Processor(node.TypeId);
            if (TNumbers.Count == DirectPlan.Lanes && lanes == (1 << DirectPlan.Lanes) - 1 && AreAdjacent(i))
            {
                ref var first = ref processor.Impulse(ref batch, plan.Members[i * DirectPlan.Lanes].Index, 0);
                for (int row = 0; row < node.RowCount; ++row)
                    equations.Rows[node.FirstRow + row].Impulse.Write(ref Unsafe.Add(ref first, row * Vector<float>.Count));
                continue;
            }
            for (int lane = 0; lane < island.MemberCount; ++lane)
            {
                if ((lanes >> lane & 1) == 0)
                    continue;
                var impulse = (float*)Unsafe.AsPointer(ref processor.Impulse(ref batch, plan.Members[i * DirectPlan.Lanes + lane].Index, 0));
                for (int row = 0; row < node.RowCount; ++row)
                    impulse[row * Vector<float>.Count] = (float)DirectLane.Of(ref equations.Rows[node.FirstRow + row].Impulse, lane);
            }
        }
    }

    // Whether the joints of all structures of a full island lie side by side in one bundle.
    bool AreAdjacent(int node)
    {
        var first = plan.Members[node * DirectPlan.Lanes].Index;
        for (int lane = 1; lane < DirectPlan.Lanes; ++lane)
        {
            if (plan.Members[node * DirectPlan.Lanes + lane].Index != first + lane)
                return false;
        }
        return first % DirectPlan.Lanes == 0 && plan.Islands[plan.Nodes[node].Island].MemberCount == DirectPlan.Lanes;
    }

    void ReadInertias<TVectors, TNumbers>(in DirectIsland island, in DirectMemory<TVectors, TNumbers> equations)
        where TVectors : unmanaged, IVectors<TVectors, TNumbers> where TNumbers : unmanaged, INumbers<TNumbers>
    {
        ref var set = ref bodies.Awake;
        for (int i = island.FirstBody; i < island.EndBody; ++i)
        {
            ref var body = ref equations.Bodies[i];
            for (int lane = 0; lane < island.MemberCount; ++lane)
            {
                ref var inertia = ref set.WorldInertias[plan.Bodies[i * DirectPlan.Lanes + lane] & EncodedBody.IndexMask];
                DirectLane.Of(ref body.InverseMass, lane) = inertia.InverseMass;
                body.WriteInertia(lane, inertia.InverseInertiaTensor);
            }
        }
    }

    void ReadVelocities<TVectors, TNumbers>(in DirectIsland island, in DirectMemory<TVectors, TNumbers> equations)
        where TVectors : unmanaged, IVectors<TVectors, TNumbers> where TNumbers : unmanaged, INumbers<TNumbers>
    {
        ref var set = ref bodies.Awake;
        for (int i = island.FirstBody; i < island.EndBody; ++i)
        {
            ref var body = ref equations.Bodies[i];
            for (int lane = 0; lane < island.MemberCount; ++lane)
            {
                ref var velocity = ref set.MotionStates[plan.Bodies[i * DirectPlan.Lanes + lane] & EncodedBody.IndexMask].Velocity;
                DirectLane.Write<TVectors, TNumbers>(ref body.Velocity.Linear, lane, velocity.Linear.X, velocity.Linear.Y, velocity.Linear.Z);
                DirectLane.Write<TVectors, TNumbers>(ref body.Velocity.Angular, lane, velocity.Angular.X, velocity.Angular.Y, velocity.Angular.Z);
            }
        }
    }

    // Kinematic bodies may be of several structures, and nothing moves them.
    void WriteVelocities<TVectors, TNumbers>(in DirectIsland island, in DirectMemory<TVectors, TNumbers> equations, int lanes)
        where TVectors : unmanaged, IVectors<TVectors, TNumbers> where TNumbers : unmanaged, INumbers<TNumbers>
    {
        ref var set = ref bodies.Awake;
        for (int i = island.FirstBody; i < island.FirstBody + island.DynamicCount; ++i)
        {
            ref var body = ref equations.Bodies[i];
            for (int lane = 0; lane < island.MemberCount; ++lane)
            {
                if ((lanes >> lane & 1) == 0)
                    continue;
                ref var velocity = ref set.MotionStates[plan.Bodies[i * DirectPlan.Lanes + lane]].Velocity;
                velocity.Linear = DirectLane.Read<TVectors, TNumbers>(ref body.Velocity.Linear, lane);
                velocity.Angular = DirectLane.Read<TVectors, TNumbers>(ref body.Velocity.Angular, lane);
            }
        }
    }

    /// <summary>Before the loads of a substep are added to what is there of joints that are swept over.</summary>
    internal void BeginLoads(bool isFirst, Buffer<BodyInertia> stiffness)
    {
        foreach (ref var island in plan.Islands.AsSpan())
        {
            for (int i = island.FirstBody; i < island.FirstBody + island.DynamicCount; ++i)
            {
                for (int place = i * DirectPlan.Lanes; place < i * DirectPlan.Lanes + island.MemberCount; ++place)
                {
                    ref var row = ref stiffness[plan.Bodies[place]];
                    if (isFirst)
                        sweptStiffness[place] = row;
                    else
                        (row.InverseInertiaTensor, row.InverseMass) = (sweptStiffness[place].InverseInertiaTensor, sweptStiffness[place].InverseMass);
                }
            }
        }
    }

    /// <summary>Gives all memory back.</summary>
    internal void Dispose()
    {
        plan.Dispose(pool);
        if (!memory.Allocated)
            return;
        pool.Return(ref memory);
        pool.Return(ref memberOfLane);
        pool.Return(ref sweptStiffness);
        pool.Return(ref blowLoads);
        pool.Return(ref jointCounts);
        pool.Return(ref touched);
    }

    /// <summary>Forgets all memory, which the pool has given back to the system.</summary>
    internal void Abandon()
    {
        plan = default;
        memory = default;
        memberOfLane = default;
        sweptStiffness = default;
        blowLoads = default;
        jointCounts = default;
        touched = default;
    }
}
