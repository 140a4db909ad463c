using System;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;
using BepuUtilities.TaskScheduling;

namespace BepuPhysics.CollisionDetection;

// From overlapping bounds to pairs that are tested.
public sealed unsafe partial class NarrowPhase<TCallbacks>
{
    /// <summary>Active leaves up to which the game is asked about a pair as soon as it is found.</summary>
    // So many bodies' margins stay in the second cache, so that a pair need not wait for them.
    const int LeavesToAskFirst = 4096;
    const float NotAsked = -1;

    // Bytes of pairs, their constraints and their histories up to which these stay in the second cache, from which they come in less time than a queue takes.
    const int BytesNearby = 3 << 18;
    // About what a pair has in the cache, and a constraint in its columns.
    const int BytesPerPair = 256;

    Crowd crowd;
    bool asksFirst;
    // Whether what is known of pairs and their constraints is so little that nothing has to be asked for ahead.
    bool isNearby;
    TurnsOfThread turns;
    // Pairs that were refused in the last step: nothing of a step depends on it but the time that it takes.
    long refusedPairCount;

    // Receives overlapping pairs of the broad phase.
    readonly struct Overlaps(NarrowPhase<TCallbacks> narrowPhase, BroadPhase broadPhase) : IBroadPhaseOverlapHandler
    {
        public void Handle(int workerIndex, int leafA, int leafB, bool bIsStatic) => narrowPhase.Enqueue(
            workerIndex, broadPhase.ActiveLeaves[leafA],
            bIsStatic ? broadPhase.StaticLeaves[leafB] : broadPhase.ActiveLeaves[leafB], leafA, bIsStatic ? -1 : leafB);
    }

    // The same where some collidables were given layers.
    readonly struct LayeredOverlaps(NarrowPhase<TCallbacks> narrowPhase, BroadPhase broadPhase, CollidableLayers layers) : IBroadPhaseOverlapHandler
    {
        public void Handle(int workerIndex, int leafA, int leafB, bool bIsStatic)
        {
            var a = broadPhase.ActiveLeaves[leafA];
            var b = bIsStatic ? broadPhase.StaticLeaves[leafB] : broadPhase.ActiveLeaves[leafB];
            if (CollisionLayers.MayMeet(layers.Of(a), layers.Of(b)))
                narrowPhase.Enqueue(workerIndex, a, b, leafA, bIsStatic ? -1 : leafB);
        }
    }

    internal override void FindContacts(float dt, IThreadDispatcher? dispatcher)
    {
        var count = dispatcher?.ThreadCount ?? 1;
        if (workers.Length < count)
            Array.Resize(ref workers, count);
        readsEarly = count > 1;
        BeginRims(dt);
        FastPairs.BeginDetection();
        try
        {
            if (crowd.CountsFirst)
                crowd.Count(Simulation.Bodies, Simulation.BroadPhase, Simulation.Layers, Pool, dispatcher);
            if (!TryTestPairs(count, dt, dispatcher))
            {
                ReleaseWorkers();
                ForgetContacts();
                AgreedPairs.Clear();
                crowd.Count(Simulation.Bodies, Simulation.BroadPhase, Simulation.Layers, Pool, dispatcher);
                TryTestPairs(count, dt, dispatcher);
            }
            AgreeAtSeams(count, dispatcher);
            long skipped = 0, refused = 0;
            for (int i = 0; i < count; ++i)
            {
                skipped += workers[i].SkippedPairCount;
                refused += workers[i].RefusedPairCount;
            }
            SkippedPairCount = skipped;
            refusedPairCount = refused;
        }
        catch
        {
            // Callbacks are the game's and may throw: the step is lost, the memory is not.
            order.DisposeIfTaken(Pool);
            ReleaseWorkers();
            AgreedPairs.Clear();
            throw;
        }
        finally
        {
            crowd.End(Pool);
        }
    }

