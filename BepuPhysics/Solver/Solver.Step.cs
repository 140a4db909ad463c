using System;
using System.Collections.Generic;
using System.Runtime.CompilerServices;
using BepuPhysics.Constraints;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Memory;
using BepuUtilities.TaskScheduling;

namespace BepuPhysics;

// One step of the solver: a list of stages, each a number of independent blocks, run by StagedWork on one dispatch.
//
//   for each substep:  integrate bodies;  for each batch: warm start;  for each iteration, for each batch: solve
//   at the end:        integrate poses
//
// Bodies without constraints are moved after that, over the whole step, where the callbacks leave them out of the substeps (Solver.FreeBodies.cs).
//
// With relaxation, poses are integrated after the iterations of each substep, and for each relaxation, for each batch: solve, without
// correction of positions.
//
// Batches are solved in the order of their indices, or those of joints first, in a random order for the substep (Solver.Order.cs).
//
// The fallback batch takes two stages each time: constraints on split bodies, then the mean of the parts of each body.
public sealed unsafe partial class Solver
{
    /// <summary>Something that happens at the beginning or the end of a substep.</summary>
    public delegate void SubstepEvent(int substepIndex);

    /// <summary>Most bundles of constraints per block: so many that claiming a block is cheap against solving it.</summary>
    const int ConstraintBundlesPerBlock = 16;
    /// <summary>Most bundles of bodies per block of integration.</summary>
    const int BodyBundlesPerBlock = 32;
    /// <summary>What the number of blocks of a stage is a multiple of.</summary>
    const int EvenParts = 4;

    /// <summary>Stages that run between the others where a scene asks for them, in this order.</summary>
    internal List<ISolverStage> OptionalStages { get; } = [];

    /// <summary>Called when a substep begins, before its bodies are integrated. Runs on a worker, while the others wait.</summary>
    public event SubstepEvent? SubstepStarted;
    /// <summary>
    /// Called when the constraints of a substep have been solved, and relaxed: with relaxations poses are those of its end, else of its
    /// beginning. Runs on a worker, while the others wait.
    /// </summary>
    public event SubstepEvent? SubstepEnded;

    enum StageKind
    {
        SubstepStarted,
        Integrate,
        WarmStart,
        Solve,
        Relax,
        JoinParts,
        SubstepEnded,
        Optional,
    }

    struct Stage
    {
        public StageKind Kind;
        public IntegrationStage Integration;
        public int Batch;
        public int FirstBlock;
        public int BlockCount;
        // Blocks that are done one after the other, as one: those of small batches in a row. 0 where each is for itself.
        public int BlocksInRow;
        // Whether the first block finds out who is split.
        public bool Splits;
        public SolverPoint Point;
        public int Optional;
        // Index in the list of substeps: to copy one for each stage would take longer than to list the stage.
        public int Substep;
    }

    // Whether the last step changed velocities in an optional stage after its substeps.
    bool endsWithVelocities;

    // Loads are in proportion to the length of the substep. What an impulse has of the rounding of positions is not: a rounding r is recovered
    // as the impulse m r / dt, against a load of m g dt, and is scaled with it. So where a substep is very much longer than the last one, its
    // impulses begin as they are, which is next to nothing: of 0.1 ms and 8 m, r = 5e-7 m, the rounding is many times the load.
    const float GreatestWarmStartScale = 32;

    static float WarmStartScale(float ratio) => ratio > GreatestWarmStartScale ? 1 : ratio;

    internal void Step(float dt, IPoseIntegrator integrator, IThreadDispatcher? dispatcher)
    {
        ref var set = ref bodies.Awake;
        endsWithVelocities = false;
        BeginBreaking();
        if (set.Count == 0)
        {
            Rest();
            return;
        }
        ++stepNumber;
        SortJoints();
        ChooseDirectJoints();
        PreviousDt = previousSubstepDt * LastSubstepCount;
        var substepDt = BeginStep(dt);
        var scale = previousSubstepDt > 0 ? WarmStartScale(substepDt / previousSubstepDt) : 1;
        previousSubstepDt = substepDt;

        var work = new SolveWork
        {
            Solver = this,
            Integrator = integrator,
            SubstepDt = substepDt,
            FirstWarmStartScale = scale,
        };
        // Callbacks and substep events are the game's and may throw.
        try
        {
            work.Bodies = new SolverBodies(set);
            if (!integrator.SubstepsFreeBodies)
                work.FreeBodies = TakeFreeBodies();
            BuildBlocks(ref work);
            BuildStages(ref work);
            integrator.Prepare(substepDt);
            var sharing = IsWorthSharing(work) ? dispatcher : null;
            work.WorkerPools = sharing?.WorkerPools;
            StagedWork.Run(ref work, sharing);
            MoveFreeBodies(work, dt, dispatcher);
            ReadError();
            ReadNeeds();
            BreakOverloaded();
        }
        finally
        {
            Release(ref work);
        }
    }

