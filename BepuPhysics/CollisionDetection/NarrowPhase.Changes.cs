using System;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using BepuUtilities;
using BepuUtilities.Memory;
using BepuUtilities.TaskScheduling;

namespace BepuPhysics.CollisionDetection;

// What the workers have noted is brought into the order of its pairs and made on one thread.
public sealed unsafe partial class NarrowPhase<TCallbacks>
{
    // Below so many constraints that move or are new a dispatch costs as much as it saves.
    const int LeastForThreads = 128;

    // Whether the flush says first which constraints there are, and all that follows from it comes later. What is done is the same.
    bool leavesColumns;
    int noteCount;
    // Whether what a constraint holds is read where a change is noted, which many threads do; otherwise the flush reads it.
    bool readsEarly;

    internal override void Flush(IThreadDispatcher? dispatcher)
    {
        try
        {
            ApplyChanges(dispatcher);
            // Where there was nothing to be done beside it.
            Simulation.BroadPhase.TidyActiveTree(Pool);
        }
        finally
        {
            // There may be no room for another constraint: the step is lost, the memory is not, and the workers' pools are free again.
            order.DisposeIfTaken(Pool);
            Woken.DisposeIfTaken(Pool);
            ListsWoken = false;
            ReleaseWorkers();
        }
        // Notes of a first step, of which the solver needs nothing, but as much for itself.
        Pool.EmptyIfGrown();
        dispatcher?.WorkerPools.EmptyIfGrown();
    }

    void ApplyChanges(IThreadDispatcher? dispatcher)
    {
        if (Simulation.Events.UsesSensors)
            GatherSensed();
        noteCount = CountNotes();
        leavesColumns = LeavesColumns(dispatcher);
        MakeRoomForNew(noteCount - PairCount);
        if (leavesColumns && !readsEarly)
            ReadOld();
        BeginColumns();
        try
        {
            RemoveUnseenPairs();
            RemoveGoneManifolds();
            order.Count = 0;
            for (int i = 0; i < workers.Length; ++i)
                Gather(ref workers[i].Pending, i);
            SortByKey();
            if (RequestTouched())
            {
                // Constraints that wake are whole at once, and those that are replaced are read before others move.
                FinishColumns(dispatcher, appliesNotes: false);
                WakeTouched();
                BeginColumns();
            }
            if (!leavesColumns)
                ApplyNow();
        }
        finally
        {
            FinishColumns(dispatcher, appliesNotes: true);
        }
        NoteSmoothBends();
        WatchBouncingPairs();
        WatchFastPairs();
    }

    // Whether what constraints hold waits: for many threads, or because so many are new that the memory of all doubles, which then need not be copied.
    bool LeavesColumns(IThreadDispatcher? dispatcher) =>
        noteCount >= LeastForThreads && (dispatcher is { ThreadCount: > 1 } || noteCount > PairCount);

    int CountNotes()
    {
        var count = 0;
        foreach (ref var worker in workers.AsSpan())
            count += worker.Pending.Count + worker.Gone.Count;
        return count;
    }

    // Tables that double on their way are copied, and leave what they were behind.
    void MakeRoomForNew(int count)
    {
        if (count <= 0)
            return;
        Pairs.EnsureCapacity(Pairs.Pairs.Count + count, Pool);
        Simulation.Solver.EnsureFreeSlots(count);
    }

    void BeginColumns()
    {
        if (leavesColumns)
            Simulation.Solver.BeginDeferral(noteCount);
    }

    void FinishColumns(IThreadDispatcher? dispatcher, bool appliesNotes)
    {
        if (!leavesColumns)
            return;
        var work = new ChangeWork
        {
            NarrowPhase = this,
            ThreadCount = dispatcher?.ThreadCount ?? 1,
            // Who wakes has been added to it before the last notes.
            Tidies = appliesNotes && Simulation.BroadPhase.MayTidyAside,
            WorkerPools = dispatcher?.WorkerPools,
        };
        try
        {
            if (appliesNotes && order.Count > 0)
                Pool.TakeAtLeast(order.Count, out work.Targets);
            StagedWork.Run(ref work, dispatcher);
        }
        finally
        {
            Pool.ReturnIfTaken(ref work.Targets);
            Simulation.Solver.EndDeferral();
        }
        work.Failure?.Throw();
    }

    // Who is touched is in the solver in this very step.
    bool RequestTouched()
    {
        if (Simulation.Bodies.Asleep.Count == 0)
            return false;
        var awakener = Simulation.Awakener;
        awakener.BeginRequests();
        awakener.RequestHeldByMovingKinematics();
        for (int i = 0; i < order.Count; ++i)
        {
            ref var pending = ref workers[order[i].Worker].Pending[order[i].Index];
            if (pending.Manifold.Count == 0)
                continue;
            awakener.Request(pending.Pair.A.Slot);
            if (pending.Pair.B.Mobility != CollidableMobility.Static)
                awakener.Request(pending.Pair.B.Slot);
        }
        RequestThrownAt();
        return awakener.HasRequests;
    }

