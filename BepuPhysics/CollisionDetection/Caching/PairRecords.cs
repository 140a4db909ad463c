using System;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>Records of pairs that only some pairs have, by indices that do not change. Takes no memory before the first is taken.</summary>
unsafe struct PairRecords<T> where T : unmanaged
{
    Buffer<T> records;
    IdPool ids;

    /// <summary>Index that no record has.</summary>
    public const int None = 0;

    /// <summary>The record of index <see cref="None"/>, which is zero and belongs to no pair; others follow. They move when one is taken.</summary>
    public readonly T* Memory => records.Memory;

    /// <summary>Number of records in use.</summary>
    public readonly int Count => ids.HighestPossiblyClaimedId + 1 - ids.AvailableIdCount;

    /// <summary>Whether an index is that of a record in use, as far as can be told.</summary>
    public readonly bool MayExist(int index) => index > None && index <= ids.HighestPossiblyClaimedId + 1;

    /// <summary>Asks the processor to load the first cache line of a record. Changes no result.</summary>
    public readonly void Prefetch(int index) => BepuUtilities.Memory.Prefetch.Read(records.Memory + index);

    /// <summary>Asks the processor to load the rest of a record. Changes no result.</summary>
    public readonly void PrefetchRest(int index) => PrefetchRest(index, sizeof(T));

    /// <summary>Asks the processor to load what follows the first cache line of a record, up to some byte. Changes no result.</summary>
    public readonly void PrefetchRest(int index, int end)
    {
        const int line = 64;
        var record = (byte*)(records.Memory + index);
        for (int offset = line; offset < end; offset += line)
            BepuUtilities.Memory.Prefetch.Read(record + offset);
    }

    /// <summary>Takes a record, which is zero.</summary>
    public int Take(BufferPool pool)
    {
        if (!ids.Allocated)
            ids = new IdPool(InitialCapacity, pool);
        var index = ids.Take() + 1;
        if (index >= records.Length)
        {
            pool.ResizeToAtLeast(ref records, Math.Max(InitialCapacity, index * 2), records.Length);
            records[0] = default;
        }
        records[index] = default;
        return index;
    }

    /// <summary>Gives a record back.</summary>
    public void Return(int index, BufferPool pool) => ids.Return(index - 1, pool);

    /// <summary>Gives all records back.</summary>
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
        pool.Return(ref records);
        ids.Dispose(pool);
        this = default;
    }

    public void CopyState(StateCopy copy)
    {
        copy.Ids(ref ids);
        // The first is nobody's.
        var used = ids.HighestPossiblyClaimedId + 1;
        copy.Rows(ref records, used == 0 ? 0 : used + 1);
    }

    const int InitialCapacity = 64;
}
