using System;
using BepuPhysics.Constraints;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Diagnostics;

namespace BepuPhysics;

// Many contact constraints that are removed and added at a time, as by the flush. What depends on all that came before is little: the slot of a handle, the
// batch, how many constraints a type batch has. One thread says that. All else follows from it side by side: within a type batch constraints come, go and
// are moved in the order in which that was asked for, and no two type batches have memory in common; the list of a body is its own, too. What is added comes
// last in it, so it is the same whether all that goes has gone before: which it has, as a slot that one body gives up may come to another. So all is as if
// each change had been made at once.
//
// Whoever adds a constraint meanwhile has it put into its place afterwards, and writes all that it holds. Until then nobody may ask where a constraint is.
public sealed unsafe partial class Solver
{
    // A constraint that goes, by its slot, or the complement of the number of one that comes.
    struct DeferredChange
    {
        public int What;
        // One more than the index of the next change of the type batch; 0 after the last.
        public int Next;
    }

    struct DeferredAddition
    {
        public ConstraintHandle Handle;
        public int BatchIndex;
        public int TypeId;
        public int Index;
        public int ReferenceA;
        public int ReferenceB;

        public readonly int BodyA => ReferenceA & EncodedBody.IndexMask;
        public readonly int BodyB => ReferenceB < 0 ? ReferenceB : ReferenceB & EncodedBody.IndexMask;
    }

    // Indices of its bodies; the second one is negative where there is none.
    record struct DeferredRemoval(int Slot, int BodyA, int BodyB);

    // A type batch, or what once was one.
    record struct TypeBatchName(int Batch, int TypeId);

    // Constraints that come or go from the lists of their bodies; fewer are no work for another thread.
    const int ListsPerBlock = 64;

    QuickList<DeferredChange> deferredChanges;
    QuickList<DeferredAddition> deferredAdditions;
    QuickList<DeferredRemoval> deferredRemovals;
    QuickList<TypeBatchName> deferredBatches;
    int deferredBatchCount;
    int removalBlockCount;

    /// <summary>Whether constraints come and go by <see cref="AddLater"/> and <see cref="RemoveLater"/>.</summary>
    internal bool Defers { get; private set; }

    /// <summary>Number of blocks of what is left to be done; each is independent of the others.</summary>
    internal int DeferredBlockCount => deferredBatchCount + removalBlockCount;

    /// <summary>Number of blocks of what is left to be done after that; each is independent of the others, and of <see cref="Place"/>.</summary>
    internal int LastBlockCount { get; private set; }

    /// <summary>Begins to defer what follows from constraints of the active set that are added and removed.</summary>
    /// <param name="count">About how many there will be.</param>
    internal void BeginDeferral(int count)
    {
        Defers = true;
        deferredChanges = new(2 * count, pool);
        deferredAdditions = new(count, pool);
        deferredRemovals = new(count, pool);
        deferredBatches = new(64, pool);
    }

    /// <summary>Adds a contact constraint, which is nowhere before <see cref="Place"/>.</summary>
    /// <param name="ends">Its bodies.</param>
    /// <param name="typeId">Its type, which is registered.</param>
    /// <param name="number">Number by which it is placed.</param>
    internal ConstraintHandle AddLater(in ContactEnds ends, int typeId, out int number)
    {
        Check.That(Defers && typeId < ConstraintTypeIds.ContactTypeCount && !Processor(typeId).MakesHubs && !Processor(typeId).CarriesPointLoad);
        if (HandleOwners.NeedsSlot(HandlePool, MaximumCount, "constraints", out var slotCount))
            EnsureSlots(slotCount);
        Edges.EnsureBodiesPerConstraint(ends.Count, bodies.Sets, pool);
        Span<int> dynamics = stackalloc int[2];
        var dynamicCount = 0;
        if ((ends.ReferenceA & EncodedBody.KinematicFlag) == 0)
            dynamics[dynamicCount++] = ends.SlotA;
        if (ends.Count > 1 && (ends.ReferenceB & EncodedBody.KinematicFlag) == 0)
            dynamics[dynamicCount++] = ends.SlotB;
        var batchIndex = FindBatch(dynamics[..dynamicCount], BatchKind.Coloured);
        ref var batch = ref ActiveSet.Batches[batchIndex];
        for (int i = 0; i < dynamicCount && batch.Kind == BatchKind.Coloured; ++i)
            batch.DynamicBodies.Add(dynamics[i], pool);
        ref var typeBatch = ref batch.FindOrCreate(typeId, pool);
        Processor(typeId).MakeRoomForOne(ref typeBatch, MinimumCapacityPerTypeBatch, pool);
        number = deferredAdditions.Count;
        var handle = new ConstraintHandle(owners.Claim(HandlePool.Take()));
        deferredAdditions.Add(new()
        {
            Handle = handle,
            BatchIndex = batchIndex,
            TypeId = typeId,
            ReferenceA = ends.ReferenceA,
            ReferenceB = ends.ReferenceB,
        }, pool);
        Defer(batchIndex, ref typeBatch, ~number);
        ++typeBatch.ConstraintCount;
        return handle;
    }

