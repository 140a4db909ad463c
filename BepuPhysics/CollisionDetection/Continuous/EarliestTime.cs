using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>Which of numbered pairs meets first, while the times of some change.</summary>
// A binary heap of those that meet at all, which are few. Of equal times that of the lowest number is found, whatever came before.
struct EarliestTime(BufferPool pool)
{
    struct Meeting
    {
        public double Time;
        public int Number;
    }

    QuickList<Meeting> heap = new(16, pool);
    // Of each number its place in the heap, or -1.
    QuickList<int> places = new(16, pool);

    /// <summary>Begins with numbers that never meet.</summary>
    public void Clear(int count, BufferPool pool)
    {
        heap.Count = 0;
        places.EnsureCapacity(count, pool);
        places.Count = count;
        places.AsSpan().Fill(-1);
    }

    /// <summary>Adds the next number.</summary>
    public void Add(int number, double time, BufferPool pool)
    {
        places.Add(-1, pool);
        Change(number, time, pool);
    }

    /// <summary>Changes a time.</summary>
    public void Change(int number, double time, BufferPool pool)
    {
        var place = places[number];
        if (time < FastPair.Never)
        {
            if (place < 0)
            {
                place = heap.Count;
                heap.Add(default, pool);
            }
            Settle(place, new() { Time = time, Number = number });
        }
        else if (place >= 0)
        {
            places[number] = -1;
            var last = heap[heap.Count - 1];
            --heap.Count;
            if (place < heap.Count)
                Settle(place, last);
        }
    }

    /// <summary>The number with the earliest time, the lowest if there are several; -1 if nothing meets.</summary>
    public readonly int First => heap.Count > 0 ? heap[0].Number : -1;

    // Puts a meeting where one has gone.
    readonly void Settle(int place, in Meeting meeting)
    {
        for (; place > 0 && Precedes(meeting, heap[(place - 1) / 2]); place = (place - 1) / 2)
            Put(place, heap[(place - 1) / 2]);
        for (int child; (child = 2 * place + 1) < heap.Count; place = child)
        {
            if (child + 1 < heap.Count && Precedes(heap[child + 1], heap[child]))
                ++child;
            if (!Precedes(heap[child], meeting))
                break;
            Put(place, heap[child]);
        }
        Put(place, meeting);
    }

    readonly void Put(int place, in Meeting meeting)
    {
        heap[place] = meeting;
        places[meeting.Number] = place;
    }

    static bool Precedes(in Meeting a, in Meeting b) => a.Time != b.Time ? a.Time < b.Time : a.Number < b.Number;

    public void Dispose(BufferPool pool)
    {
        heap.Dispose(pool);
        places.Dispose(pool);
    }
}
