using System.Runtime.CompilerServices;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>What waits for results, by ids that are used again: as many as batches hold stay in the cache. Takes no memory before the first.</summary>
struct WaitingList<T>(int initialCapacity) where T : unmanaged
{
    readonly int initialCapacity = initialCapacity;
    QuickList<T> items;
    QuickList<int> freeIds;

    /// <summary>One more than the greatest id that was ever given.</summary>
    public readonly int Span => items.Count;

    /// <summary>An item, to be changed; that of an id which was taken is as it was last.</summary>
    public readonly ref T this[int id] => ref items[id];

    /// <summary>Adds an item.</summary>
    /// <returns>Its id, until it is taken.</returns>
    public int Add(in T item, BufferPool pool)
    {
        var id = Allocate(pool);
        items[id] = item;
        return id;
    }

    /// <summary>Adds an item that is to be written where it is: it holds what an earlier one held, or anything.</summary>
    /// <returns>Its id, until it is taken.</returns>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public int Allocate(BufferPool pool)
    {
        if (freeIds.Count == 0)
            return AllocateNew(pool);
        var id = freeIds[freeIds.Count - 1];
        --freeIds.Count;
        return id;
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    int AllocateNew(BufferPool pool)
    {
        items.EnsureCapacity(initialCapacity, pool);
        items.Allocate(pool);
        return items.Count - 1;
    }

    /// <summary>Takes an item out.</summary>
    // Not as a value: that would be copied twice, the second time at once and by other parts than the first.
    public void Take(int id, BufferPool pool, out T item)
    {
        item = items[id];
        Free(id, pool);
    }

    /// <summary>Takes an item out that is not asked for any more.</summary>
    public void Free(int id, BufferPool pool)
    {
        // The last one needs no note: where one thing waits at a time, as in a question, there are none.
        if (id == items.Count - 1)
        {
            --items.Count;
            return;
        }
        freeIds.EnsureCapacity(initialCapacity, pool);
        freeIds.Add(id, pool);
    }

    public void Dispose(BufferPool pool)
    {
        items.DisposeIfTaken(pool);
        freeIds.DisposeIfTaken(pool);
    }
}
