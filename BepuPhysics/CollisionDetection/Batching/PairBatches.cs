using System;
using System.Runtime.CompilerServices;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>Batches of waiting pairs, one for each task that has pairs. Takes no memory before the first pair.</summary>
struct PairBatches
{
    Buffer<PairBatch> batches;

    /// <summary>All batches that have memory are from this index to before <see cref="End"/>: nobody goes through twenty of which one is used.</summary>
    public int First { get; private set; }

    /// <summary>See <see cref="First"/>.</summary>
    public int End { get; private set; }

    /// <summary>A batch that has memory, or that of an index between two that have.</summary>
    public readonly ref PairBatch this[int taskIndex]
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => ref batches[taskIndex];
    }

    /// <summary>Whether the batch of a task has memory.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly bool Has(int taskIndex) => (uint)(taskIndex - First) < (uint)(End - First) && batches[taskIndex].Bundles.Allocated;

    /// <summary>Takes the memory of the batch of a task, which has none.</summary>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public void Take(CollisionTask task, int taskIndex, int taskCount, BufferPool pool)
    {
        if (taskIndex >= batches.Length)
            pool.ResizeToAtLeast(ref batches, Math.Max(taskCount, taskIndex + 1), End);
        // What is not between two that have memory was never written: a question has one batch of fifty.
        if (First == End)
            (First, End) = (taskIndex, taskIndex + 1);
        else if (taskIndex < First)
        {
            batches.Clear(taskIndex + 1, First - taskIndex - 1);
            First = taskIndex;
        }
        else if (taskIndex >= End)
        {
            batches.Clear(End, taskIndex - End);
            End = taskIndex + 1;
        }
        pool.Take(task.BatchByteCount, out batches[taskIndex].Bundles);
        batches[taskIndex].Count = 0;
    }

    /// <summary>Returns all memory; pairs that wait are forgotten. May be called any number of times.</summary>
    public void Dispose(BufferPool pool)
    {
        if (!batches.Allocated)
            return;
        for (int i = First; i < End; ++i)
            pool.ReturnIfTaken(ref batches[i].Bundles);
        pool.Return(ref batches);
        this = default;
    }
}