    /// <summary>A step without bodies.</summary>
    internal void Rest()
    {
        // No memory is kept for what sleeps.
        for (int i = 0; i < OptionalStages.Count; ++i)
            OptionalStages[i].EndStep();
        ForgetDirectJoints();
        ReadNeeds();
        endsWithVelocities = false;
        stepNumber = bodies.Awake.Count + bodies.Asleep.Count == 0 ? 0 : stepNumber + 1;
    }

    // The event is alone with the bodies: it may write to them and ask queries.
    void Raise(SubstepEvent substepEvent, int substep)
    {
        world.BeginEvent();
        try
        {
            substepEvent(substep);
        }
        finally
        {
            world.EndEvent();
        }
    }

    void Release(ref SolveWork work)
    {
        for (int i = 0; i < OptionalStages.Count; ++i)
            OptionalStages[i].EndStep();
        work.Blocks.DisposeIfTaken(pool);
        work.BlocksOfBatch.DisposeIfTaken(pool);
        work.Stages.DisposeIfTaken(pool);
        work.Substeps.DisposeIfTaken(pool);
        work.Order.DisposeIfTaken(pool);
        work.Split.Dispose(pool);
        work.FreeBodies.Dispose(pool);
    }

    void BuildStages(ref SolveWork work)
    {
        BuildOrder(ref work);
        work.Stages = new QuickList<Stage>(64, pool);
        var relaxes = relaxationIterationCount > 0;
        work.Substeps = new QuickList<Substep>(relaxes ? 2 * LastSubstepCount : LastSubstepCount, pool);
        Span<int> optional = stackalloc int[OptionalStages.Count * SolverPoints.Count];
        if (!CountOptional(optional))
            optional = default;
        BeginSubstep(ref work, 0);
        AddOptional(ref work, optional, SolverPoint.BeforeSubsteps);
        AddOptional(ref work, optional, SolverPoint.LastBeforeSubsteps);
        for (int substep = 0; substep < LastSubstepCount; ++substep)
        {
            if (substep > 0)
                BeginSubstep(ref work, substep);
            if (SubstepStarted is not null)
                work.Stages.Add(new() { Kind = StageKind.SubstepStarted, Substep = work.Substep, BlockCount = 1 }, pool);
            AddIntegration(ref work, substep == 0 ? IntegrationStage.First : relaxes ? IntegrationStage.Velocities : IntegrationStage.Between);
            AddOptional(ref work, optional, SolverPoint.AfterIntegration);
            AddOptional(ref work, optional, SolverPoint.BeforeWarmStart);
            if (substep == 0)
            {
                AddOptional(ref work, optional, SolverPoint.BeforeFirstWarmStart);
                AddSplitting(ref work);
                AddOptional(ref work, optional, SolverPoint.AmidBeforeFirstWarmStart);
                AddOptional(ref work, optional, SolverPoint.LastBeforeFirstWarmStart);
            }
            ShuffleOrder(ref work, substep);
            AddSweep(ref work, StageKind.WarmStart, work.Substep);
            AddOptional(ref work, optional, SolverPoint.AfterWarmStart);
            AddOptional(ref work, optional, SolverPoint.LastAfterWarmStart);
            for (int i = work.Iterations; i > 0; --i)
                AddSweep(ref work, StageKind.Solve, work.Substep);
            AddOptional(ref work, optional, SolverPoint.AfterSolve);
            if (relaxes)
            {
                AddIntegration(ref work, IntegrationStage.Poses);
                var relaxation = AddSubstep(ref work, substep, isRelaxation: true);
                for (int i = relaxationIterationCount; i > 0; --i)
                    AddSweep(ref work, StageKind.Relax, relaxation);
            }
            if (SubstepEnded is not null)
                work.Stages.Add(new() { Kind = StageKind.SubstepEnded, Substep = work.Substep, BlockCount = 1 }, pool);
        }
        if (!relaxes)
            AddIntegration(ref work, IntegrationStage.Last);
        AddOptional(ref work, optional, SolverPoint.AfterSubsteps);
    }

