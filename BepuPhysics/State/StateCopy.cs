using System;
using System.Runtime.CompilerServices;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics;

/// <summary>
/// Copies what a simulation is between two steps into memory, or back out of it. Each part says once, in one order, of what it consists, and that is read or
/// written.
/// </summary>
/// <remarks>
/// Only what is used of a table is copied: capacities change no bit, and what is behind the last row is nobody's. Tables that are too small are replaced by
/// larger ones from the pool of the simulation; none is made smaller, so that restoring again and again takes no memory.
/// </remarks>
sealed unsafe class StateCopy(BufferPool memory)
{
    const int InitialCapacity = 1 << 12;

    Buffer<byte> bytes;
    // Where the next value is, also beyond the end of the memory while it is found out how much is needed.
    long position;

    /// <summary>Whether what was saved is written into the simulation, and not the other way round.</summary>
    internal bool Restores { get; private set; }

    /// <summary>Where tables of the simulation that is being restored get their memory.</summary>
    internal BufferPool Pool { get; private set; } = null!;

    /// <summary>Bytes that were saved.</summary>
    internal int Length { get; private set; }

    internal ReadOnlySpan<byte> Bytes => bytes.Allocated ? bytes.AsSpan()[..Length] : [];

    /// <summary>Begins to copy out of a simulation.</summary>
    internal void BeginSave(BufferPool pool)
    {
        (Pool, Restores, position, Length) = (pool, false, 0, 0);
        if (!bytes.Allocated)
            memory.TakeAtLeast(InitialCapacity, out bytes);
    }

    /// <summary>Ends copying out of a simulation.</summary>
    /// <returns>Whether all of it found room; else there is room for all of it now, and it has to be copied again.</returns>
    internal bool TryEndSave()
    {
        if (position > Array.MaxLength)
            throw new InvalidOperationException($"The state of the simulation takes {position} bytes, more than a snapshot can hold.");
        Length = (int)position;
        if (position <= bytes.Length)
            return true;
        memory.ResizeToAtLeast(ref bytes, Length, 0);
        return false;
    }

    /// <summary>Begins to copy into a simulation.</summary>
    internal void BeginRestore(BufferPool pool) => (Pool, Restores, position) = (pool, true, 0);

    /// <summary>Takes bytes that were saved elsewhere.</summary>
    internal void Load(ReadOnlySpan<byte> saved)
    {
        if (bytes.Length < saved.Length)
        {
            memory.ReturnIfTaken(ref bytes);
            memory.TakeAtLeast(saved.Length, out bytes);
        }
        saved.CopyTo(bytes.AsSpan());
        Length = saved.Length;
    }

    internal void Dispose()
    {
        memory.ReturnIfTaken(ref bytes);
        Length = 0;
    }

    /// <summary>Forgets the memory, which the pool has given back to the system.</summary>
    internal void Abandon() => (bytes, Length) = (default, 0);

    /// <summary>A single value.</summary>
    internal void Value<T>(ref T value) where T : unmanaged => Copy((byte*)Unsafe.AsPointer(ref value), sizeof(T));

    /// <summary>A single value that is not a field: what it is, or is to be.</summary>
    internal T Value<T>(T value) where T : unmanaged
    {
        Value(ref value);
        return value;
    }

    /// <summary>The first rows of a table.</summary>
    /// <param name="rows">The table, which gets another one's memory where it is too small.</param>
    /// <param name="count">Number of rows that are used; of no meaning when they are restored.</param>
    /// <returns>Number of rows that were copied.</returns>
    internal int Rows<T>(ref Buffer<T> rows, int count) where T : unmanaged
    {
        Value(ref count);
        if (Restores && count > rows.Length)
        {
            Pool.ReturnIfTaken(ref rows);
            Pool.TakeAtLeast(count, out rows);
        }
        CopyRows(rows, count);
        return count;
    }

    /// <summary>The first rows of a table that has room for them.</summary>
    internal void CopyRows<T>(in Buffer<T> rows, int count) where T : unmanaged => Copy((byte*)rows.Memory, (long)count * sizeof(T));

    /// <summary>The first rows of a table whose others are all alike.</summary>
    /// <param name="rows">The table.</param>
    /// <param name="count">Number of rows that may be different; of no meaning when they are restored.</param>
    /// <param name="absent">What all others are.</param>
    internal void Rows<T>(ref Buffer<T> rows, int count, in T absent) where T : unmanaged
    {
        count = Rows(ref rows, count);
        if (Restores && rows.Allocated)
            rows.AsSpan()[count..].Fill(absent);
    }

    internal void List<T>(ref QuickList<T> list) where T : unmanaged => list.Count = Rows(ref list.Span, list.Count);

    /// <summary>Which numbers are taken, and in which order the others will be.</summary>
    internal void Ids(ref IdPool ids)
    {
        var next = Value(ids.HighestPossiblyClaimedId + 1);
        var available = Value(ids.AvailableIdCount);
        if (!Restores)
        {
            CopyRows(ids.AvailableIds, available);
            return;
        }
        // Who never gave out a number has no table of those that came back.
        if (next == 0 && !ids.Allocated)
            return;
        if (!ids.Allocated)
            ids = new IdPool(Math.Max(next, available), Pool);
        ids.Clear();
        ids.EnsureCapacity(available, Pool);
        for (int i = 0; i < next; ++i)
            ids.Take();
        for (int i = 0; i < available; ++i)
            ids.ReturnUnsafely(Value(0));
    }

    /// <summary>Keys and values, in their order; where a key is found follows from it.</summary>
    internal void Dictionary<TKey, TValue, TComparer>(ref QuickDictionary<TKey, TValue, TComparer> dictionary)
        where TKey : unmanaged where TValue : unmanaged where TComparer : IEqualityComparerRef<TKey>
    {
        var count = Value(dictionary.Count);
        if (!Restores)
        {
            CopyRows(dictionary.Keys, count);
            CopyRows(dictionary.Values, count);
            return;
        }
        if (dictionary.Keys.Allocated)
            dictionary.Clear();
        if (count == 0)
            return;
        if (!dictionary.Keys.Allocated)
            dictionary = new(count, Pool);
        dictionary.EnsureCapacity(count, Pool);
        var keys = (TKey*)Skip((long)count * sizeof(TKey));
        var values = (TValue*)Skip((long)count * sizeof(TValue));
        for (int i = 0; i < count; ++i)
            dictionary.AddUnsafely(Unsafe.ReadUnaligned<TKey>(keys + i), Unsafe.ReadUnaligned<TValue>(values + i));
    }

    byte* Skip(long count)
    {
        var start = bytes.Memory + position;
        position += count;
        if (Restores && position > Length)
            throw new InvalidOperationException("The snapshot is shorter than what it says it holds.");
        return start;
    }

    void Copy(byte* state, long count)
    {
        var saved = Skip(count);
        if (Restores)
            System.Buffer.MemoryCopy(saved, state, count, count);
        else if (position <= bytes.Length)
            System.Buffer.MemoryCopy(state, saved, count, count);
    }
}
