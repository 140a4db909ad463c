using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Diagnostics;
using BepuUtilities.Memory;
using BepuUtilities.TaskScheduling;

namespace BepuPhysics.CollisionDetection;

/// <summary>Finds overlaps within the active tree and between it and the static tree, divided among the workers of a dispatcher.</summary>
/// <remarks>
/// Pairs within a tree meet in one node each, so ranges of nodes are independent pieces of work. Only nodes with a large part of all
/// leaves are too much for one
/// piece: the caller splits their pairs, and the pair of the two roots, until each piece is small. Which pairs are found does not depend
/// on the pieces, and neither does the order within a pair.
/// </remarks>
static unsafe class OverlapFinder
{
    // Several for each worker, so that an unlucky one can leave work to the others.
    const int PiecesPerWorker = 8;
    // Below this many active leaves a dispatch costs more than it saves.
    const int MinimumLeafCountForThreads = 256;

    public static void Find<THandler>(
        in Tree activeTree, in Tree staticTree, BufferPool pool, ref THandler handler, IThreadDispatcher? dispatcher,
        WorldLock world)
        where THandler : struct, IBroadPhaseOverlapHandler
    {
        if (activeTree.LeafCount == 0)
            return;
        var isShared = dispatcher is { ThreadCount: > 1 } && activeTree.LeafCount >= MinimumLeafCountForThreads;
        var runs = isShared ? LeafRuns.Prepare(activeTree, dispatcher!.ThreadCount, pool) : new LeafRuns(activeTree, pool);
        // Handlers are the caller's and may throw.
        try
        {
            if (isShared)
                FindOnWorkers(activeTree, staticTree, runs, pool, ref handler, dispatcher!, world);
            else
                FindOnCaller(activeTree, staticTree, runs, ref handler);
        }
        finally
        {
            runs.Dispose(pool);
        }
    }

    /// <summary>Compiles what is generic over a handler.</summary>
    internal static void Compile<THandler>() where THandler : struct, IBroadPhaseOverlapHandler
    {
        Precompilation.Compile(typeof(OverlapFinder), nameof(Find), typeof(THandler));
        Precompilation.Compile(typeof(OverlapFinder), nameof(FindOnCaller), typeof(THandler));
        Precompilation.Compile(typeof(OverlapFinder), nameof(FindOnWorkers), typeof(THandler));
        Precompilation.Compile(typeof(ActiveConsumer<THandler>));
        Precompilation.Compile(typeof(StaticConsumer<THandler>));
        StagedWork.Compile<FindWork<THandler>>();
        Precompilation.CompileAll(typeof(RunTraversal<THandler, ActiveConsumer<THandler>>));
        Precompilation.CompileAll(typeof(RunTraversal<THandler, StaticConsumer<THandler>>));
    }

    static void FindOnCaller<THandler>(in Tree activeTree, in Tree staticTree, in LeafRuns runs, ref THandler handler)
        where THandler : struct, IBroadPhaseOverlapHandler
    {
        if (activeTree.LeafCount > 1)
            RunTraversal<THandler, ActiveConsumer<THandler>>.FindSelfPairs(
                activeTree, runs, 0, activeTree.NodeCount, int.MaxValue, ref handler, 0);
        RunTraversal<THandler, StaticConsumer<THandler>>.FindPairs(activeTree, runs, staticTree, ref handler, 0);
    }

    static void FindOnWorkers<THandler>(
        in Tree activeTree, in Tree staticTree, in LeafRuns runs, BufferPool pool, ref THandler handler, IThreadDispatcher dispatcher,
        WorldLock world)
        where THandler : struct, IBroadPhaseOverlapHandler
    {
        var work = new FindWork<THandler>
        {
            World = world,
            Handler = handler,
            ActiveTree = activeTree,
            StaticTree = staticTree,
            Runs = runs,
            Pool = pool,
            WorkerCount = dispatcher.ThreadCount,
        };
        try
        {
            StagedWork.Run(ref work, dispatcher);
        }
        finally
        {
            handler = work.Handler;
            work.Pieces.Dispose(pool);
        }
    }

    struct FindWork<THandler> : IStagedWork where THandler : struct, IBroadPhaseOverlapHandler
    {
        public WorldLock World;
        public THandler Handler;
        public Tree ActiveTree, StaticTree;
        public LeafRuns Runs;
        public BufferPool Pool;
        public int WorkerCount;
        public OverlapPieces Pieces;

        public readonly int StageCount => 2;

        public readonly int GetBlockCount(int stage) => stage == 0 ? 1 + Runs.PartCount : Pieces.Order.Count;

        public void Execute(int stage, int block, int workerIndex)
        {
            World.MarkWorker();
            if (stage == 0)
                Prepare(block);
            else
                Find(block, workerIndex);
        }

        // One block cuts the work into pieces, and it alone uses the pool; the others copy the boxes of the leaves.
        void Prepare(int block)
        {
            if (block == 0)
                Pieces = new OverlapPieces(ActiveTree, StaticTree, PiecesPerWorker * WorkerCount, WorkerCount, Pool);
            else
                Runs.FillPart(ActiveTree, block - 1);
        }

        void Find(int block, int workerIndex)
        {
            var piece = Pieces.Order[block];
            if (piece < 0)
            {
                Pieces.GetRange(~piece, out var firstNode, out var endNode);
                RunTraversal<THandler, ActiveConsumer<THandler>>.FindSelfPairs(
                    ActiveTree, Runs, firstNode, endNode, Pieces.LeafLimit, ref Handler, workerIndex);
                return;
            }
            var pair = Pieces.Pairs[piece];
            if (pair.IsStatic)
                RunTraversal<THandler, StaticConsumer<THandler>>.FindPairsBelow(
                    ActiveTree, Runs, StaticTree, pair.Children, ref Handler, workerIndex);
            else
                RunTraversal<THandler, ActiveConsumer<THandler>>.FindSelfPairsBelow(
                    ActiveTree, Runs, pair.Children, ref Handler, workerIndex);
        }
    }

    readonly struct ActiveConsumer<THandler> : IPairConsumer<THandler> where THandler : struct, IBroadPhaseOverlapHandler
    {
        public static void Consume(ref THandler handler, int workerIndex, int* leavesA, int* leavesB, int count)
        {
            for (var i = 0; i < count; ++i)
            {
                var a = leavesA[i];
                var b = leavesB[i];
                handler.Handle(workerIndex, a < b ? a : b, a < b ? b : a, bIsStatic: false);
            }
        }
    }

    readonly struct StaticConsumer<THandler> : IPairConsumer<THandler> where THandler : struct, IBroadPhaseOverlapHandler
    {
        public static void Consume(ref THandler handler, int workerIndex, int* leavesA, int* leavesB, int count)
        {
            for (var i = 0; i < count; ++i)
                handler.Handle(workerIndex, leavesA[i], leavesB[i], bIsStatic: true);
        }
    }
}
