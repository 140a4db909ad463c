using System;
using System.Runtime.CompilerServices;
using BepuUtilities.Diagnostics;
using BepuUtilities.Memory;

namespace BepuUtilities.Collections;

/// <summary>A set of small nonnegative integers, one bit each.</summary>
public struct IndexSet
{
    const int Shift = 6;

    /// <summary>The bits; index i is bit i modulo 64 of element i / 64.</summary>
    public Buffer<ulong> Flags;

    /// <summary>Creates an empty set.</summary>
    /// <param name="pool">Where the memory comes from.</param>
    /// <param name="initialCapacity">Number of indices, from zero on, that fit without more memory.</param>
    public IndexSet(IUnmanagedMemoryPool pool, int initialCapacity)
    {
        ArgumentNullException.ThrowIfNull(pool);
        ArgumentOutOfRangeException.ThrowIfNegative(initialCapacity);
        Flags = default;
        Resize(initialCapacity, pool);
    }

    /// <summary>Number of indices, from zero on, that fit without more memory.</summary>
    public readonly int Capacity => (int)Math.Min((long)Flags.Length << Shift, int.MaxValue);

    /// <summary>Whether an index is in the set. Indices outside the capacity are not.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly bool Contains(int index)
    {
        var element = index >> Shift;
        return (uint)element < (uint)Flags.Length && (Flags[element] & (1UL << index)) != 0;
    }

    /// <summary>Whether none of the indices is in the set.</summary>
    public readonly bool CanFit(ReadOnlySpan<int> indices)
    {
        foreach (var index in indices)
        {
            if (Contains(index))
                return false;
        }
        return true;
    }

    /// <inheritdoc cref="CanFit(ReadOnlySpan{int})"/>
    public readonly bool CanFit(Span<int> indices) => CanFit((ReadOnlySpan<int>)indices);

    /// <summary>Puts an index into the set, whether it is there or not.</summary>
    public void Set(int index, IUnmanagedMemoryPool pool)
    {
        ArgumentOutOfRangeException.ThrowIfNegative(index);
        if (index >> Shift >= Flags.Length)
            Grow(index, pool);
        SetUnsafely(index);
    }

    /// <summary>Puts an index into the set, whether it is there or not, into room that is there.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly void SetUnsafely(int index) => Flags[index >> Shift] |= 1UL << index;

    /// <summary>Takes an index out of the set, whether it is there or not.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly void Unset(int index)
    {
        if (Contains(index))
            Flags[index >> Shift] &= ~(1UL << index);
    }

    /// <summary>Adds an index that is not in the set.</summary>
    public void Add(int index, IUnmanagedMemoryPool pool)
    {
        Check.That(!Contains(index));
        Set(index, pool);
    }

    /// <summary>Adds an index that is not in the set, into room that is there.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly void AddUnsafely(int index)
    {
        Check.That(!Contains(index));
        SetUnsafely(index);
    }

    /// <summary>Removes an index that is in the set.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly void Remove(int index)
    {
        Check.That(Contains(index));
        Unset(index);
    }

    /// <summary>Removes all indices and keeps the memory.</summary>
    public readonly void Clear() => Flags.Clear(0, Flags.Length);

    /// <summary>Makes room for the indices below a number.</summary>
    public void EnsureCapacity(int indexCapacity, IUnmanagedMemoryPool pool)
    {
        ArgumentOutOfRangeException.ThrowIfNegative(indexCapacity);
        if (indexCapacity > (long)Flags.Length << Shift)
            Resize(indexCapacity, pool);
    }

    /// <summary>Changes the room to what the pool gives for the indices below a number; indices that no longer fit are removed.</summary>
    public void Resize(int indexCapacity, IUnmanagedMemoryPool pool)
    {
        ArgumentNullException.ThrowIfNull(pool);
        ArgumentOutOfRangeException.ThrowIfNegative(indexCapacity);
        var count = (int)(((long)indexCapacity + 63) >> Shift);
        var kept = Math.Min(Flags.Length, pool.GetCapacityForCount<ulong>(count));
        if (Flags.Allocated && kept == Flags.Length && pool.GetCapacityForCount<ulong>(count) == kept)
            return;
        pool.TakeAtLeast(count, out Buffer<ulong> resized);
        Flags.CopyTo(0, resized, 0, kept);
        resized.Clear(kept, resized.Length - kept);
        if (Flags.Allocated)
            pool.Return(ref Flags);
        Flags = resized;
    }

    /// <summary>Gives all memory back and resets the set.</summary>
    public void Dispose(IUnmanagedMemoryPool pool) => Flags.Dispose(pool);

    [MethodImpl(MethodImplOptions.NoInlining)]
    void Grow(int index, IUnmanagedMemoryPool pool) =>
        Resize((int)Math.Min(Math.Max((long)index + 1, (long)Flags.Length << (Shift + 1)), int.MaxValue), pool);
}
