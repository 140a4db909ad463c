using System;
using System.Runtime.CompilerServices;
using BepuUtilities.Diagnostics;
using BepuUtilities.Memory;

namespace BepuUtilities.Collections;

/// <summary>
/// A growing set over pooled memory. Elements lie densely in <see cref="Span"/>, in an order that depends on the calls alone.
/// It does not keep its pool: whoever adds names it. Copies share the memory but not the count, so pass it by reference.
/// </summary>
/// <remarks>Operations called "unsafely" need room that is there already; validating builds check that, release builds do not.</remarks>
public struct QuickSet<T, TComparer> where T : unmanaged where TComparer : IEqualityComparerRef<T>
{
    /// <summary>Number of elements.</summary>
    public int Count;
    /// <summary>Length of the table less one; the length is a power of two.</summary>
    public int TableMask;
    /// <summary>The table has at least 2^TablePowerOffset slots for each element that there is room for.</summary>
    public int TablePowerOffset;
    /// <summary>For each slot the index of an element plus one, or zero.</summary>
    public Buffer<int> Table;
    /// <summary>Memory of the elements; [0, <see cref="Count"/>) are in use. Do not change what an element is equal to.</summary>
    public Buffer<T> Span;
    /// <summary>Tells which elements are equal.</summary>
    public TComparer EqualityComparer;

    /// <summary>Creates an empty set.</summary>
    /// <param name="initialCapacity">Number of elements that fit without more memory.</param>
    /// <param name="tableSizePower">The table is at least 2^tableSizePower times as large as the capacity; in [1, 16].</param>
    /// <param name="comparer">Tells which elements are equal.</param>
    /// <param name="pool">Where the memory comes from.</param>
    public QuickSet(int initialCapacity, int tableSizePower, TComparer comparer, IUnmanagedMemoryPool pool)
    {
        ArgumentNullException.ThrowIfNull(pool);
        ProbingTable.CheckTableSizePower(tableSizePower);
        EqualityComparer = comparer;
        TablePowerOffset = tableSizePower;
        Resize(initialCapacity, pool);
    }

    /// <summary>Creates an empty set with a table four times as large as its capacity.</summary>
    public QuickSet(int initialCapacity, TComparer comparer, IUnmanagedMemoryPool pool) : this(initialCapacity, 2, comparer, pool)
    {
    }

    /// <summary>Creates an empty set with the comparer's default value and a table four times as large as its capacity.</summary>
    public QuickSet(int initialCapacity, IUnmanagedMemoryPool pool) : this(initialCapacity, 2, default!, pool)
    {
    }

