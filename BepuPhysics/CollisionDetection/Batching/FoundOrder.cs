using System;
using BepuUtilities.Collections;

namespace BepuPhysics.CollisionDetection;

/// <summary>Brings what was found for a parent in the order of children.</summary>
static unsafe class FoundOrder
{
    // More are rare, and their numbers may need more bits.
    const int MostKeys = 128;
    const int IndexBits = 16, ChildBits = 24;

    struct ByChildren : IComparerRef<FoundChild>
    {
        public readonly int Compare(ref FoundChild a, ref FoundChild b) => a.Children.Order.CompareTo(b.Children.Order);
    }

    struct ByKey : IComparerRef<ulong>
    {
        public readonly int Compare(ref ulong a, ref ulong b) => a < b ? -1 : a > b ? 1 : 0;
    }

    /// <summary>Sorts what was found; no two are the same.</summary>
    public static void Sort(Span<FoundChild> found)
    {
        for (int i = 1; i < found.Length; ++i)
        {
            if (found[i].Children.Order >= found[i - 1].Children.Order)
                continue;
            SortAny(found);
            return;
        }
    }

    static void SortAny(Span<FoundChild> found)
    {
        var keys = stackalloc ulong[MostKeys];
        if (found.Length > MostKeys || !TryMakeKeys(found, keys))
        {
            var order = new ByChildren();
            QuickSort.Sort(found, ref order);
            return;
        }
        var byKey = new ByKey();
        QuickSort.Sort(new Span<ulong>(keys, found.Length), ref byKey);
        var unsorted = stackalloc FoundChild[MostKeys];
        found.CopyTo(new(unsorted, found.Length));
        for (int i = 0; i < found.Length; ++i)
            found[i] = unsorted[keys[i] & ((1 << IndexBits) - 1)];
    }

    // Both children and the place in one number: what is moved about is less than half as large, and compared at once.
    static bool TryMakeKeys(Span<FoundChild> found, ulong* keys)
    {
        var all = 0u;
        for (int i = 0; i < found.Length; ++i)
        {
            var (a, b) = ((uint)found[i].Children.A, (uint)found[i].Children.B);
            all |= a | b;
            keys[i] = ((ulong)a << ChildBits | b) << IndexBits | (uint)i;
        }
        return all < 1u << ChildBits;
    }
}
