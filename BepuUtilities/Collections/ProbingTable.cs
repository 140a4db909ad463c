using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities.Diagnostics;
using BepuUtilities.Memory;

namespace BepuUtilities.Collections;

/// <summary>The hash table that <see cref="QuickSet{T, TComparer}"/> and <see cref="QuickDictionary{TKey, TValue, TComparer}"/> share.</summary>
/// <remarks>
/// Open addressing with linear probing (Knuth, The Art of Computer Programming 3, 6.4, algorithms L and R). A slot holds the index
/// of a key plus one, or zero when it is empty. Keys lie densely in their own buffer, so that going through them needs no table and
/// has an order that depends on the calls alone, never on hashes. Invariants: the table's length is a power of two and more than
/// the number of keys, so that a probe ends; between a key's home slot and its own slot no slot is empty.
/// </remarks>
static class ProbingTable
{
    /// <summary>Number of slots for so many keys, as large as 2^tableSizePower times their number rounded up to a power of two.</summary>
    public static int GetTableSize(int keyCapacity, int tableSizePower)
    {
        var size = (ulong)BitOperations.RoundUpToPowerOf2((uint)Math.Max(keyCapacity, 1)) << tableSizePower;
        ArgumentOutOfRangeException.ThrowIfGreaterThan(size, 1UL << 30, nameof(keyCapacity));
        return (int)size;
    }

    /// <summary>Refuses sizes at which a table would fill up or a shift would overflow.</summary>
    public static void CheckTableSizePower(int tableSizePower)
    {
        ArgumentOutOfRangeException.ThrowIfLessThan(tableSizePower, 1);
        ArgumentOutOfRangeException.ThrowIfGreaterThan(tableSizePower, 16);
    }

    /// <summary>Where the probe for a key begins.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static int GetHome<TKey, TComparer>(ref TKey key, int mask, ref TComparer comparer) where TComparer : IEqualityComparerRef<TKey>
    {
        // Hashes of handles and indices are runs of integers, pairs of them packed in high and low halves: a multiplication carries
        // all bits upwards, the shift brings them down to where the mask looks (2^32 over the golden ratio, Knuth 6.4).
        var mixed = (uint)comparer.Hash(ref key) * 2654435769u;
        return (int)(mixed ^ (mixed >> 15)) & mask;
    }

    /// <summary>Finds a key's slot and index; or the empty slot where it belongs, and the index -1.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static bool Find<TKey, TComparer>(in Buffer<int> table, int mask, in Buffer<TKey> keys, ref TKey key, ref TComparer comparer,
        out int tableIndex, out int keyIndex) where TKey : unmanaged where TComparer : IEqualityComparerRef<TKey>
    {
        Check.That(mask > 0);
        tableIndex = GetHome(ref key, mask, ref comparer);
        while ((keyIndex = table[tableIndex] - 1) >= 0)
        {
            if (comparer.Equals(ref keys[keyIndex], ref key))
                return true;
            tableIndex = (tableIndex + 1) & mask;
        }
        return false;
    }

    /// <summary>Empties a slot and closes the gap, so that probes for the keys behind it still find them.</summary>
    public static void RemoveSlot<TKey, TComparer>(in Buffer<int> table, int mask, in Buffer<TKey> keys, int tableIndex, ref TComparer comparer)
        where TKey : unmanaged where TComparer : IEqualityComparerRef<TKey>
    {
        var gap = tableIndex;
        for (var probe = (gap + 1) & mask; table[probe] != 0; probe = (probe + 1) & mask)
        {
            // A key may move into the gap unless its home lies behind the gap: distances are counted around the ring.
            var home = GetHome(ref keys[table[probe] - 1], mask, ref comparer);
            if (((probe - home) & mask) >= ((probe - gap) & mask))
            {
                table[gap] = table[probe];
                gap = probe;
            }
        }
        table[gap] = 0;
    }

    /// <summary>Slot that holds the index of a key, which must be in the table.</summary>
    public static int FindSlotOfIndex<TKey, TComparer>(in Buffer<int> table, int mask, in Buffer<TKey> keys, int keyIndex, ref TComparer comparer)
        where TKey : unmanaged where TComparer : IEqualityComparerRef<TKey>
    {
        var tableIndex = GetHome(ref keys[keyIndex], mask, ref comparer);
        while (table[tableIndex] != keyIndex + 1)
        {
            Check.That(table[tableIndex] != 0);
            tableIndex = (tableIndex + 1) & mask;
        }
        return tableIndex;
    }

    /// <summary>Enters the first keys of a buffer, all different, into an empty table.</summary>
    public static void Build<TKey, TComparer>(in Buffer<int> table, int mask, in Buffer<TKey> keys, int count, ref TComparer comparer)
        where TKey : unmanaged where TComparer : IEqualityComparerRef<TKey>
    {
        for (int i = 0; i < count; ++i)
        {
            var tableIndex = GetHome(ref keys[i], mask, ref comparer);
            while (table[tableIndex] != 0)
                tableIndex = (tableIndex + 1) & mask;
            table[tableIndex] = i + 1;
        }
    }

    /// <summary>Empties a table by way of its keys: for few keys in a large table.</summary>
    public static void ClearByKeys<TKey, TComparer>(in Buffer<int> table, int mask, in Buffer<TKey> keys, int count, ref TComparer comparer)
        where TKey : unmanaged where TComparer : IEqualityComparerRef<TKey>
    {
        for (int i = 0; i < count; ++i)
        {
            // From a key's home to the next empty slot all slots are taken by keys, and all of them go. What is already empty
            // within a run is always the end of that run, so no key is passed over.
            for (var tableIndex = GetHome(ref keys[i], mask, ref comparer); table[tableIndex] != 0; tableIndex = (tableIndex + 1) & mask)
                table[tableIndex] = 0;
        }
    }
}
