using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities.Memory;

namespace BepuUtilities.Collections;

/// <summary>Stable sorts of unsigned keys that carry an index each. The result depends on keys and order alone: equal keys keep their order.</summary>
/// <remarks>
/// Counting sort by bytes from the least significant (Knuth, The Art of Computer Programming 3, 5.2.5, algorithm R). The counts of all
/// bytes are made in one pass, and bytes that are the same in all keys are skipped: keys made of handles have many of those.
/// </remarks>
public static class RadixSort
{
    // Below about this many keys clearing and summing the counts costs more than inserting.
    const int InsertionSortLimit = 32;
    const int DigitBits = 8;
    const int DigitCount = 1 << DigitBits;

    /// <summary>Sorts keys ascending and moves each one's value along, with scratch memory of the same lengths.</summary>
    /// <param name="keys">Keys to sort.</param>
    /// <param name="values">A value per key.</param>
    /// <param name="scratchKeys">Memory to work in, at least as long as the keys; its contents are undefined afterwards.</param>
    /// <param name="scratchValues">Memory to work in, at least as long as the keys; its contents are undefined afterwards.</param>
    public static void Sort(Span<ulong> keys, Span<int> values, Span<ulong> scratchKeys, Span<int> scratchValues) =>
        SortGeneric(keys, values, scratchKeys, scratchValues);

    /// <inheritdoc cref="Sort(Span{ulong}, Span{int}, Span{ulong}, Span{int})"/>
    public static void Sort(Span<uint> keys, Span<int> values, Span<uint> scratchKeys, Span<int> scratchValues) =>
        SortGeneric(keys, values, scratchKeys, scratchValues);

    /// <summary>Sorts the first keys of a buffer ascending and moves each one's value along.</summary>
    /// <param name="keys">Keys to sort.</param>
    /// <param name="values">A value per key.</param>
    /// <param name="count">Number of keys.</param>
    /// <param name="pool">Where memory to work in comes from; it is given back.</param>
    public static void Sort(in Buffer<ulong> keys, in Buffer<int> values, int count, IUnmanagedMemoryPool pool) =>
        SortWithPool<ulong>(keys, values, count, pool);

    /// <inheritdoc cref="Sort(in Buffer{ulong}, in Buffer{int}, int, IUnmanagedMemoryPool)"/>
    public static void Sort(in Buffer<uint> keys, in Buffer<int> values, int count, IUnmanagedMemoryPool pool) =>
        SortWithPool<uint>(keys, values, count, pool);

    static void SortWithPool<TKey>(Span<TKey> keys, Span<int> values, int count, IUnmanagedMemoryPool pool)
        where TKey : unmanaged, IBinaryInteger<TKey>, IUnsignedNumber<TKey>
    {
        ArgumentNullException.ThrowIfNull(pool);
        keys = keys[..count];
        values = values[..count];
        if (count <= InsertionSortLimit)
        {
            InsertionSort(keys, values);
            return;
        }
        pool.Take(count, out Buffer<TKey> scratchKeys);
        pool.Take(count, out Buffer<int> scratchValues);
        SortGeneric(keys, values, scratchKeys, scratchValues);
        pool.Return(ref scratchKeys);
        pool.Return(ref scratchValues);
    }

    static void SortGeneric<TKey>(Span<TKey> keys, Span<int> values, Span<TKey> scratchKeys, Span<int> scratchValues)
        where TKey : unmanaged, IBinaryInteger<TKey>, IUnsignedNumber<TKey>
    {
        ArgumentOutOfRangeException.ThrowIfNotEqual(values.Length, keys.Length, "values.Length");
        ArgumentOutOfRangeException.ThrowIfLessThan(scratchKeys.Length, keys.Length, "scratchKeys.Length");
        ArgumentOutOfRangeException.ThrowIfLessThan(scratchValues.Length, keys.Length, "scratchValues.Length");
        if (keys.Length <= InsertionSortLimit)
        {
            InsertionSort(keys, values);
            return;
        }
        var passCount = Unsafe.SizeOf<TKey>() * 8 / DigitBits;
        Span<int> counts = stackalloc int[passCount * DigitCount];
        CountDigits(keys, counts, passCount);

        var sourceKeys = keys;
        var sourceValues = values;
        var targetKeys = scratchKeys[..keys.Length];
        var targetValues = scratchValues[..keys.Length];
        for (int pass = 0; pass < passCount; ++pass)
        {
            var passCounts = counts.Slice(pass * DigitCount, DigitCount);
            if (passCounts[GetDigit(sourceKeys[0], pass)] == keys.Length)
                continue;
            Scatter(sourceKeys, sourceValues, targetKeys, targetValues, passCounts, pass);
            // Spans cannot be swapped as a tuple: they are by-reference types.
            var keysOfPass = sourceKeys;
            sourceKeys = targetKeys;
            targetKeys = keysOfPass;
            var valuesOfPass = sourceValues;
            sourceValues = targetValues;
            targetValues = valuesOfPass;
        }
        if (sourceKeys != keys)
        {
            sourceKeys.CopyTo(keys);
            sourceValues.CopyTo(values);
        }
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static int GetDigit<TKey>(TKey key, int pass) where TKey : unmanaged, IBinaryInteger<TKey> =>
        (int)(uint.CreateTruncating(key >> (pass * DigitBits)) & (DigitCount - 1));

    static void CountDigits<TKey>(ReadOnlySpan<TKey> keys, Span<int> counts, int passCount) where TKey : unmanaged, IBinaryInteger<TKey>
    {
        counts.Clear();
        foreach (var key in keys)
        {
            for (int pass = 0; pass < passCount; ++pass)
                ++counts[pass * DigitCount + GetDigit(key, pass)];
        }
    }

    static void Scatter<TKey>(ReadOnlySpan<TKey> keys, ReadOnlySpan<int> values, Span<TKey> targetKeys, Span<int> targetValues,
        Span<int> counts, int pass) where TKey : unmanaged, IBinaryInteger<TKey>
    {
        var start = 0;
        foreach (ref var count in counts)
        {
            var next = start + count;
            count = start;
            start = next;
        }
        for (int i = 0; i < keys.Length; ++i)
        {
            var key = keys[i];
            var target = counts[GetDigit(key, pass)]++;
            targetKeys[target] = key;
            targetValues[target] = values[i];
        }
    }

    static void InsertionSort<TKey>(Span<TKey> keys, Span<int> values) where TKey : unmanaged, IBinaryInteger<TKey>
    {
        for (int i = 1; i < keys.Length; ++i)
        {
            var key = keys[i];
            var value = values[i];
            var target = i;
            for (; target > 0 && keys[target - 1] > key; --target)
            {
                keys[target] = keys[target - 1];
                values[target] = values[target - 1];
            }
            keys[target] = key;
            values[target] = value;
        }
    }
}
