using System;
using System.Runtime.CompilerServices;
using BepuUtilities.Memory;

namespace BepuUtilities.Collections;

/// <content>Adding and removing.</content>
public partial struct QuickDictionary<TKey, TValue, TComparer>
{
    /// <summary>Finds the place of a key, or makes one whose value is undefined.</summary>
    /// <param name="key">Key to look for.</param>
    /// <param name="pool">Where more memory comes from.</param>
    /// <param name="slotIndex">Index of the key and its value.</param>
    /// <returns>Whether the key was there before.</returns>
    public bool FindOrAllocateSlot(in TKey key, IUnmanagedMemoryPool pool, out int slotIndex)
    {
        // The key may be one of this map's own, in memory that growing gives back: copy it first.
        var copy = key;
        if (Count == Keys.Length)
        {
            slotIndex = IndexOf(in copy);
            if (slotIndex >= 0)
                return true;
            EnsureCapacity(checked(Count + 1), pool);
        }
        return FindOrAllocateSlotUnsafely(in copy, out slotIndex);
    }

    /// <summary>Finds the place of a key, or makes one whose value is undefined, into room that is there.</summary>
    /// <param name="key">Key to look for.</param>
    /// <param name="slotIndex">Index of the key and its value.</param>
    /// <returns>Whether the key was there before.</returns>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public bool FindOrAllocateSlotUnsafely(in TKey key, out int slotIndex)
    {
        if (GetTableIndices(in key, out var tableIndex, out slotIndex))
            return true;
        slotIndex = Append(in key, tableIndex);
        return false;
    }

    /// <summary>Adds a key and its value unless the key is there.</summary>
    /// <returns>Whether it was added.</returns>
    public bool Add(in TKey key, in TValue value, IUnmanagedMemoryPool pool)
    {
        var copy = value;
        if (FindOrAllocateSlot(in key, pool, out var index))
            return false;
        Values[index] = copy;
        return true;
    }

    /// <summary>Adds a key and its value unless the key is there, into room that is there.</summary>
    /// <returns>Whether it was added.</returns>
    public bool AddUnsafely(in TKey key, in TValue value)
    {
        if (FindOrAllocateSlotUnsafely(in key, out var index))
            return false;
        Values[index] = value;
        return true;
    }

    /// <summary>Adds a key and its value, or replaces the key and the value that are there.</summary>
    /// <returns>Whether it was added, that is, none was replaced.</returns>
    public bool AddAndReplace(in TKey key, in TValue value, IUnmanagedMemoryPool pool)
    {
        var keyCopy = key;
        var valueCopy = value;
        var found = FindOrAllocateSlot(in keyCopy, pool, out var index);
        Keys[index] = keyCopy;
        Values[index] = valueCopy;
        return !found;
    }

    /// <summary>Adds a key and its value, or replaces the key and the value that are there; into room that is there.</summary>
    /// <returns>Whether it was added, that is, none was replaced.</returns>
    public bool AddAndReplaceUnsafely(in TKey key, in TValue value)
    {
        var found = FindOrAllocateSlotUnsafely(in key, out var index);
        Keys[index] = key;
        Values[index] = value;
        return !found;
    }

    /// <summary>Removes a key and its value; the last ones take their place.</summary>
    /// <returns>Whether the key was there.</returns>
    public bool FastRemove(in TKey key)
    {
        if (!GetTableIndices(in key, out var tableIndex, out var index))
            return false;
        Remove(tableIndex, index);
        return true;
    }

    /// <summary>Removes the key and the value that <see cref="GetTableIndices"/> has found; the last ones take their place.</summary>
    /// <param name="tableIndex">Slot of the key in the table.</param>
    /// <param name="elementIndex">Index of the key and its value.</param>
    /// <exception cref="ArgumentException">The slot is not that of the element.</exception>
    public void FastRemove(int tableIndex, int elementIndex)
    {
        if ((uint)elementIndex >= (uint)Count || (uint)tableIndex > (uint)TableMask || Table[tableIndex] != elementIndex + 1)
            throw new ArgumentException($"Slot {tableIndex} of the table is not that of element {elementIndex}.", nameof(tableIndex));
        Remove(tableIndex, elementIndex);
    }

    /// <summary>Removes the key and the value at an index; the last ones take their place.</summary>
    public void FastRemoveAt(int index)
    {
        ArgumentOutOfRangeException.ThrowIfNegative(index);
        ArgumentOutOfRangeException.ThrowIfGreaterThanOrEqual(index, Count);
        Remove(ProbingTable.FindSlotOfIndex(Table, TableMask, Keys, index, ref EqualityComparer), index);
    }

    void Remove(int tableIndex, int index)
    {
        ProbingTable.RemoveSlot(Table, TableMask, Keys, tableIndex, ref EqualityComparer);
        var last = Count - 1;
        if (index < last)
        {
            Table[ProbingTable.FindSlotOfIndex(Table, TableMask, Keys, last, ref EqualityComparer)] = index + 1;
            Keys[index] = Keys[last];
            Values[index] = Values[last];
        }
        Count = last;
    }
}