    void WakeTouched()
    {
        // What sleeps is not tested with what else does not move: of those who wake now nobody knows whom they are beside.
        FastPairs.KnowNoneSlow();
        ListsWoken = TCallbacks.HasSurfaces;
        var anyWoke = Simulation.Awakener.WakeRequested();
        ListsWoken = false;
        if (anyWoke)
            ReadOld();
    }

    // Where no worker has, as those constraints slept until now.
    void ReadOld()
    {
        if (Pairs.Pairs.Count == 0)
            return;
        foreach (ref var worker in workers.AsSpan())
        {
            foreach (ref var pending in worker.Pending.AsSpan())
                ReadOld(ref worker, ref pending);
        }
    }

    void ReadOld(ref Worker worker, ref PendingManifold pending)
    {
        var index = pending.Old == PendingManifold.NotRead && pending.Manifold.Count > 0 ? Pairs.Pairs.IndexOf(pending.Pair) : -1;
        if (index < 0)
            return;
        for (var manifolds = Pairs.ManifoldsOf(index); manifolds.MoveNext();)
        {
            if (manifolds.Children == pending.Children && manifolds.Current.HasConstraint)
                Read(ref worker, ref pending, manifolds.Current);
        }
    }

    /// <summary>Asks the processor to load what pairs need that are soon to be applied: they are in the order of their handles.</summary>
    void PrefetchPending(int index)
    {
        const int distance = 6;
        if (index + 3 * distance < order.Count)
            Pairs.Pairs.PrefetchSlot(PairOf(order[index + 3 * distance].Key));
        if (index + 2 * distance < order.Count)
        {
            ref var later = ref order[index + 2 * distance];
            var pair = PairOf(later.Key);
            Pairs.Pairs.PrefetchElement(pair);
            PrefetchLocation(pair.A);
            PrefetchLocation(pair.B);
            ref var pending = ref workers[later.Worker].Pending[later.Index];
            Prefetch.Read(Unsafe.AsPointer(ref pending));
            Prefetch.Read(Unsafe.AsPointer(ref pending.Material));
        }
        if (index + distance >= order.Count)
            return;
        var next = PairOf(order[index + distance].Key);
        PrefetchRows(next.A);
        PrefetchRows(next.B);
        var guess = Pairs.Pairs.PrefetchElement(next);
        if (guess >= 0 && Pairs.Pairs.Values[guess].Single.HasConstraint)
            Simulation.Solver.Prefetch(Pairs.Pairs.Values[guess].Single.Constraint);
    }

    void PrefetchLocation(CollidableReference collidable)
    {
        if (collidable.Mobility != CollidableMobility.Static)
            Prefetch.Read(Simulation.Bodies.Locations.Memory + collidable.Slot);
    }

    void PrefetchRows(CollidableReference collidable)
    {
        if (collidable.Mobility == CollidableMobility.Static)
            return;
        ref var location = ref Simulation.Bodies.Locations[collidable.Slot];
        ref var set = ref Simulation.Bodies.SetOf(location);
        Prefetch.Read(set.LocalInertias.Memory + location.Index);
        Prefetch.Read(set.Constraints.Memory + location.Index);
    }

    /// <summary>Reads what a manifold's constraint holds of the last step.</summary>
    // Where the manifold is noted, by many workers, and not in the flush: nobody else writes to the constraint in between.
    void Read(ref Worker worker, ref PendingManifold pending, in CachedManifold manifold)
    {
        Note(ref worker.Old, default(ContactPatch), worker.Pool, worker.Room);
        pending.Old = worker.Old.Count - 1;
        new ContactConstraint(Simulation.Solver, manifold.Constraint, ConstraintTypeIds.ContactCount(manifold.ConstraintTypeId))
            .ReadPatch(manifold.Features, out worker.Old[pending.Old]);
    }

    void WatchBouncingPairs()
    {
        Restitution.BeginStep();
        NoteSurfacesOfWoken();
        order.Count = 0;
        for (int i = 0; i < workers.Length; ++i)
            Gather(ref workers[i].Bouncing, i);
        SortByKey();
        for (int i = 0, next; i < order.Count; i = next)
        {
            var bouncing = workers[order[i].Worker].Bouncing[order[i].Index];
            // A pair that asks for it may be hit besides.
            for (next = i + 1; next < order.Count && order[next].Key == order[i].Key; ++next)
            {
                ref var other = ref workers[order[next].Worker].Bouncing[order[next].Index];
                bouncing.Coefficient = MathHelper.Max(bouncing.Coefficient, other.Coefficient);
                bouncing.LeastHit = MathHelper.Min(bouncing.LeastHit, other.LeastHit);
            }
            var index = Pairs.Pairs.IndexOf(bouncing.Pair);
            // Statics beside it have taken its contacts.
            if (index < 0)
                continue;
            foreach (ref var manifold in Pairs.ManifoldsOf(index))
            {
                if (manifold.HasConstraint)
                    Restitution.Watch(
                        manifold.Constraint, ConstraintTypeIds.ContactCount(manifold.ConstraintTypeId), bouncing.Coefficient, bouncing.LeastHit);
            }
        }
    }

    static int ConstraintType(in CollidablePair pair, int contactCount) =>
        ConstraintTypeIds.ConvexContact(contactCount, pair.B.Mobility == CollidableMobility.Static ? 1 : 2);
}
