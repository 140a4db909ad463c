using System;
using System.Runtime.CompilerServices;
using System.Threading;
using BepuPhysics.Collidables;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>What the pairs of bodies that lie across statics have agreed on, from step to step: the pairs of each body one after the other.</summary>
/// <remarks>
/// While pairs are tested, each notes whether it has found the same again. The pairs of bodies of which all have are the first ones from then on, and where they
/// are among them is where they are among the pairs that agree in this step; behind them is room for those of the others. So of a body at rest nothing is
/// copied, sorted or looked for.
/// </remarks>
struct AgreedPairs
{
    QuickList<AgreedPair> pairs;
    // Place of the first pair of a body, by the body's slot. Of others it says nothing: what is there tells.
    Buffer<int> places;

    // Pairs that there is room for without a need; and how many times those that there are.
    const int LeastRoom = 64, MostRoom = 4;
    const int Nowhere = -1;

    /// <summary>The pairs: between two agreements those that are remembered, and in between all.</summary>
    public readonly Span<AgreedPair> Pairs => pairs.AsSpan();

    /// <summary>Whether the pairs of a body are remembered.</summary>
    public readonly bool Has(CollidableReference body) => PlaceOf(body) != Nowhere;

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    readonly int PlaceOf(CollidableReference body)
    {
        if ((uint)body.Slot >= (uint)places.Length)
            return Nowhere;
        var place = places[body.Slot];
        return place < pairs.Count && pairs[place].PairCount > 0 && (uint)(pairs[place].Key >> 32) == body.Packed ? place : Nowhere;
    }

    /// <summary>Takes down what a pair has found that waits for the others of its body, if those are remembered. By any worker.</summary>
    /// <param name="pair">The pair.</param>
    /// <param name="key">Its key.</param>
    /// <param name="manifold">What it has found: nothing for shapes of children that are near.</param>
    /// <param name="bodies">Where the body is.</param>
    /// <param name="worker">The worker that it waits with.</param>
    /// <param name="index">Its place among those that wait there.</param>
    public readonly void Note(in TestedPair pair, ulong key, in ConvexContactManifold manifold, Bodies bodies, int worker, int index)
    {
        var place = PlaceOf(pair.Pair.A);
        if (place == Nowhere)
            return;
        ref var location = ref bodies.Locations[pair.Pair.A.Slot];
        ref var orientation = ref bodies.SetOf(location).MotionStates[location.Index].Pose.Orientation;
        ref var first = ref pairs[place];
        for (int i = place; i < place + first.PairCount; ++i)
        {
            ref var agreed = ref pairs[i];
            if (agreed.Key != key)
                continue;
            if (!agreed.Holds(manifold, orientation))
                break;
            agreed.Worker = worker;
            agreed.Index = index;
            Interlocked.Increment(ref first.HeldCount);
            return;
        }
        first.HasChanged = true;
    }

    /// <summary>Takes down that a pair which waits has found what is not remembered.</summary>
    public readonly void NoteChange(CollidableReference body)
    {
        var place = PlaceOf(body);
        if (place != Nowhere)
            pairs[place].HasChanged = true;
    }

    /// <summary>Forgets the pairs of all bodies of which one has not found the same again.</summary>
    public void KeepHeld()
    {
        var count = 0;
        for (int i = 0; i < pairs.Count;)
        {
            ref var first = ref pairs[i];
            var pairCount = first.PairCount;
            if (!first.HasChanged && first.HeldCount == pairCount)
            {
                first.HeldCount = 0;
                for (int j = 0; j < pairCount; ++j)
                {
                    --pairs[i + j].Remaining;
                    if (i != count)
                        pairs[count + j] = pairs[i + j];
                }
                places[SlotOf(count)] = count;
                count += pairCount;
            }
            i += pairCount;
        }
        pairs.Count = count;
    }

    /// <summary>Makes room behind the pairs that are kept. Takes no memory before the first pair.</summary>
    /// <param name="count">Number of pairs that agree anew.</param>
    /// <param name="pool">Source of memory.</param>
    public void Begin(int count, BufferPool pool)
    {
        if (count == 0)
            return;
        if (!pairs.Span.Allocated)
            pairs = new(count, pool);
        pairs.EnsureCapacity(pairs.Count + count, pool);
        pairs.Count += count;
    }

    /// <summary>Leaves out of those that have agreed anew what is not to be remembered.</summary>
    /// <param name="kept">Number of those that were kept.</param>
    /// <param name="slotCount">Number of slots that bodies have.</param>
    /// <param name="pool">Source of memory.</param>
    public void End(int kept, int slotCount, BufferPool pool)
    {
        if (!pairs.Span.Allocated)
            return;
        var total = pairs.Count;
        pairs.Count = kept;
        var first = Nowhere;
        for (int i = kept; i < total; ++i)
        {
            if (pairs[i].Remaining == 0)
                continue;
            var place = pairs.Count++;
            pairs[place] = pairs[i];
            if (first != Nowhere && pairs[first].Key >> 32 == pairs[place].Key >> 32)
            {
                ++pairs[first].PairCount;
                continue;
            }
            first = place;
            pairs[place].PairCount = 1;
            if (SlotOf(place) >= places.Length)
                Grow(slotCount, pool);
            places[SlotOf(place)] = place;
        }
        // In its first step each pair waits; of what lies on one ground, no later one.
        if (pairs.Span.Length <= Math.Max(LeastRoom, MostRoom * total))
            return;
        if (pairs.Count > 0)
            pairs.Resize(pairs.Count, pool);
        else
        {
            pairs.Dispose(pool);
            pairs = default;
        }
    }

    readonly int SlotOf(int place) => (int)(pairs[place].Key >> 32) & BodyHandle.SlotMask;

    void Grow(int slotCount, BufferPool pool)
    {
        var previous = places.Length;
        pool.ResizeToAtLeast(ref places, slotCount, previous);
        places.Clear(previous, places.Length - previous);
    }

    /// <summary>Forgets everything.</summary>
    public void Clear() => pairs.Count = 0;

    /// <summary>Returns all memory.</summary>
    public void Dispose(BufferPool pool)
    {
        if (pairs.Span.Allocated)
            pairs.Dispose(pool);
        if (places.Allocated)
            pool.Return(ref places);
        this = default;
    }
}
