using System;
using System.Runtime.CompilerServices;
using BepuUtilities.Diagnostics;

namespace BepuUtilities.Memory;

/// <summary>Hands out small nonnegative integers, and those given back first. The order depends on the calls alone.</summary>
public struct IdPool
{
    int nextIndex;
    int availableIdCount;
    /// <summary>Ids that were given back; the first <see cref="AvailableIdCount"/> are waiting, the last of them is next.</summary>
    public Buffer<int> AvailableIds;

    /// <summary>Creates a pool that has handed out nothing.</summary>
    /// <param name="initialCapacity">Number of returned ids that fit without more memory.</param>
    /// <param name="pool">Where the memory comes from.</param>
    public IdPool(int initialCapacity, IUnmanagedMemoryPool pool)
    {
        ArgumentNullException.ThrowIfNull(pool);
        pool.TakeAtLeast(initialCapacity, out AvailableIds);
        nextIndex = 0;
        availableIdCount = 0;
    }

    /// <summary>Number of returned ids waiting to be taken again.</summary>
    public readonly int AvailableIdCount => availableIdCount;

    /// <summary>Greatest id that may be out; -1 when none ever was. An upper bound: that id itself may have been returned.</summary>
    public readonly int HighestPossiblyClaimedId => nextIndex - 1;

    /// <summary>Number of returned ids that fit without more memory.</summary>
    public readonly int Capacity => AvailableIds.Length;

    /// <summary>Whether the pool has memory, that is, was created and not disposed.</summary>
    public readonly bool Allocated => AvailableIds.Allocated;

    /// <summary>Takes an id that nobody holds.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public int Take()
    {
        Check.That(nextIndex < int.MaxValue);
        return availableIdCount > 0 ? AvailableIds[--availableIdCount] : nextIndex++;
    }

    /// <summary>Gives an id back, with more memory if need be.</summary>
    public void Return(int id, IUnmanagedMemoryPool pool)
    {
        ArgumentOutOfRangeException.ThrowIfNegative(id);
        ArgumentOutOfRangeException.ThrowIfGreaterThanOrEqual(id, nextIndex);
        if (availableIdCount == AvailableIds.Length)
            Resize(Math.Max(AvailableIds.Length * 2, 1), pool);
        AvailableIds[availableIdCount++] = id;
    }

    /// <summary>Gives an id back to a pool that has room for it.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public void ReturnUnsafely(int id)
    {
        Check.That((uint)id < (uint)nextIndex);
        Check.That(availableIdCount < AvailableIds.Length);
        AvailableIds[availableIdCount++] = id;
    }

    /// <summary>Takes all ids back.</summary>
    public void Clear()
    {
        nextIndex = 0;
        availableIdCount = 0;
    }

    /// <summary>Makes room for a number of returned ids.</summary>
    public void EnsureCapacity(int count, IUnmanagedMemoryPool pool)
    {
        ArgumentOutOfRangeException.ThrowIfNegative(count);
        if (AvailableIds.Length < count)
            Resize(count, pool);
    }

    /// <summary>Changes the room for returned ids to about the given number, and never to less than what it holds.</summary>
    public void Resize(int count, IUnmanagedMemoryPool pool)
    {
        ArgumentNullException.ThrowIfNull(pool);
        ArgumentOutOfRangeException.ThrowIfNegative(count);
        count = Math.Max(count, availableIdCount);
        if (!AvailableIds.Allocated || pool.GetCapacityForCount<int>(count) != AvailableIds.Length)
            pool.ResizeToAtLeast(ref AvailableIds, count, availableIdCount);
    }

    /// <summary>Gives all memory back and resets the pool.</summary>
    public void Dispose(IUnmanagedMemoryPool pool)
    {
        ArgumentNullException.ThrowIfNull(pool);
        pool.Return(ref AvailableIds);
        this = default;
    }
}
