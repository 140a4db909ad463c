using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>Compares pairs by both of their collidables.</summary>
public struct CollidablePairComparer : IEqualityComparerRef<CollidablePair>
{
    /// <inheritdoc/>
    public readonly bool Equals(ref CollidablePair a, ref CollidablePair b) => a.A.Packed == b.A.Packed && a.B.Packed == b.B.Packed;

    /// <inheritdoc/>
    public readonly int Hash(ref CollidablePair item) => Hash(item.A.Packed, item.B.Packed);

    /// <summary>A number for two, in their order.</summary>
    // Multiplying by odd constants near 2^32 over the golden ratio spreads neighbouring numbers over all bits.
    internal static int Hash(uint a, uint b)
    {
        var mixed = (a * 2654435769u) ^ (b * 2246822519u);
        return (int)(mixed ^ mixed >> 15);
    }
}

/// <summary>The pairs that have contacts or a history, and which of them were seen again this step.</summary>
/// <remarks>
/// Read and marked by many workers at once during the narrow phase; changed by one thread, in an order that depends only on handles,
/// when the narrow phase has ended.
/// </remarks>
unsafe struct PairCache(int initialCapacity, BufferPool pool)
{
    /// <summary>The pairs.</summary>
    public QuickDictionary<CollidablePair, CachedPair, CollidablePairComparer> Pairs = new(initialCapacity, pool);
    Buffer<byte> seen = TakeCleared(initialCapacity, pool);

    static Buffer<byte> TakeCleared(int count, BufferPool pool)
    {
        pool.TakeAtLeast<byte>(Math.Max(1, count), out var buffer);
        buffer.Clear(0, buffer.Length);
        return buffer;
    }

    /// <summary>The pairs whose constraints sleep, with the same records; no memory before there is one.</summary>
    public QuickDictionary<CollidablePair, CachedPair, CollidablePairComparer> Asleep;

    /// <summary>Histories of the pairs that have one; changed in place by the worker that tests the pair.</summary>
    public PairRecords<PairHistory> Histories;

    /// <summary>Histories of pairs of which one shape is made of children, for those that have one.</summary>
    public PairRecords<ParentHistory> Parents;

    /// <summary>Manifolds of the pairs that may have several.</summary>
    public PairRecords<ChildManifold> Manifolds;

    /// <summary>Notes that a pair is still one in this step. Workers mark different pairs, so no two write the same byte.</summary>
    public readonly void MarkSeen(int index) => seen[index] = 1;

    /// <summary>Whether a pair is one in this step.</summary>
    public readonly bool IsSeen(int index) => seen[index] != 0;

    /// <summary>Index of a pair, or -1.</summary>
    /// <param name="pair">The pair.</param>
    /// <param name="guess">What <see cref="QuickDictionary{TKey, TValue, TComparer}.PrefetchElement"/> has said of it.</param>
    // Where the first place that a pair may have is empty, the pair is nowhere.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly int IndexOf(in CollidablePair pair, int guess)
    {
        if (guess < 0)
            return -1;
        ref var key = ref Pairs.Keys[guess];
        return key.A.Packed == pair.A.Packed && key.B.Packed == pair.B.Packed ? guess : Pairs.IndexOf(pair);
    }

    /// <summary>Finds a pair, or adds it without manifolds, as one that has been seen in this step.</summary>
    /// <returns>Index of the pair.</returns>
    public int FindOrAdd(in CollidablePair pair, bool ofChildren, BufferPool pool)
    {
        var index = Pairs.IndexOf(pair);
        return index >= 0 ? index : Add(pair, new CachedPair(ofChildren), pool);
    }

    /// <summary>Makes room for a number of pairs.</summary>
    public void EnsureCapacity(int count, BufferPool pool)
    {
        Pairs.EnsureCapacity(count, pool);
        if (count > seen.Length)
            GrowSeen(count, pool);
    }

    void GrowSeen(int count, BufferPool pool)
    {
        var previous = seen.Length;
        pool.ResizeToAtLeast(ref seen, count, previous);
        seen.Clear(previous, seen.Length - previous);
    }

