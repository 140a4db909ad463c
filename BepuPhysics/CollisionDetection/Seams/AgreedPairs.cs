using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using System.Threading;
using BepuPhysics.Collidables;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>What the pairs of bodies that lie across statics have agreed on, from step to step.</summary>
/// <remarks>
/// While pairs are tested, each notes whether it has found the same again. The pairs of bodies of which all have are the first ones from then on, and where
/// they are among them is where they are among the pairs that agree in this step; behind them is room for those of the others. So of a body at rest nothing is
/// copied, sorted or looked for.
/// </remarks>
struct AgreedPairs
{
    // What is known by the slot of a body.
    struct Entry
    {
        // Its index. Of a body that is not remembered it says nothing: who is there tells.
        public int Index;
        // For how long its next agreement holds; zero for as long as any first one.
        public int Lifetime;
    }

    QuickList<AgreedPair> pairs;
    QuickList<AgreedBody> bodies;
    Buffer<Entry> entries;

    // Pairs that there is room for without a need; and how many times those that there are.
    const int LeastRoom = 64, MostRoom = 4;
    const int Nowhere = -1;

    /// <summary>The pairs: between two agreements those that are remembered, and meanwhile all that agree.</summary>
    public readonly Span<AgreedPair> Pairs => pairs.AsSpan();

    /// <summary>The bodies that are remembered; in the order of their pairs.</summary>
    public readonly Span<AgreedBody> Bodies => bodies.AsSpan();

    /// <summary>Whether a body is remembered.</summary>
    public readonly bool Has(CollidableReference body) => IndexOf(body) != Nowhere;

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    readonly int IndexOf(CollidableReference body)
    {
        if (body.Slot >= entries.Length)
            return Nowhere;
        var index = entries[body.Slot].Index;
        return index < bodies.Count && bodies[index].Body.Packed == body.Packed ? index : Nowhere;
    }

    /// <summary>Asks the processor to load what is remembered of a body. Changes no result.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly unsafe void Prefetch(CollidableReference body)
    {
        var index = IndexOf(body);
        if (index != Nowhere)
            BepuUtilities.Memory.Prefetch.Read(pairs.Span.Memory + bodies[index].First);
    }

    /// <summary>Takes down what a pair has found that waits for the others of its body, if those are remembered. By any worker.</summary>
    /// <param name="pair">The pair.</param>
    /// <param name="manifold">What it has found: nothing for shapes of children that are near.</param>
    /// <param name="orientation">Orientation of the body.</param>
    /// <param name="worker">The worker that it waits with.</param>
    /// <param name="index">Its place among those that wait there.</param>
    public readonly void Note(in CollidablePair pair, in ConvexContactManifold manifold, in Quaternion orientation, int worker, int index)
    {
        var place = IndexOf(pair.A);
        if (place == Nowhere)
            return;
        ref var body = ref bodies[place];
        for (int i = body.First; i < body.First + body.Count; ++i)
        {
            ref var agreed = ref pairs[i];
            if (agreed.B.Packed != pair.B.Packed)
                continue;
            if (!agreed.Holds(manifold, orientation, body))
                break;
            agreed.Worker = worker;
            agreed.Index = index;
            Interlocked.Increment(ref body.HeldCount);
            return;
        }
        body.HasChanged = true;
    }

    /// <summary>Takes down that a pair which waits has found what is never remembered.</summary>
    public readonly void NoteChange(CollidableReference body)
    {
        var index = IndexOf(body);
        if (index != Nowhere)
            bodies[index].HasChanged = true;
    }

    /// <summary>Forgets all bodies of which a pair has not found the same again, and those that are to agree anew.</summary>
    public void KeepHeld()
    {
        var (bodyCount, pairCount) = (0, 0);
        for (int i = 0; i < bodies.Count; ++i)
        {
            var body = bodies[i];
            ref var entry = ref entries[body.Body.Slot];
            var holds = body.Holds;
            if (!holds || body.Remaining == 0)
            {
                entry.Lifetime = holds ? body.NextLifetime : 0;
                continue;
            }
            if (body.First != pairCount)
                pairs.AsSpan().Slice(body.First, body.Count).CopyTo(pairs.AsSpan()[pairCount..]);
            body.First = pairCount;
            body.HeldCount = 0;
            --body.Remaining;
            bodies[bodyCount] = body;
            entry.Index = bodyCount++;
            pairCount += body.Count;
        }
        bodies.Count = bodyCount;
        pairs.Count = pairCount;
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

    /// <summary>Remembers a body whose pairs have agreed anew, with those of them that are to be.</summary>
    /// <param name="body">The body.</param>
    /// <param name="first">Place of its first pair.</param>
    /// <param name="end">Place after its last pair.</param>
    /// <param name="count">Number of all pairs that are remembered so far.</param>
    /// <param name="pool">Source of memory.</param>
    public void Add(AgreedBody body, int first, int end, ref int count, BufferPool pool)
    {
        body.First = count;
        for (int i = first; i < end; ++i)
        {
            if (pairs[i].IsRemembered)
                pairs[count++] = pairs[i];
        }
        body.Count = count - body.First;
        ref var entry = ref entries[body.Body.Slot];
        body.Lifetime = (short)Math.Max(entry.Lifetime, AgreedBody.FirstLifetime);
        // Bodies that came to rest together would all agree anew together, again and again.
        body.Remaining = (short)(body.Lifetime - body.Body.Slot % (body.Lifetime / 2));
        entry.Index = bodies.Count;
        if (!bodies.Span.Allocated)
            bodies = new(LeastRoom, pool);
        bodies.Add(body, pool);
    }

    /// <summary>Makes room for bodies, by the number of slots that they have.</summary>
    public void EnsureSlots(int count, BufferPool pool)
    {
        if (count <= entries.Length)
            return;
        var previous = entries.Length;
        pool.ResizeToAtLeast(ref entries, count, previous);
        entries.Clear(previous, entries.Length - previous);
    }

    /// <summary>Ends the agreement: what is not remembered is gone.</summary>
    /// <param name="count">Number of pairs that are remembered.</param>
    /// <param name="pool">Source of memory.</param>
    public void End(int count, BufferPool pool)
    {
        var total = pairs.Count;
        pairs.Count = count;
        // In its first step each pair waits; of what lies on one ground, no later one.
        if (count == 0)
            pairs.DisposeIfTaken(pool);
        else if (pairs.Span.Length > Math.Max(LeastRoom, MostRoom * total))
            pairs.Resize(count, pool);
    }

    /// <summary>Forgets everything.</summary>
    public void Clear()
    {
        pairs.Count = bodies.Count = 0;
        if (entries.Allocated)
            entries.Clear(0, entries.Length);
    }

    public void CopyState(StateCopy copy)
    {
        copy.List(ref pairs);
        copy.List(ref bodies);
        copy.Rows(ref entries, entries.Length, absent: default);
    }

    /// <summary>Returns all memory.</summary>
    public void Dispose(BufferPool pool)
    {
        pairs.DisposeIfTaken(pool);
        bodies.DisposeIfTaken(pool);
        pool.ReturnIfTaken(ref entries);
        this = default;
    }
}