    /// <summary>Tests the overlapping pairs, unless they are too many.</summary>
    bool TryTestPairs(int workerCount, float dt, IThreadDispatcher? dispatcher)
    {
        CollisionTaskRegistry.CheckTypes(Simulation.Shapes);
        Pairs.BeginStep();
        asksFirst = IsWorthAskingFirst(Simulation.BroadPhase.ActiveTree.LeafCount);
        isNearby = IsNearby(Simulation.BroadPhase.ActiveTree.LeafCount);
        crowd.Begin(Simulation.BroadPhase.ActiveTree.LeafCount);
        var room = RoomForNotes(Simulation.BroadPhase.ActiveTree.LeafCount, workerCount);
        for (int i = 0; i < workerCount; ++i)
            Begin(ref workers[i], i, dt, workerCount == 1 ? null : dispatcher, workerCount, room);
        // Overlaps of few leaves are found on the caller, so what there is to be flushed is its, too.
        var helpers = IsWorthSharing() ? dispatcher : null;
        FindOverlaps(helpers);
        for (int i = 0; i < workerCount; ++i)
            crowd.AddRest(workers[i].PairsLeft);
        if (crowd.HasTooMany)
            return false;
        var flush = new FlushWork { NarrowPhase = this, WorkerCount = workerCount };
        StagedWork.Run(ref flush, helpers);
        return true;
    }

    // A pair that had contacts takes about as long as eight leaves without any; less than this in all is done before another thread is awake.
    bool IsWorthSharing()
    {
        const int leavesPerPair = 8;
        const int leastLeaves = 2048;
        return Simulation.BroadPhase.ActiveTree.LeafCount + (long)PairCount * leavesPerPair >= leastLeaves;
    }

    // Two instances of the same loop, so that layers cost nothing where there are none.
    void FindOverlaps(IThreadDispatcher? dispatcher)
    {
        if (Simulation.Layers.IsUsed)
        {
            var layered = new LayeredOverlaps(this, Simulation.BroadPhase, Simulation.Layers);
            Simulation.BroadPhase.FindOverlapsOfLeaves(ref layered, dispatcher);
            return;
        }
        var handler = new Overlaps(this, Simulation.BroadPhase);
        Simulation.BroadPhase.FindOverlapsOfLeaves(ref handler, dispatcher);
    }

    void Begin(ref Worker worker, int index, float dt, IThreadDispatcher? dispatcher, int workerCount, int room)
    {
        worker.Queue.Clear();
        worker.Pool = dispatcher is null ? Pool : dispatcher.WorkerPools[index];
        if (worker.Pool != Pool)
            worker.Pool.AddUser(this);
        worker.Batcher = new CollisionBatcher<Completion>(
            worker.Pool, Simulation.Shapes, CollisionTaskRegistry, dt, new Completion(this, index), Pairs.Histories.Memory);
        worker.TestedPairs = new WaitingList<TestedPair>(CollisionTaskRegistry.TaskCount * PairBatch.Capacity);
        worker.Contacts.Clear(isNearby);
        worker.Rims = default;
        worker.Room = room;
        // What is remembered waits again, with whichever worker finds it.
        worker.Statics.Room = Math.Max(room, Math.Min(AgreedPairs.Pairs.Length, 2 * AgreedPairs.Pairs.Length / workerCount));
        worker.PairsLeft = Crowd.PairsPerReport;
        worker.SkippedPairCount = worker.RefusedPairCount = 0;
    }

    // Tests what is left in the batchers of all workers.
    struct FlushWork : IStagedWork
    {
        public NarrowPhase<TCallbacks> NarrowPhase;
        public int WorkerCount;