    int Add(in CollidablePair pair, in CachedPair value, BufferPool pool)
    {
        var index = Pairs.Count;
        Pairs.Add(pair, value, pool);
        if (Pairs.Count > seen.Length)
            GrowSeen(Pairs.Count * 2, pool);
        seen[index] = 1;
        return index;
    }

    /// <summary>Finds the manifold of two children or a patch, or adds it without contacts.</summary>
    public ref ChildManifold FindOrAdd(ref CachedPair pair, ChildIds children, BufferPool pool)
    {
        // The memory may be another one afterwards.
        var index = FindOrAddIndex(ref pair, children, pool);
        return ref Manifolds.Memory[index];
    }

    /// <summary>Finds the manifold of two children or a patch, or adds it without contacts.</summary>
    /// <returns>Its index.</returns>
    public int FindOrAddIndex(ref CachedPair pair, ChildIds children, BufferPool pool)
    {
        var previous = FindPrevious(ref pair, children);
        var next = Link(ref pair, previous);
        if (next != PairRecords<ChildManifold>.None && Manifolds.Memory[next].Children == children)
            return next;
        var added = Manifolds.Take(pool);
        Manifolds.Memory[added] = new() { Manifold = CachedManifold.Empty, Children = children, Next = next };
        Link(ref pair, previous) = added;
        return added;
    }

    // The last manifold before that of two children.
    readonly int FindPrevious(ref CachedPair pair, ChildIds children)
    {
        var previous = PairRecords<ChildManifold>.None;
        while (true)
        {
            var next = Link(ref pair, previous);
            if (next == PairRecords<ChildManifold>.None || Manifolds.Memory[next].Children.Order >= children.Order)
                return previous;
            previous = next;
        }
    }

    // What leads on from a manifold, or from none to the first.
    readonly ref int Link(ref CachedPair pair, int manifold) =>
        ref manifold == PairRecords<ChildManifold>.None ? ref pair.FirstManifold : ref Manifolds.Memory[manifold].Next;

    /// <summary>All manifolds of a pair, in the order of children. None may be added or removed meanwhile.</summary>
    public readonly ManifoldList ManifoldsOf(int index) => ManifoldsOf(ref Pairs.Values[index]);

    /// <summary>All manifolds of a pair that may sleep, in the order of children. None may be added or removed meanwhile.</summary>
    public readonly ManifoldList ManifoldsOf(ref CachedPair pair) => new(ref pair, Manifolds.Memory);

    /// <summary>Removes a manifold, and with the last one the pair; the last pair takes its index.</summary>
    /// <param name="index">Index of the pair.</param>
    /// <param name="children">Children of the manifold; none for that of a pair of convex shapes.</param>
    /// <param name="pool">Pool of the cache.</param>
    public void Remove(int index, ChildIds children, BufferPool pool)
    {
        ref var pair = ref Pairs.Values[index];
        if (pair.IsOfChildren)
        {
            ref var link = ref Link(ref pair, FindPrevious(ref pair, children));
            var removed = link;
            link = Manifolds.Memory[removed].Next;
            Return(removed, pool);
        }
        if (pair.FirstManifold == PairRecords<ChildManifold>.None)
            Remove(index, pool);
    }

    /// <summary>Removes a pair with its manifolds; the last one takes its index.</summary>
    public void Remove(int index, BufferPool pool)
    {
        Empty(ref Pairs.Values[index], ofChildren: false, pool);
        Drop(index);
    }

    void Drop(int index)
    {
        var last = Pairs.Count - 1;
        seen[index] = seen[last];
        seen[last] = 0;
        Pairs.FastRemove(Pairs.Keys[index]);
    }

    /// <summary>Whether a pair sleeps.</summary>
    public readonly bool IsAsleep(in CollidablePair pair) => Asleep.Count > 0 && Asleep.IndexOf(pair) >= 0;

    /// <summary>Moves a pair among those that sleep, unless it is there.</summary>
    public void PutToSleep(in CollidablePair pair, BufferPool pool)
    {
        var index = Pairs.IndexOf(pair);
        if (index < 0)
            return;
        if (!Asleep.Keys.Allocated)
            Asleep = new(64, pool);
        Asleep.Add(pair, Pairs.Values[index], pool);
        Drop(index);
    }

