using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.Constraints.Contact;

/// <summary>The pairs that meet within a substep, the earliest first, and the pairs of each body.</summary>
// A binary heap over the times of the pairs. Of equal times the faster pair comes first, then the one that is first in the list.
unsafe struct ImpactQueue(BufferPool pool)
{
    // Indices of pairs.
    QuickList<int> heap = new(16, pool);
    // First pair of each body of the active set; -1 for none.
    QuickList<int> firstOfBody = new(16, pool);

    internal void Dispose()
    {
        heap.Dispose(pool);
        firstOfBody.Dispose(pool);
    }

    /// <summary>Whether no pair meets any more.</summary>
    internal readonly bool IsEmpty => heap.Count == 0;

    /// <summary>Links pairs to their bodies.</summary>
    internal void Link(ref QuickList<BouncingPair> pairs, int bodyCount)
    {
        firstOfBody.EnsureCapacity(bodyCount, pool);
        firstOfBody.Count = bodyCount;
        firstOfBody.AsSpan().Fill(-1);
        for (int i = pairs.Count - 1; i >= 0; --i)
        {
            ref var pair = ref pairs[i];
            pair.NextOfA = firstOfBody[pair.A];
            firstOfBody[pair.A] = i;
            if (pair.B < 0)
                continue;
            pair.NextOfB = firstOfBody[pair.B];
            firstOfBody[pair.B] = i;
        }
    }

    /// <summary>First pair of a body.</summary>
    internal readonly int FirstOf(int body) => firstOfBody[body];

    /// <summary>Begins a substep.</summary>
    internal void Fill(ref QuickList<BouncingPair> pairs)
    {
        heap.Count = 0;
        for (int i = 0; i < pairs.Count; ++i)
        {
            pairs[i].QueueIndex = -1;
            pairs[i].ImpactCount = 0;
            Update(ref pairs, i);
        }
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
