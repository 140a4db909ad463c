using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>What is remembered of a pair that has contacts, or a history.</summary>
struct CachedPair
{
    /// <summary>Contact constraint of the pair; means nothing where there is none.</summary>
    public ConstraintHandle Constraint;
    /// <summary>Type id of that constraint, which tells the number of its contacts; <see cref="NoConstraint"/> where there is none.</summary>
    public int ConstraintTypeId;
    /// <summary>Feature ids of its contacts, by which impulses find their contacts from step to step.</summary>
    public FeatureIds Features;
    /// <summary>Index of the pair's history; negative for shapes whose test keeps none.</summary>
    public int History;
    // 32 bytes, so that none lies across two cache lines.
    readonly int padding;

    /// <summary>Type id of a pair without contacts.</summary>
    public const int NoConstraint = -1;

    /// <summary>Whether the pair has contacts.</summary>
    public readonly bool HasConstraint => ConstraintTypeId >= 0;
}

/// <summary>Feature ids of up to four contacts.</summary>
[InlineArray(4)]
struct FeatureIds
{
    int first;
}

/// <summary>Compares pairs by both of their collidables.</summary>
public struct CollidablePairComparer : IEqualityComparerRef<CollidablePair>
{
    /// <inheritdoc/>
    public readonly bool Equals(ref CollidablePair a, ref CollidablePair b) => a.A.Packed == b.A.Packed && a.B.Packed == b.B.Packed;

    /// <inheritdoc/>
    // Multiplying by odd constants near 2^32 over the golden ratio spreads neighbouring handles over the table.
    public readonly int Hash(ref CollidablePair item)
    {
        var mixed = (item.A.Packed * 2654435769u) ^ (item.B.Packed * 2246822519u);
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

    /// <summary>Histories of the pairs that have one; changed in place by the worker that tests the pair.</summary>
    public PairHistories Histories;

    /// <summary>Notes that a pair is still one in this step. Workers mark different pairs, so no two write the same byte.</summary>
    public readonly void MarkSeen(int index) => seen[index] = 1;

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

    /// <summary>Adds a pair without constraint that has been seen in this step.</summary>
    public void Add(CollidablePair pair, bool keepsHistory, BufferPool pool)
    {
        CachedPair cached = default;
        cached.ConstraintTypeId = CachedPair.NoConstraint;
        cached.History = keepsHistory ? Histories.Take(pool) : PairInput.NoHistory;
        Pairs.Add(pair, cached, pool);
        if (Pairs.Count > seen.Length)
        {
            var previous = seen.Length;
            pool.ResizeToAtLeast(ref seen, Pairs.Count * 2, previous);
            seen.Clear(previous, seen.Length - previous);
        }
        seen[Pairs.Count - 1] = 1;
    }

    /// <summary>Removes a pair; the last one takes its index.</summary>
    public void RemoveAt(int index, BufferPool pool)
    {
        if (Pairs.Values[index].History >= 0)
            Histories.Return(Pairs.Values[index].History, pool);
        var last = Pairs.Count - 1;
        seen[index] = seen[last];
        seen[last] = 0;
        Pairs.FastRemove(Pairs.Keys[index]);
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
        Histories.Clear();
    }

    public void Dispose(BufferPool pool)
    {
        Pairs.Dispose(pool);
        pool.Return(ref seen);
        Histories.Dispose(pool);
    }
}