    /// <summary>Moves a pair that sleeps among those of the present step, unless it is there.</summary>
    public void Awaken(in CollidablePair pair, BufferPool pool)
    {
        if (!Asleep.TryGetValue(pair, out var value))
            return;
        Add(pair, value, pool);
        Asleep.FastRemove(pair);
    }

    /// <summary>Forgets the manifolds of a pair, which have no constraints any more.</summary>
    public void Empty(ref CachedPair pair, bool ofChildren, BufferPool pool)
    {
        if (pair.Single.History >= 0)
        {
            if (pair.IsOfChildren)
                Parents.Return(pair.Single.History, pool);
            else
                Histories.Return(pair.Single.History, pool);
        }
        while (pair.FirstManifold != PairRecords<ChildManifold>.None)
        {
            var removed = pair.FirstManifold;
            pair.FirstManifold = Manifolds.Memory[removed].Next;
            Return(removed, pool);
        }
        pair = new CachedPair(ofChildren);
    }

    void Return(int manifold, BufferPool pool)
    {
        var history = Manifolds.Memory[manifold].Manifold.History;
        if (history >= 0)
            Histories.Return(history, pool);
        Manifolds.Return(manifold, pool);
    }

    /// <summary>The last index below a limit of a pair that was not seen in this step; -1 where there is none.</summary>
    public readonly int FindUnseen(int limit)
    {
        int i = limit;
        for (; i % Vector<byte>.Count != 0; --i)
        {
            if (seen[i - 1] == 0)
                return i - 1;
        }
        for (; i > 0; i -= Vector<byte>.Count)
        {
            if (!Vector.EqualsAny(*(Vector<byte>*)(seen.Memory + i - Vector<byte>.Count), Vector<byte>.Zero))
                continue;
            for (int j = i; ; --j)
            {
                if (seen[j - 1] == 0)
                    return j - 1;
            }
        }
        return -1;
    }

    /// <summary>Forgets which pairs were seen, for the next step.</summary>
    public readonly void BeginStep() => seen.Clear(0, Pairs.Count);

    public void Clear()
    {
        seen.Clear(0, Pairs.Count);
        Pairs.Clear();
        if (Asleep.Keys.Allocated)
            Asleep.Clear();
        Histories.Clear();
        Parents.Clear();
        Manifolds.Clear();
    }

    public void CopyState(StateCopy copy)
    {
        copy.Dictionary(ref Pairs);
        copy.Rows(ref seen, Pairs.Count, absent: (byte)0);
        copy.Dictionary(ref Asleep);
        Histories.CopyState(copy);
        Parents.CopyState(copy);
        Manifolds.CopyState(copy);
    }

    public void Dispose(BufferPool pool)
    {
        Pairs.Dispose(pool);
        if (Asleep.Keys.Allocated)
            Asleep.Dispose(pool);
        pool.Return(ref seen);
        Histories.Dispose(pool);
        Parents.Dispose(pool);
        Manifolds.Dispose(pool);
    }
}

/// <summary>The manifolds of one pair, one after the other.</summary>
unsafe ref struct ManifoldList(ref CachedPair pair, ChildManifold* manifolds)
{
    const int Before = -1;

    readonly ref CachedPair pair = ref pair;
    int index = Before;

    /// <summary>For the loop over all.</summary>
    public readonly ManifoldList GetEnumerator() => this;

    /// <summary>A manifold, to be changed.</summary>
    public readonly ref CachedManifold Current => ref pair.IsOfChildren ? ref manifolds[index].Manifold : ref pair.Single;

    /// <summary>The children that it is of.</summary>
    public readonly ChildIds Children => pair.IsOfChildren ? manifolds[index].Children : ChildIds.None;

    /// <summary>Goes on to the next manifold, if there is one.</summary>
    public bool MoveNext()
    {
        if (index != Before)
            index = pair.IsOfChildren ? manifolds[index].Next : PairRecords<ChildManifold>.None;
        else
            index = pair.IsOfChildren ? pair.FirstManifold : 1;
        return index != PairRecords<ChildManifold>.None;
    }
}
