using System;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>Histories of pairs, by indices that do not change. Takes no memory before the first is taken.</summary>
unsafe struct PairHistories
{
    Buffer<PairHistory> histories;
    IdPool ids;

    /// <summary>The first history, which is zero and belongs to no pair. They move when one is taken.</summary>
    public readonly PairHistory* Memory => histories.Memory;

    /// <summary>Number of histories in use.</summary>
    public readonly int Count => ids.HighestPossiblyClaimedId + 1 - ids.AvailableIdCount;

    /// <summary>Whether an index is that of a history in use, as far as can be told.</summary>
    public readonly bool MayExist(int index) => index > 0 && index <= ids.HighestPossiblyClaimedId + 1;

    /// <summary>Asks the processor to load what decides whether there will be a test. Changes no result.</summary>
    public readonly void Prefetch(int index) => BepuUtilities.Memory.Prefetch.Read(histories.Memory + index);

    /// <summary>Asks the processor to load the rest, for contacts to be carried along or a test. Changes no result.</summary>
    public readonly void PrefetchRest(int index)
    {
        const int line = 64;
        var history = (byte*)(histories.Memory + index);
        for (int offset = line; offset < sizeof(PairHistory); offset += line)
            BepuUtilities.Memory.Prefetch.Read(history + offset);
    }

    /// <summary>Takes a history that knows nothing.</summary>
    public int Take(BufferPool pool)
    {
        if (!ids.Allocated)
            ids = new IdPool(InitialCapacity, pool);
        var index = ids.Take() + 1;
        if (index >= histories.Length)
            pool.ResizeToAtLeast(ref histories, Math.Max(InitialCapacity, index * 2), histories.Length);
        histories[0] = default;
        histories[index] = default;
        return index;
    }

    /// <summary>Gives a history back.</summary>
    public void Return(int index, BufferPool pool) => ids.Return(index - 1, pool);

    /// <summary>Gives all histories back.</summary>
    public void Clear()
    {
        if (ids.Allocated)
            ids.Clear();
    }

    /// <summary>Returns all memory.</summary>
    public void Dispose(BufferPool pool)
    {
        if (!ids.Allocated)
            return;
        pool.Return(ref histories);
        ids.Dispose(pool);
        this = default;
    }

    const int InitialCapacity = 64;
}
