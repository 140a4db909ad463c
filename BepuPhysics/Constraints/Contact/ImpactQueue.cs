using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.Constraints.Contact;

/// <summary>The pairs of a group that meet within a substep, the earliest first.</summary>
// A binary heap over the times of the pairs. Of equal times the faster pair comes first, then the one that is first in the list.
unsafe struct ImpactQueue(BufferPool pool)
{
    // Indices of pairs.
    QuickList<int> heap = new(16, pool);

    internal void Dispose() => heap.Dispose(pool);

    /// <summary>Whether no pair meets any more.</summary>
    internal readonly bool IsEmpty => heap.Count == 0;

    /// <summary>Begins a substep of a group.</summary>
    /// <returns>Whether any of its pairs meets, or overlaps.</returns>
    internal bool Fill(ref QuickList<BouncingPair> pairs, in ImpactGroups groups, int group)
    {
        heap.Count = 0;
        var overlaps = false;
        for (int i = 0; i < groups.CountOf(group); ++i)
        {
            var pair = groups.Pair(group, i);
            pairs[pair].QueueIndex = -1;
            pairs[pair].ImpactCount = 0;
            overlaps |= pairs[pair].Overlaps || (pairs[pair].Presses && pairs[pair].Hangs);
            Update(ref pairs, pair);
        }
        return overlaps || !IsEmpty;
    }

    /// <summary>The pair that meets first.</summary>
    internal readonly int First => heap[0];

    /// <summary>Puts a pair to its place after its time has changed.</summary>
    internal void Update(ref QuickList<BouncingPair> pairs, int pair)
    {
        var place = pairs[pair].QueueIndex;
        if (pairs[pair].Time < BouncingPair.Never)
        {
            if (place < 0)
            {
                place = heap.Count;
                heap.Add(pair, pool);
                pairs[pair].QueueIndex = place;
            }
            Settle(ref pairs, place);
        }
        else if (place >= 0)
        {
            pairs[pair].QueueIndex = -1;
            var last = heap[heap.Count - 1];
            --heap.Count;
            if (place == heap.Count)
                return;
            heap[place] = last;
            pairs[last].QueueIndex = place;
            Settle(ref pairs, place);
        }
    }

    readonly void Settle(ref QuickList<BouncingPair> pairs, int place)
    {
        while (place > 0 && Precedes(ref pairs, place, (place - 1) / 2))
        {
            Swap(ref pairs, place, (place - 1) / 2);
            place = (place - 1) / 2;
        }
        while (true)
        {
            var earliest = place;
            for (int child = 2 * place + 1; child <= 2 * place + 2 && child < heap.Count; ++child)
            {
                if (Precedes(ref pairs, child, earliest))
                    earliest = child;
            }
            if (earliest == place)
                return;
            Swap(ref pairs, place, earliest);
            place = earliest;
        }
    }

    readonly bool Precedes(ref QuickList<BouncingPair> pairs, int x, int y)
    {
        ref var a = ref pairs[heap[x]];
        ref var b = ref pairs[heap[y]];
        if (a.Time != b.Time)
            return a.Time < b.Time;
        return a.Speed != b.Speed ? a.Speed > b.Speed : heap[x] < heap[y];
    }

    readonly void Swap(ref QuickList<BouncingPair> pairs, int x, int y)
    {
        (heap[x], heap[y]) = (heap[y], heap[x]);
        pairs[heap[x]].QueueIndex = x;
        pairs[heap[y]].QueueIndex = y;
    }
}