    /// <summary>Removes a contact constraint that was there before all this, and tells nobody.</summary>
    /// <param name="handle">The constraint.</param>
    /// <param name="ends">Its bodies.</param>
    internal void RemoveLater(ConstraintHandle handle, in ContactEnds ends)
    {
        ref var location = ref Locations[handle.Slot];
        Check.That(Defers && location.SetIndex == 0 && location.TypeId < ConstraintTypeIds.ContactTypeCount);
        ForgetOptions(handle.Slot);
        deferredRemovals.Add(new(handle.Slot, ends.ReferenceA & EncodedBody.IndexMask, ends.Count > 1 ? ends.ReferenceB & EncodedBody.IndexMask : -1), pool);
        ref var batch = ref ActiveSet.Batches[location.BatchIndex];
        if (batch.Kind == BatchKind.Coloured)
        {
            // Kinematic bodies are not there.
            batch.DynamicBodies.Unset(ends.SlotA);
            if (ends.Count > 1)
                batch.DynamicBodies.Unset(ends.SlotB);
        }
        ref var typeBatch = ref TypeBatchAt(location);
        Defer(location.BatchIndex, ref typeBatch, handle.Slot);
        --typeBatch.ConstraintCount;
        if (typeBatch.ConstraintCount == 0)
            GiveUp(ref ActiveSet.Batches, ref batch, Processor(location.TypeId));
        location.SetIndex = -1;
        owners.Release(handle.Slot);
        HandlePool.Return(handle.Slot, pool);
    }

    void Defer(int batch, ref TypeBatch typeBatch, int what)
    {
        ref var pending = ref typeBatch.Pending;
        deferredChanges.Add(new() { What = what }, pool);
        if (pending.IsListed)
        {
            deferredChanges[pending.LastChange - 1].Next = deferredChanges.Count;
        }
        else
        {
            deferredBatches.Add(new(batch, typeBatch.TypeId), pool);
            pending = new() { IsListed = true, ConstraintCount = typeBatch.ConstraintCount, FirstChange = deferredChanges.Count };
        }
        pending.LastChange = deferredChanges.Count;
    }

    /// <summary>No more constraints come or go: what is left is known.</summary>
    /// <param name="threadCount">Number of threads among which it is shared.</param>
    internal void PrepareDeferred(int threadCount)
    {
        Defers = false;
        deferredBatchCount = 0;
        ref var batches = ref ActiveSet.Batches;
        for (int i = 0; i < deferredBatches.Count; ++i)
        {
            var name = deferredBatches[i];
            if (name.Batch >= batches.Count)
                continue;
            var index = batches[name.Batch].Find(name.TypeId);
            if (index < 0)
                continue;
            // One that was emptied and began anew may have been listed twice.
            ref var pending = ref batches[name.Batch].TypeBatches[index].Pending;
            if (!pending.IsListed)
                continue;
            pending.IsListed = false;
            deferredBatches[deferredBatchCount++] = name;
        }
        removalBlockCount = BlocksFor(deferredRemovals.Count, threadCount);
        LastBlockCount = BlocksFor(deferredAdditions.Count, threadCount);
    }

    // Each looks at all constraints, for those of its bodies.
    static int BlocksFor(int constraintCount, int threadCount) => Math.Min(threadCount, (constraintCount + ListsPerBlock - 1) / ListsPerBlock);