    // Blocks beyond the first of each stage are what other threads can take off the caller: few of them are done before one is awake. The parts of
    // split bodies are not counted yet, and are not few.
    static bool IsWorthSharing(in SolveWork work)
    {
        const int leastBlocks = 16;
        var others = 0;
        for (int i = 0; i < work.Stages.Count && others < leastBlocks; ++i)
            others += work.Stages[i].BlockCount < 0 ? leastBlocks : Math.Max(0, work.Stages[i].BlockCount - 1);
        return others >= leastBlocks;
    }

    void BeginSubstep(ref SolveWork work, int substep)
    {
        work.Iterations = IterationsOf(substep);
        work.Substep = AddSubstep(ref work, substep, isRelaxation: false);
    }

    // With one or two, what is a few centimetres long falls by so much in a substep that all of it would be an impact, and no load ever be found: heaps of
    // 2 cm cubes sank in by three times as much.
    const int LeastSubstepsForLanding = 4;

    int AddSubstep(ref SolveWork work, int substep, bool isRelaxation)
    {
        var scale = substep == 0 ? work.FirstWarmStartScale : 1;
        work.Substeps.Add(
            new(substep, work.SubstepDt, scale, work.Iterations, relaxationIterationCount, isRelaxation, usualSubstepDt, contactFrequency)
            {
                Lands = stopsImpacts && LastSubstepCount >= LeastSubstepsForLanding,
            }, pool);
        return work.Substeps.Count - 1;
    }

    void AddIntegration(ref SolveWork work, IntegrationStage stage)
    {
        var blocks = EvenBlockCount(BundleIndexing.GetBundleCount(bodies.Awake.Count), BodyBundlesPerBlock);
        work.Stages.Add(new() { Kind = StageKind.Integrate, Integration = stage, BlockCount = blocks }, pool);
    }

    int IterationsOf(int substep)
    {
        var scheduled = VelocityIterationScheduler?.Invoke((int)((long)substep * substepCount / LastSubstepCount)) ?? 0;
        return scheduled < 1 ? velocityIterationCount : scheduled;
    }

