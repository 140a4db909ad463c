using System.Numerics;
using BepuPhysics.Constraints;
using BepuUtilities;
using BepuUtilities.Collections;

namespace BepuPhysics;

// Many constraints that are removed and added at a time, as by the flush. One thread says where each of them comes to lie: handles, batches, lists of
// bodies, references. What it leaves out is most of the memory, descriptions and impulses. These follow when all is in place, type batch by type batch on
// many threads: moves in the order in which they were asked for, so that all is as if each had been made at once.
//
// Whoever adds a constraint meanwhile writes all of it afterwards; and nobody may read a column that has been moved but in name.
public sealed unsafe partial class Solver
{
    struct ColumnMove
    {
        public int From;
        public int To;
        // One more than the index of the next move of the type batch; 0 after the last.
        public int Next;
    }

    // A type batch, or what once was one.
    record struct TypeBatchName(int Batch, int TypeId);

    bool defersColumns;
    QuickList<ColumnMove> columnMoves;
    QuickList<TypeBatchName> deferredBatches;

    /// <summary>Number of type batches in which something is left to be done; what is done to one is independent of the others.</summary>
    internal int DeferredBatchCount { get; private set; }

    /// <summary>Begins to defer what happens to the columns of constraints of the active set that are added and removed.</summary>
    internal void BeginDeferral() => defersColumns = true;

    /// <summary>No more constraints come or go: what is left is known.</summary>
    internal void PrepareDeferred()
    {
        defersColumns = false;
        DeferredBatchCount = 0;
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
            deferredBatches[DeferredBatchCount++] = name;
        }
    }

    /// <summary>Does what is left to be done in a type batch.</summary>
    internal void DoDeferred(int index)
    {
        var name = deferredBatches[index];
        ref var batch = ref ActiveSet.Batches[name.Batch];
        ref var typeBatch = ref batch.TypeBatches[batch.Find(name.TypeId)];
        var processor = Processor(name.TypeId);
        for (int i = typeBatch.Pending.FirstMove; i > 0; i = columnMoves[i - 1].Next)
            processor.MoveColumns(ref typeBatch, columnMoves[i - 1].From, columnMoves[i - 1].To);
        if (typeBatch.Pending.HasNewBundle)
            processor.ClearUnusedLanes(ref typeBatch);
        typeBatch.Pending = default;
    }

    /// <summary>Ends what <see cref="BeginDeferral"/> began, when all has been done.</summary>
    internal void EndDeferral()
    {
        DeferredBatchCount = 0;
        if (columnMoves.Span.Allocated)
            columnMoves.Dispose(pool);
        if (deferredBatches.Span.Allocated)
            deferredBatches.Dispose(pool);
    }

    // The count is that of constraints before the first change that is deferred.
    void Defer(int batch, ref TypeBatch typeBatch, int constraintCount)
    {
        if (typeBatch.Pending.IsListed)
            return;
        typeBatch.Pending.WrittenBundleCount = BundleIndexing.GetBundleCount(constraintCount);
        if (!deferredBatches.Span.Allocated)
            deferredBatches = new QuickList<TypeBatchName>(64, pool);
        deferredBatches.Add(new(batch, typeBatch.TypeId), pool);
        typeBatch.Pending.IsListed = true;
    }

    void DeferMove(int batch, ref TypeBatch typeBatch, int from, int to)
    {
        Defer(batch, ref typeBatch, typeBatch.ConstraintCount + 1);
        if (!columnMoves.Span.Allocated)
            columnMoves = new QuickList<ColumnMove>(64, pool);
        columnMoves.Add(new() { From = from, To = to }, pool);
        ref var pending = ref typeBatch.Pending;
        if (pending.FirstMove == 0)
            pending.FirstMove = columnMoves.Count;
        else
            columnMoves[pending.LastMove - 1].Next = columnMoves.Count;
        pending.LastMove = columnMoves.Count;
    }

    void DeferClearing(int batch, ref TypeBatch typeBatch, int index)
    {
        if (index % Vector<float>.Count != 0)
            return;
        Defer(batch, ref typeBatch, index);
        typeBatch.Pending.HasNewBundle = true;
    }
}
