using System;
using System.Runtime.CompilerServices;
using BepuUtilities.Diagnostics;
using BepuUtilities.Memory;

namespace BepuUtilities.Collections;

/// <summary>
/// A growing map over pooled memory. Keys and values lie densely in <see cref="Keys"/> and <see cref="Values"/>, in an order that
/// depends on the calls alone. It does not keep its pool: whoever adds names it. Copies share the memory but not the count, so
/// pass it by reference. References to values are good until the map grows or an element is removed.
/// </summary>
/// <remarks>Operations called "unsafely" need room that is there already; validating builds check that, release builds do not.</remarks>
public partial struct QuickDictionary<TKey, TValue, TComparer>
    where TKey : unmanaged where TValue : unmanaged where TComparer : IEqualityComparerRef<TKey>
{
    /// <summary>Number of elements.</summary>
    public int Count;
    /// <summary>Length of the table less one; the length is a power of two.</summary>
    public int TableMask;
    /// <summary>The table has at least 2^TablePowerOffset slots for each element that there is room for.</summary>
    public int TablePowerOffset;
    /// <summary>For each slot the index of an element plus one, or zero.</summary>
    public Buffer<int> Table;
    /// <summary>Memory of the keys; [0, <see cref="Count"/>) are in use. Do not change what a key is equal to.</summary>
    public Buffer<TKey> Keys;
    /// <summary>Memory of the values, each at the index of its key.</summary>
    public Buffer<TValue> Values;
    /// <summary>Tells which keys are equal.</summary>
    public TComparer EqualityComparer;

    /// <summary>Creates an empty map.</summary>
    /// <param name="initialCapacity">Number of elements that fit without more memory.</param>
    /// <param name="tableSizePower">The table is at least 2^tableSizePower times as large as the capacity; in [1, 16].</param>
    /// <param name="comparer">Tells which keys are equal.</param>
    /// <param name="pool">Where the memory comes from.</param>
    public QuickDictionary(int initialCapacity, int tableSizePower, TComparer comparer, IUnmanagedMemoryPool pool)
    {
        ArgumentNullException.ThrowIfNull(pool);
        ProbingTable.CheckTableSizePower(tableSizePower);
        EqualityComparer = comparer;
        TablePowerOffset = tableSizePower;
        Resize(initialCapacity, pool);
    }

    /// <summary>Creates an empty map with a table four times as large as its capacity.</summary>
    public QuickDictionary(int initialCapacity, TComparer comparer, IUnmanagedMemoryPool pool) : this(initialCapacity, 2, comparer, pool)
    {
    }

    /// <summary>Creates an empty map with the comparer's default value and a table four times as large as its capacity.</summary>
    public QuickDictionary(int initialCapacity, IUnmanagedMemoryPool pool) : this(initialCapacity, 2, default!, pool)
    {
    }

    /// <summary>Makes room for a number of elements in all.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public void EnsureCapacity(int count, IUnmanagedMemoryPool pool)
    {
        if (count > Keys.Length)
            Resize(Math.Max(count, (int)Math.Min((long)Keys.Length * 2, Array.MaxLength)), pool);
    }

    /// <summary>Changes the room to what the pool gives for a number of keys, which must not be less than the count.</summary>
    public void Resize(int newSize, IUnmanagedMemoryPool pool)
    {
        ArgumentNullException.ThrowIfNull(pool);
        ArgumentOutOfRangeException.ThrowIfLessThan(newSize, Count);
        var capacity = pool.GetCapacityForCount<TKey>(newSize);
        if (Keys.Allocated && capacity == Keys.Length)
            return;
        // The keys last: should memory run out in between, the others still have room for as many as the keys can be.
        var tableSize = ProbingTable.GetTableSize(capacity, TablePowerOffset);
        if (Table.Length != tableSize)
        {
            pool.Resize(ref Table, tableSize, 0);
            TableMask = tableSize - 1;
            Table.Clear(0, tableSize);
            ProbingTable.Build(Table, TableMask, Keys, Count, ref EqualityComparer);
        }
        // As many values as keys: a small key leaves its block room for many more than were asked for.
        pool.ResizeToAtLeast(ref Values, capacity, Count);
        pool.ResizeToAtLeast(ref Keys, newSize, Count);
    }

    /// <summary>Gives back the room that the elements do not need.</summary>
    public void Compact(IUnmanagedMemoryPool pool) => Resize(Count, pool);

    /// <summary>Gives all memory back. The comparer stays.</summary>
    public void Dispose(IUnmanagedMemoryPool pool)
    {
        Keys.Dispose(pool);
        Values.Dispose(pool);
        Table.Dispose(pool);
        Count = 0;
        TableMask = 0;
    }

    /// <summary>Removes all elements and keeps the memory, in time proportional to the table.</summary>
    public void Clear()
    {
        Table.Clear(0, Table.Length);
        Count = 0;
    }

    /// <summary>Removes all elements and keeps the memory, in time proportional to the number of elements.</summary>
    public void FastClear()
    {
        ProbingTable.ClearByKeys(Table, TableMask, Keys, Count, ref EqualityComparer);
        Count = 0;
    }

    /// <summary>Finds the slot and the index of a key.</summary>
    /// <param name="key">Key to look for.</param>
    /// <param name="tableIndex">Slot of the key, or the empty one where it belongs.</param>
    /// <param name="elementIndex">Index of the key, or -1.</param>
    /// <returns>Whether the key is there.</returns>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public bool GetTableIndices(in TKey key, out int tableIndex, out int elementIndex) =>
        ProbingTable.Find(Table, TableMask, Keys, ref Unsafe.AsRef(in key), ref EqualityComparer, out tableIndex, out elementIndex);

    /// <summary>Asks the processor to load the slot that a lookup of a key will begin with. Changes no result.</summary>
    /// <param name="key">The key.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly unsafe void PrefetchSlot(in TKey key)
    {
        var comparer = EqualityComparer;
        Prefetch.Read(Table.Memory + ProbingTable.GetHome(ref Unsafe.AsRef(in key), TableMask, ref comparer));
    }

    /// <summary>Asks the processor to load the key and the value that a lookup will most likely end with. Changes no result.</summary>
    /// <param name="key">The key, whose slot should be loaded.</param>
    /// <returns>Index of the element in question, which may be another's; -1 where there is none.</returns>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly unsafe int PrefetchElement(in TKey key)
    {
        var comparer = EqualityComparer;
        var index = Table[ProbingTable.GetHome(ref Unsafe.AsRef(in key), TableMask, ref comparer)] - 1;
        if (index >= 0)
        {
            Prefetch.Read(Keys.Memory + index);
            Prefetch.Read(Values.Memory + index);
        }
        return index;
    }


    /// <summary>Index of a key, or -1.</summary>
    public int IndexOf(in TKey key) => GetTableIndices(in key, out _, out var index) ? index : -1;

    /// <summary>Whether a key is there.</summary>
    public bool ContainsKey(in TKey key) => IndexOf(in key) >= 0;

    /// <summary>Value of a key, if the key is there; otherwise zeros.</summary>
    public bool TryGetValue(in TKey key, out TValue value)
    {
        if (GetTableIndices(in key, out _, out var index))
        {
            value = Values[index];
            return true;
        }
        value = default;
        return false;
    }

    int Append(in TKey key, int tableIndex)
    {
        Check.That(Count < Keys.Length);
        var index = Count++;
        Keys[index] = key;
        Table[tableIndex] = Count;
        return index;
    }
}