    // Blocks of all optional stages at all points: asked for once, as most steps have none and there are many points.
    bool CountOptional(Span<int> blocks)
    {
        var any = false;
        for (int i = 0; i < OptionalStages.Count; ++i)
        {
            var stage = OptionalStages[i];
            if (!stage.BeginStep())
            {
                blocks.Slice(i * SolverPoints.Count, SolverPoints.Count).Clear();
                continue;
            }
            for (int point = 0; point < SolverPoints.Count; ++point)
            {
                var count = stage.GetBlockCount((SolverPoint)point);
                blocks[i * SolverPoints.Count + point] = count;
                any |= count > 0;
            }
            endsWithVelocities |= blocks[i * SolverPoints.Count + (int)SolverPoint.AfterSubsteps] > 0 && stage.ChangesVelocities;
        }
        return any;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    void AddOptional(ref SolveWork work, ReadOnlySpan<int> blocks, SolverPoint point)
    {
        if (!blocks.IsEmpty)
            AddOptionalAt(ref work, blocks, point);
    }

    void AddOptionalAt(ref SolveWork work, ReadOnlySpan<int> blocks, SolverPoint point)
    {
        for (int i = 0; i * SolverPoints.Count < blocks.Length; ++i)
        {
            var count = blocks[i * SolverPoints.Count + (int)point];
            if (count > 0)
                work.Stages.Add(new() { Kind = StageKind.Optional, Substep = work.Substep, Point = point, Optional = i, BlockCount = count }, pool);
        }
    }

    bool IsFallback(int batch) => ActiveSet.Batches[batch].Kind == BatchKind.Fallback;

    static int BlockCount(int count, int perBlock) => (count + perBlock - 1) / perBlock;

    struct SolveWork : IStagedWork
    {
        public Solver Solver;
        public IPoseIntegrator Integrator;
        public float SubstepDt;
        // The substep for which stages are being listed, and its sweeps.
        public int Substep;
        public int Iterations;
        public float FirstWarmStartScale;
        public SolverBodies Bodies;
        public FreeBodies FreeBodies;
        public FallbackParts Split;
        public QuickList<Stage> Stages;
        public QuickList<Substep> Substeps;
        public QuickList<Block> Blocks;
        public QuickList<BlockRange> BlocksOfBatch;
        // Batches in random order, as the present substep sweeps over them.
        public QuickList<Drawn> Order;
        // None without other workers.
        public WorkerBufferPools? WorkerPools;

        public readonly int StageCount => Stages.Count;

        public readonly int GetBlockCount(int stageIndex)
        {
            ref var stage = ref Stages[stageIndex];
            return (stage.Splits ? 1 : 0) + stage.Kind switch
            {
                StageKind.JoinParts => Split.JoinBlockCount,
                StageKind.Optional => Solver.OptionalStages[stage.Optional].CountBlocks(stage.Point, stage.BlockCount),
                _ => stage.BlockCount,
            };
        }

        public void Execute(int stageIndex, int blockIndex, int workerIndex)
        {
            ref var stage = ref Stages[stageIndex];
            if (stage.Splits && blockIndex-- == 0)
            {
                Solver.BuildSplitBodies(ref Split);
                return;
            }
            switch (stage.Kind)
            {
                case StageKind.Integrate:
                    var above = stackalloc byte[StackLine.Length];
                    var line = stackalloc byte[StackLine.BytesBelow(above, sizeof(byte))];
                    *line = 0;
                    var bundles = BundleIndexing.GetBundleCount(Solver.bodies.Awake.Count);
                    var blockCount = EvenBlockCount(bundles, BodyBundlesPerBlock);
                    Integrator.Integrate(stage.Integration, SubstepDt, FreeBodies, StartOfBlock(blockIndex, blockCount, bundles),
                        StartOfBlock(blockIndex + 1, blockCount, bundles), workerIndex);
                    break;
                case StageKind.WarmStart:
                case StageKind.Solve:
                case StageKind.Relax:
                    var firstBlock = stage.FirstBlock + blockIndex;
                    var end = firstBlock + Math.Max(1, stage.BlocksInRow);
                    for (int i = firstBlock; i < end; ++i)
                        RunConstraints(stage, Blocks[i]);
                    break;
                case StageKind.JoinParts:
                    Split.Join(ref Solver.bodies.Awake, blockIndex);
                    break;
                case StageKind.Optional:
                    Solver.OptionalStages[stage.Optional].Execute(stage.Point, Substeps[stage.Substep], blockIndex, WorkerPools?[workerIndex] ?? Solver.pool);
                    break;
                case StageKind.SubstepStarted:
                    Solver.Raise(Solver.SubstepStarted!, Substeps[stage.Substep].Index);
                    break;
                case StageKind.SubstepEnded:
                    Solver.Raise(Solver.SubstepEnded!, Substeps[stage.Substep].Index);
                    break;
            }
        }

        readonly void RunConstraints(in Stage stage, in Block block)
        {
            ref var constraints = ref Solver.ActiveSet.Batches[block.Batch];
            var (start, end) = (block.StartBundle, block.EndBundle);
            for (int i = 0; end > 0; ++i)
            {
                ref var batch = ref constraints.TypeBatches[i];
                var bundles = batch.BundleCount;
                if (start < bundles)
                    RunConstraints(stage, constraints.Kind, i, ref batch, Math.Max(0, start), Math.Min(end, bundles));
                start -= bundles;
                end -= bundles;
            }
        }

        readonly void RunConstraints(in Stage stage, BatchKind kind, int index, ref TypeBatch batch, int start, int end)
        {
            var processor = Solver.Processor(batch.TypeId);
            // A loop is the frame of what is inlined into it.
            var above = stackalloc byte[StackLine.Length];
            var line = stackalloc byte[StackLine.BytesBelow(above, sizeof(byte))];
            *line = 0;
            ref readonly var substep = ref Substeps[stage.Substep];
            if (kind == BatchKind.Fallback)
            {
                var split = Split.For(index);
                if (stage.Kind == StageKind.WarmStart)
                    processor.WarmStartSplit(ref batch, Bodies, split, substep, start, end);
                else
                    processor.SolveSplit(ref batch, Bodies, split, substep, start, end);
            }
            else if (stage.Kind == StageKind.WarmStart)
                processor.WarmStart(ref batch, Bodies, substep, start, end);
            else
                processor.Solve(ref batch, Bodies, substep, start, end);
        }
    }
}