    /// <summary>Does one block of what is left to be done.</summary>
    internal void DoDeferred(int block)
    {
        if (block < removalBlockCount)
            RemoveFromLists(block);
        else
            ChangeTypeBatch(deferredBatches[block - removalBlockCount]);
    }

    void ChangeTypeBatch(TypeBatchName name)
    {
        ref var batch = ref ActiveSet.Batches[name.Batch];
        ref var typeBatch = ref batch.TypeBatches[batch.Find(name.TypeId)];
        var processor = Processor(name.TypeId);
        var count = typeBatch.Pending.ConstraintCount;
        for (int i = typeBatch.Pending.FirstChange; i > 0; i = deferredChanges[i - 1].Next)
        {
            var what = deferredChanges[i - 1].What;
            if (what < 0)
            {
                // Meanwhile it is known by its number: the slot may be one that another type batch is yet to give up.
                ref var added = ref deferredAdditions[~what];
                added.Index = count;
                processor.WriteNames(ref typeBatch, count++, new ConstraintHandle(what), added.ReferenceA, added.ReferenceB);
                continue;
            }
            var hole = Locations[what].IndexInTypeBatch;
            if (hole == --count)
                continue;
            processor.Move(ref typeBatch, count, hole);
            var moved = typeBatch.IndexToHandle[hole];
            if (moved.Value < 0)
                deferredAdditions[~moved.Value].Index = hole;
            else
                Locations[moved.Slot].IndexInTypeBatch = hole;
        }
        Check.That(count == typeBatch.ConstraintCount);
        processor.ClearUnusedLanes(ref typeBatch, BundleIndexing.GetBundleCount(typeBatch.Pending.ConstraintCount));
        typeBatch.Pending = default;
    }

    void RemoveFromLists(int block)
    {
        var lists = bodies.Awake.Constraints;
        var range = new BodyRange(bodies.Awake.Count, block, removalBlockCount);
        for (int i = 0; i < deferredRemovals.Count; ++i)
        {
            ref var removed = ref deferredRemovals[i];
            if (range.Has(removed.BodyA))
                Edges.Remove(ref lists[removed.BodyA], Edges.EdgeOf(removed.Slot, 0));
            if (range.Has(removed.BodyB))
                Edges.Remove(ref lists[removed.BodyB], Edges.EdgeOf(removed.Slot, 1));
        }
    }

    /// <summary>Does one block of what is left to be done at last.</summary>
    internal void DoLast(int block)
    {
        var lists = bodies.Awake.Constraints;
        var range = new BodyRange(bodies.Awake.Count, block, LastBlockCount);
        for (int i = 0; i < deferredAdditions.Count; ++i)
        {
            ref var added = ref deferredAdditions[i];
            if (range.Has(added.BodyA))
                Edges.Add(ref lists[added.BodyA], Edges.EdgeOf(added.Handle.Slot, 0));
            if (range.Has(added.BodyB))
                Edges.Add(ref lists[added.BodyB], Edges.EdgeOf(added.Handle.Slot, 1));
        }
    }

    readonly struct BodyRange(int bodyCount, int block, int blockCount)
    {
        readonly int start = (int)((long)bodyCount * block / blockCount);
        readonly int end = (int)((long)bodyCount * (block + 1) / blockCount);

        // Also asked of no body, which is in none.
        public bool Has(int body) => (uint)(body - start) < (uint)(end - start);
    }

    /// <summary>Puts a constraint that was added into its place, when all blocks are done. Several threads may do that for several.</summary>
    /// <param name="number">Its number.</param>
    internal ConstraintHandle Place(int number)
    {
        ref var added = ref deferredAdditions[number];
        ref var location = ref Locations[added.Handle.Slot];
        location = new() { SetIndex = 0, BatchIndex = added.BatchIndex, TypeId = added.TypeId, IndexInTypeBatch = added.Index };
        TypeBatchAt(location).IndexToHandle[added.Index] = added.Handle;
        return added.Handle;
    }

    /// <summary>Ends what <see cref="BeginDeferral"/> began, when all has been done.</summary>
    internal void EndDeferral()
    {
        deferredBatchCount = 0;
        removalBlockCount = 0;
        LastBlockCount = 0;
        deferredChanges.Dispose(pool);
        deferredAdditions.Dispose(pool);
        deferredRemovals.Dispose(pool);
        deferredBatches.Dispose(pool);
    }
}
