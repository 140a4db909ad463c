using System;
using System.Runtime.CompilerServices;
using BepuUtilities.Diagnostics;
using BepuUtilities.Memory;

namespace BepuUtilities.Collections;

/// <summary>
/// A growing list over pooled memory. It does not keep its pool: whoever adds names it. Copies share the memory but not the count,
/// so pass it by reference. References to elements are good until the list grows.
/// </summary>
/// <remarks>Operations called "unsafely" need room that is there already; validating builds check that, release builds do not.</remarks>
public partial struct QuickList<T> where T : unmanaged
{
    /// <summary>Memory of the list; elements [0, <see cref="Count"/>) are in use.</summary>
    public Buffer<T> Span;
    /// <summary>Number of elements.</summary>
    public int Count;

    /// <summary>Creates an empty list.</summary>
    /// <param name="minimumInitialCount">Number of elements that fit without more memory.</param>
    /// <param name="pool">Where the memory comes from.</param>
    public QuickList(int minimumInitialCount, IUnmanagedMemoryPool pool)
    {
        ArgumentNullException.ThrowIfNull(pool);
        PoolCalls.TakeAtLeast(pool, minimumInitialCount, out Span);
        Count = 0;
    }

    /// <summary>Creates an empty list over memory taken before.</summary>
    public QuickList(in Buffer<T> initialSpan)
    {
        Span = initialSpan;
        Count = 0;
    }

    /// <summary>Element at an index in [0, Count). Checked in validating builds only.</summary>
    public readonly ref T this[int index]
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get
        {
            Check.That((uint)index < (uint)Count);
            return ref Span[index];
        }
    }

    /// <summary>Element at an index in [0, Count). Checked in validating builds only.</summary>
    public readonly ref T this[uint index]
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get
        {
            Check.That(index < (uint)Count);
            return ref Span[index];
        }
    }

    /// <summary>Makes room for a number of elements in all.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public void EnsureCapacity(int count, IUnmanagedMemoryPool pool)
    {
        if (count > Span.Length)
            Grow(count, pool);
    }

    /// <summary>Changes the room to what the pool gives for a number of elements, which must not be less than the count.</summary>
    public void Resize(int newSize, IUnmanagedMemoryPool pool)
    {
        ArgumentNullException.ThrowIfNull(pool);
        ArgumentOutOfRangeException.ThrowIfLessThan(newSize, Count);
        if (!Span.Allocated || pool.GetCapacityForCount<T>(newSize) != Span.Length)
            pool.ResizeToAtLeast(ref Span, newSize, Count);
    }

    /// <summary>Gives back the room that the elements do not need.</summary>
    public void Compact(IUnmanagedMemoryPool pool) => Resize(Count, pool);

    /// <summary>Gives all memory back and resets the list.</summary>
    public void Dispose(IUnmanagedMemoryPool pool)
    {
        Span.Dispose(pool);
        Count = 0;
    }

    /// <summary>Removes all elements and keeps the memory.</summary>
    public void Clear() => Count = 0;

    /// <summary>Adds an element at the end.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public void Add(in T element, IUnmanagedMemoryPool pool)
    {
        if (Count < Span.Length)
            Span[Count++] = element;
        else
            GrowAndAdd(in element, pool);
    }

    /// <summary>Adds an element at the end, into room that is there.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public void AddUnsafely(in T element)
    {
        Check.That(Count < Span.Length);
        Span[Count++] = element;
    }

    /// <summary>Adds an element at the end whose contents are undefined.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public ref T Allocate(IUnmanagedMemoryPool pool)
    {
        EnsureCapacity(Count + 1, pool);
        return ref Span[Count++];
    }

    /// <summary>Adds elements at the end whose contents are undefined.</summary>
    /// <returns>The first of them, or what lies behind the last element when there are none.</returns>
    public unsafe ref T Allocate(int count, IUnmanagedMemoryPool pool)
    {
        ArgumentOutOfRangeException.ThrowIfNegative(count);
        EnsureCapacity(checked(Count + count), pool);
        return ref AllocateUnsafely(count);
    }

    /// <summary>Adds an element at the end whose contents are undefined, into room that is there.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public ref T AllocateUnsafely()
    {
        Check.That(Count < Span.Length);
        return ref Span[Count++];
    }

    /// <summary>Adds elements at the end whose contents are undefined, into room that is there.</summary>
    /// <returns>The first of them, or what lies behind the last element when there are none.</returns>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public unsafe ref T AllocateUnsafely(int count)
    {
        Check.That(count >= 0 && count <= Span.Length - Count);
        var start = Count;
        Count = start + count;
        return ref Span.Memory[start];
    }

    /// <summary>The elements as a span.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly unsafe Span<T> AsSpan() => new(Span.Memory, Count);

    /// <summary>The elements as a span.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static implicit operator Span<T>(in QuickList<T> list) => list.AsSpan();

    /// <summary>The elements as a read-only span.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static implicit operator ReadOnlySpan<T>(in QuickList<T> list) => list.AsSpan();

    /// <summary>The elements as a buffer, without the spare room.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static implicit operator Buffer<T>(in QuickList<T> list) => list.Span.Slice(list.Count);

    /// <summary>Goes through the elements in order, as they were counted when the loop began.</summary>
    public readonly Span<T>.Enumerator GetEnumerator() => AsSpan().GetEnumerator();

    [MethodImpl(MethodImplOptions.NoInlining)]
    void Grow(int count, IUnmanagedMemoryPool pool)
    {
        ArgumentNullException.ThrowIfNull(pool);
        // Doubling keeps the cost of an addition constant on average; the last doubling stops at what an int can count.
        var doubled = (int)Math.Min((long)Span.Length * 2, Array.MaxLength);
        pool.ResizeToAtLeast(ref Span, Math.Max(count, doubled), Count);
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    void GrowAndAdd(in T element, IUnmanagedMemoryPool pool)
    {
        // The element may be one of this list's own, in memory that growing gives back: copy it first.
        var copy = element;
        Grow(checked(Count + 1), pool);
        Span[Count++] = copy;
    }
}