        public readonly int StageCount => 1;
        public readonly int GetBlockCount(int stage) => WorkerCount;
        // A batcher may be emptied by another worker than filled it: one batcher is one block, so no two touch it at once.
        public readonly void Execute(int stage, int block, int workerIndex)
        {
            NarrowPhase.World.MarkWorker();
            while (NarrowPhase.workers[block].Queue.TryTakeLast(out var pair, out var margin))
                NarrowPhase.TestPair(block, pair, NarrowPhase.Pairs.Pairs.IndexOf(pair), margin);
            NarrowPhase.workers[block].Batcher.Flush();
            NarrowPhase.workers[block].Contacts.Flush(NarrowPhase.Simulation.Solver);
        }
    }

    // The second leaf is negative for one of the static tree.
    void Enqueue(int workerIndex, CollidableReference a, CollidableReference b, int leafA, int leafB)
    {
        // Of two bodies the second one sleeps here.
        if (leafB < 0 && !Wakes(a))
            return;
        // The constraint of a pair has its bodies in one order for ever.
        if (ComesSecond(a, b))
            (a, b) = (b, a);
        if (a.Mobility != CollidableMobility.Dynamic && !IsSensed(a, b))
            return;
        ref var worker = ref workers[workerIndex];
        if (leafB >= 0 && !Admits(ref worker, leafA, leafB))
            return;
        var found = new CollidablePair(a, b);
        var margin = NotAsked;
        if (asksFirst && !AskFirst(workerIndex, found, ref margin))
            return;
        if (isNearby)
        {
            TestPair(workerIndex, found, Pairs.Pairs.IndexOf(found), margin);
            return;
        }
        worker.Queue.Add(Pairs, Simulation.Bodies, Simulation.Statics, found, margin);
        if (worker.Queue.TryTake(out var pair, out var guess, out margin))
            TestPair(workerIndex, pair, Pairs.IndexOf(pair, guess), margin);
    }

    // Only where many were refused in the last step. Of a pair with a sensor the game is asked only if somebody listens.
    bool IsWorthAskingFirst(int leafCount) =>
        leafCount <= LeavesToAskFirst && refusedPairCount > leafCount / 2 && !Simulation.Events.UsesSensors;

    // Of a world that takes turns with many others on this thread nothing is.
    bool IsNearby(int leafCount)
    {
        var bytes = (long)PairCount * BytesPerPair +
            (long)Pairs.Histories.Count * sizeof(PairHistory) + (long)Pairs.Parents.Count * sizeof(ParentHistory);
        return turns.Count(bytes) <= BytesNearby && leafCount <= LeavesToAskFirst;
    }

    // A pair that is refused here is spared the queue: parts of one character are most of the pairs that it has.
    bool AskFirst(int workerIndex, in CollidablePair pair, ref float margin)
    {
        margin = MarginOf(pair.A);
        if (pair.B.Mobility != CollidableMobility.Static)
            margin += MarginOf(pair.B);
        return IsAllowed(workerIndex, pair, ref margin);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    float MarginOf(CollidableReference body)
    {
        ref var location = ref Simulation.Bodies.Locations[body.Slot];
        return Simulation.Bodies.SetOf(location).Collidables[location.Index].SpeculativeMargin;
    }

    /// <summary>Whether contacts of a pair are looked for, and within which margin.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    bool IsAllowed(int workerIndex, in CollidablePair pair, ref float margin)
    {
        var ownMargin = margin;
        if ((pair.B.Mobility != CollidableMobility.Static && Simulation.Solver.HasApart
            && Simulation.Solver.KeepsApart(pair.A.BodyHandle, pair.B.BodyHandle))
            || !Callbacks.AllowContactGeneration(workerIndex, pair.A, pair.B, ref margin))
        {
            ++workers[workerIndex].RefusedPairCount;
            return false;
        }
        CallbackChecks.Margin(ref margin, ownMargin, pair.A, pair.B);
        return true;
    }

    bool Admits(ref Worker worker, int leafA, int leafB)
    {
        if (!crowd.LeavesOut)
            return --worker.PairsLeft >= 0 || crowd.Report(ref worker.PairsLeft);
        if (crowd.Keeps(leafA, leafB))
            return true;
        ++worker.SkippedPairCount;
        return false;
    }
}
