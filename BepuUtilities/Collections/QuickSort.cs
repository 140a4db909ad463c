using System;
using System.Numerics;
using BepuUtilities.Memory;

namespace BepuUtilities.Collections;

/// <summary>Sorts in place, with the same result for the same input everywhere. Not stable: a comparer that never says "equal" fixes the order.</summary>
/// <remarks>
/// Introspective sort (Musser, 1997): quicksort with the median of three as pivot, heap sort when it recurses deeper than twice the
/// logarithm, insertion sort for short ranges. It draws no random numbers. A comparer that contradicts itself gives some order or an
/// <see cref="IndexOutOfRangeException"/>, never a write outside the spans.
/// </remarks>
public static class QuickSort
{
    const int InsertionSortLimit = 16;

    /// <summary>Sorts keys in ascending order of the comparer.</summary>
    public static void Sort<TKey, TComparer>(Span<TKey> keys, ref TComparer comparer) where TKey : unmanaged where TComparer : IComparerRef<TKey> =>
        SortRange<TKey, NoValue, TComparer>(keys, default, ref comparer, GetDepthLimit(keys.Length));

    /// <summary>Sorts keys in ascending order of the comparer and moves each one's value along.</summary>
    public static void Sort<TKey, TValue, TComparer>(Span<TKey> keys, Span<TValue> values, ref TComparer comparer)
        where TKey : unmanaged where TValue : unmanaged where TComparer : IComparerRef<TKey>
    {
        ArgumentOutOfRangeException.ThrowIfNotEqual(values.Length, keys.Length, "values.Length");
        SortRange(keys, values, ref comparer, GetDepthLimit(keys.Length));
    }

    /// <summary>Sorts the first keys of a buffer in ascending order of the comparer.</summary>
    public static void Sort<TKey, TComparer>(in Buffer<TKey> keys, int count, ref TComparer comparer)
        where TKey : unmanaged where TComparer : IComparerRef<TKey> => Sort(keys.AsSpan()[..count], ref comparer);

    static int GetDepthLimit(int count) => 2 * (BitOperations.Log2((uint)count) + 1);

    static void SortRange<TKey, TValue, TComparer>(Span<TKey> keys, Span<TValue> values, ref TComparer comparer, int depthLimit)
        where TKey : unmanaged where TValue : unmanaged where TComparer : IComparerRef<TKey>
    {
        while (keys.Length > InsertionSortLimit)
        {
            if (depthLimit-- == 0)
            {
                HeapSort(keys, values, ref comparer);
                return;
            }
            var split = Partition(keys, values, ref comparer);
            // Recursion into the shorter side alone bounds the stack by the logarithm, whatever the depth limit.
            if (split < keys.Length - split)
            {
                SortRange(keys[..split], Values(values, 0, split), ref comparer, depthLimit);
                values = Values(values, split, keys.Length - split);
                keys = keys[split..];
            }
            else
            {
                SortRange(keys[split..], Values(values, split, keys.Length - split), ref comparer, depthLimit);
                values = Values(values, 0, split);
                keys = keys[..split];
            }
        }
        InsertionSort(keys, values, ref comparer);
    }

    /// <summary>Divides a range in two such that no key of the second part comes before one of the first; both have keys.</summary>
    static int Partition<TKey, TValue, TComparer>(Span<TKey> keys, Span<TValue> values, ref TComparer comparer)
        where TKey : unmanaged where TValue : unmanaged where TComparer : IComparerRef<TKey>
    {
        // The median of first, middle and last comes to the middle; the outer two then stop the scans at the ends.
        int middle = keys.Length / 2, last = keys.Length - 1;
        OrderTwo(keys, values, 0, middle, ref comparer);
        OrderTwo(keys, values, middle, last, ref comparer);
        OrderTwo(keys, values, 0, middle, ref comparer);
        var pivot = keys[middle];
        int low = 0, high = last;
        while (true)
        {
            // Both scans stop at keys equal to the pivot, so that many equal keys are still cut in halves.
            do
                ++low;
            while (comparer.Compare(ref keys[low], ref pivot) < 0);
            do
                --high;
            while (comparer.Compare(ref keys[high], ref pivot) > 0);
            if (low >= high)
                return low;
            Swap(keys, values, low, high);
        }
    }

    static void HeapSort<TKey, TValue, TComparer>(Span<TKey> keys, Span<TValue> values, ref TComparer comparer)
        where TKey : unmanaged where TValue : unmanaged where TComparer : IComparerRef<TKey>
    {
        for (int i = keys.Length / 2 - 1; i >= 0; --i)
            SiftDown(keys, values, i, keys.Length, ref comparer);
        for (int end = keys.Length - 1; end > 0; --end)
        {
            Swap(keys, values, 0, end);
            SiftDown(keys, values, 0, end, ref comparer);
        }
    }

    static void SiftDown<TKey, TValue, TComparer>(Span<TKey> keys, Span<TValue> values, int parent, int count, ref TComparer comparer)
        where TKey : unmanaged where TValue : unmanaged where TComparer : IComparerRef<TKey>
    {
        while (true)
        {
            var child = 2 * parent + 1;
            if (child >= count)
                return;
            if (child + 1 < count && comparer.Compare(ref keys[child], ref keys[child + 1]) < 0)
                ++child;
            if (comparer.Compare(ref keys[parent], ref keys[child]) >= 0)
                return;
            Swap(keys, values, parent, child);
            parent = child;
        }
    }

    static void InsertionSort<TKey, TValue, TComparer>(Span<TKey> keys, Span<TValue> values, ref TComparer comparer)
        where TKey : unmanaged where TValue : unmanaged where TComparer : IComparerRef<TKey>
    {
        for (int i = 1; i < keys.Length; ++i)
        {
            if (comparer.Compare(ref keys[i - 1], ref keys[i]) <= 0)
                continue;
            // It goes to its place in one move, as the others step aside.
            var key = keys[i];
            var value = typeof(TValue) == typeof(NoValue) ? default : values[i];
            var target = i;
            do
            {
                keys[target] = keys[target - 1];
                if (typeof(TValue) != typeof(NoValue))
                    values[target] = values[target - 1];
                --target;
            }
            while (target > 0 && comparer.Compare(ref keys[target - 1], ref key) > 0);
            keys[target] = key;
            if (typeof(TValue) != typeof(NoValue))
                values[target] = value;
        }
    }

    static void OrderTwo<TKey, TValue, TComparer>(Span<TKey> keys, Span<TValue> values, int a, int b, ref TComparer comparer)
        where TKey : unmanaged where TValue : unmanaged where TComparer : IComparerRef<TKey>
    {
        if (comparer.Compare(ref keys[a], ref keys[b]) > 0)
            Swap(keys, values, a, b);
    }

    static void Swap<TKey, TValue>(Span<TKey> keys, Span<TValue> values, int a, int b) where TKey : unmanaged where TValue : unmanaged
    {
        (keys[a], keys[b]) = (keys[b], keys[a]);
        if (typeof(TValue) != typeof(NoValue))
            (values[a], values[b]) = (values[b], values[a]);
    }

    static Span<TValue> Values<TValue>(Span<TValue> values, int start, int count) where TValue : unmanaged =>
        typeof(TValue) == typeof(NoValue) ? default : values.Slice(start, count);

    /// <summary>Stands for values that there are none of: one source serves both sorts, and the JIT drops what is for values.</summary>
    struct NoValue
    {
    }
}