    /// <summary>Element at an index in [0, Count), checked in validating builds only. Do not change what it is equal to.</summary>
    public readonly ref T this[int index]
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get
        {
            Check.That((uint)index < (uint)Count);
            return ref Span[index];
        }
    }

    /// <summary>Makes room for a number of elements in all.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public void EnsureCapacity(int count, IUnmanagedMemoryPool pool)
    {
        if (count > Span.Length)
            Resize(Math.Max(count, (int)Math.Min((long)Span.Length * 2, Array.MaxLength)), pool);
    }

    /// <summary>Changes the room to what the pool gives for a number of elements, which must not be less than the count.</summary>
    public void Resize(int newSize, IUnmanagedMemoryPool pool)
    {
        ArgumentNullException.ThrowIfNull(pool);
        ArgumentOutOfRangeException.ThrowIfLessThan(newSize, Count);
        var capacity = pool.GetCapacityForCount<T>(newSize);
        if (Span.Allocated && capacity == Span.Length)
            return;
        // The table first: should memory run out in between, it still has room for all elements that the span can hold.
        var tableSize = ProbingTable.GetTableSize(capacity, TablePowerOffset);
        if (Table.Length != tableSize)
        {
            pool.Resize(ref Table, tableSize, 0);
            TableMask = tableSize - 1;
            Table.Clear(0, tableSize);
            ProbingTable.Build(Table, TableMask, Span, Count, ref EqualityComparer);
        }
        pool.ResizeToAtLeast(ref Span, newSize, Count);
    }

    /// <summary>Gives back the room that the elements do not need.</summary>
    public void Compact(IUnmanagedMemoryPool pool) => Resize(Count, pool);

    /// <summary>Gives all memory back. The comparer stays.</summary>
    public void Dispose(IUnmanagedMemoryPool pool)
    {
        Span.Dispose(pool);
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
        ProbingTable.ClearByKeys(Table, TableMask, Span, Count, ref EqualityComparer);
        Count = 0;
    }

    /// <summary>Adds an element unless an equal one is there.</summary>
    /// <returns>Whether it was added.</returns>
    public bool Add(in T element, IUnmanagedMemoryPool pool)
    {
        // The element may be one of this set's own, in memory that growing gives back: copy it first.
        var copy = element;
        if (Count == Span.Length)
        {
            if (Contains(in copy))
                return false;
            EnsureCapacity(checked(Count + 1), pool);
        }
        return AddUnsafely(in copy);
    }

    /// <summary>Adds an element unless an equal one is there, into room that is there.</summary>
    /// <returns>Whether it was added.</returns>
    public bool AddUnsafely(in T element)
    {
        if (GetTableIndices(in element, out var tableIndex, out _))
            return false;
        Append(in element, tableIndex);
        return true;
    }

    /// <summary>Adds an element, or puts it in the place of the equal one that is there.</summary>
    /// <returns>Whether it was added, that is, none was replaced.</returns>
    public bool AddAndReplace(in T element, IUnmanagedMemoryPool pool)
    {
        if (Add(in element, pool))
            return true;
        Span[IndexOf(in element)] = element;
        return false;
    }

    /// <summary>Adds an element, or puts it in the place of the equal one that is there; into room that is there.</summary>
    /// <returns>Whether it was added, that is, none was replaced.</returns>
    public bool AddAndReplaceUnsafely(in T element)
    {
        if (GetTableIndices(in element, out var tableIndex, out var index))
        {
            Span[index] = element;
            return false;
        }
        Append(in element, tableIndex);
        return true;
    }

    /// <summary>Index of the element that equals a value, or -1.</summary>
    public int IndexOf(in T element) => GetTableIndices(in element, out _, out var index) ? index : -1;

    /// <summary>Whether an element equals a value.</summary>
    public bool Contains(in T element) => IndexOf(in element) >= 0;

    /// <summary>Finds the slot and the index of the element that equals a value.</summary>
    /// <param name="element">Value to look for.</param>
    /// <param name="tableIndex">Slot of the element, or the empty one where it belongs.</param>
    /// <param name="elementIndex">Index of the element, or -1.</param>
    /// <returns>Whether there is one.</returns>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public bool GetTableIndices(in T element, out int tableIndex, out int elementIndex) =>
        ProbingTable.Find(Table, TableMask, Span, ref Unsafe.AsRef(in element), ref EqualityComparer, out tableIndex, out elementIndex);

    /// <summary>Removes the element that equals a value; the last one takes its place.</summary>
    /// <returns>Whether there was one.</returns>
    public bool FastRemove(in T element)
    {
        if (!GetTableIndices(in element, out var tableIndex, out var index))
            return false;
        FastRemove(tableIndex, index);
        return true;
    }

    /// <summary>Removes the element at an index; the last one takes its place.</summary>
    public void FastRemoveAt(int index)
    {
        ArgumentOutOfRangeException.ThrowIfNegative(index);
        ArgumentOutOfRangeException.ThrowIfGreaterThanOrEqual(index, Count);
        FastRemove(ProbingTable.FindSlotOfIndex(Table, TableMask, Span, index, ref EqualityComparer), index);
    }

    /// <summary>The elements as a span.</summary>
    public static implicit operator ReadOnlySpan<T>(in QuickSet<T, TComparer> set) => set.Span.AsSpan()[..set.Count];

    /// <summary>Goes through the elements by index, as they were counted when the loop began.</summary>
    public readonly Span<T>.Enumerator GetEnumerator() => Span.AsSpan()[..Count].GetEnumerator();

    void Append(in T element, int tableIndex)
    {
        Check.That(Count < Span.Length);
        Span[Count++] = element;
        Table[tableIndex] = Count;
    }

    void FastRemove(int tableIndex, int index)
    {
        ProbingTable.RemoveSlot(Table, TableMask, Span, tableIndex, ref EqualityComparer);
        var last = Count - 1;
        if (index < last)
        {
            Table[ProbingTable.FindSlotOfIndex(Table, TableMask, Span, last, ref EqualityComparer)] = index + 1;
            Span[index] = Span[last];
        }
        Count = last;
    }
}
