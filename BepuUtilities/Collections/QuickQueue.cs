using System;
using System.Runtime.CompilerServices;
using BepuUtilities.Diagnostics;
using BepuUtilities.Memory;

namespace BepuUtilities.Collections;

/// <summary>
/// A growing queue with two ends in a ring of pooled memory. It does not keep its pool: whoever adds names it.
/// Copies share the memory but not the ends, so pass it by reference.
/// </summary>
/// <remarks>Operations called "unsafely" need room that is there already; validating builds check that, release builds do not.</remarks>
public struct QuickQueue<T> where T : unmanaged
{
    /// <summary>Memory of the ring.</summary>
    public Buffer<T> Span;
    /// <summary>Number of elements.</summary>
    public int Count;
    /// <summary>Where in <see cref="Span"/> the first element lies; the others follow, around the end to the start.</summary>
    public int FirstIndex;

    /// <summary>Creates an empty queue.</summary>
    /// <param name="minimumInitialCount">Number of elements that fit without more memory.</param>
    /// <param name="pool">Where the memory comes from.</param>
    public QuickQueue(int minimumInitialCount, IUnmanagedMemoryPool pool)
    {
        ArgumentNullException.ThrowIfNull(pool);
        pool.TakeAtLeast(minimumInitialCount, out Span);
        Count = 0;
        FirstIndex = 0;
    }

    /// <summary>Creates an empty queue over memory taken before.</summary>
    public QuickQueue(in Buffer<T> initialSpan)
    {
        Span = initialSpan;
        Count = 0;
        FirstIndex = 0;
    }

    /// <summary>Where in <see cref="Span"/> the last element lies, when there is one.</summary>
    public readonly int LastIndex => GetBackingIndex(Count - 1);

    /// <summary>Element at a place in [0, Count), counted from the first. Checked in validating builds only.</summary>
    public readonly ref T this[int queueIndex]
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get
        {
            Check.That((uint)queueIndex < (uint)Count);
            return ref Span[GetBackingIndex(queueIndex)];
        }
    }

    /// <summary>Where in <see cref="Span"/> the element at a place in the queue lies.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly int GetBackingIndex(int queueIndex)
    {
        // Unsigned, since the sum of the two may be more than an int holds.
        var index = (uint)FirstIndex + (uint)queueIndex;
        return (int)(index < (uint)Span.Length ? index : index - (uint)Span.Length);
    }

    /// <summary>Adds an element behind the last.</summary>
    public void Enqueue(in T element, IUnmanagedMemoryPool pool)
    {
        // The element may be one of this queue's own, in memory that growing gives back: copy it first.
        var copy = element;
        EnsureCapacity(checked(Count + 1), pool);
        EnqueueUnsafely(in copy);
    }

    /// <summary>Adds an element before the first.</summary>
    public void EnqueueFirst(in T element, IUnmanagedMemoryPool pool)
    {
        var copy = element;
        EnsureCapacity(checked(Count + 1), pool);
        EnqueueFirstUnsafely(in copy);
    }

    /// <summary>Adds an element behind the last, into room that is there.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public void EnqueueUnsafely(in T element)
    {
        Check.That(Count < Span.Length);
        Span[GetBackingIndex(Count)] = element;
        ++Count;
    }

    /// <summary>Adds an element before the first, into room that is there.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public void EnqueueFirstUnsafely(in T element)
    {
        Check.That(Count < Span.Length);
        FirstIndex = (FirstIndex > 0 ? FirstIndex : Span.Length) - 1;
        Span[FirstIndex] = element;
        ++Count;
    }

    /// <summary>Takes the first element away.</summary>
    /// <exception cref="InvalidOperationException">The queue is empty.</exception>
    public T Dequeue() => TryDequeue(out var element) ? element : throw new InvalidOperationException("The queue is empty.");

    /// <summary>Takes the last element away.</summary>
    /// <exception cref="InvalidOperationException">The queue is empty.</exception>
    public T DequeueLast() => TryDequeueLast(out var element) ? element : throw new InvalidOperationException("The queue is empty.");

    /// <summary>Takes the first element away, if there is one.</summary>
    public bool TryDequeue(out T element)
    {
        if (Count == 0)
        {
            element = default;
            return false;
        }
        element = Span[FirstIndex];
        FirstIndex = GetBackingIndex(1);
        --Count;
        return true;
    }

    /// <summary>Takes the last element away, if there is one.</summary>
    public bool TryDequeueLast(out T element)
    {
        if (Count == 0)
        {
            element = default;
            return false;
        }
        element = Span[LastIndex];
        --Count;
        return true;
    }

    /// <summary>Removes the element at a place in [0, Count); the others stay in order. The shorter side moves.</summary>
    public void RemoveAt(int queueIndex)
    {
        ArgumentOutOfRangeException.ThrowIfNegative(queueIndex);
        ArgumentOutOfRangeException.ThrowIfGreaterThanOrEqual(queueIndex, Count);
        if (queueIndex < Count / 2)
        {
            for (int i = queueIndex; i > 0; --i)
                this[i] = this[i - 1];
            FirstIndex = GetBackingIndex(1);
        }
        else
        {
            for (int i = queueIndex + 1; i < Count; ++i)
                this[i - 1] = this[i];
        }
        --Count;
    }

    /// <summary>Removes all elements and keeps the memory.</summary>
    public void Clear()
    {
        Count = 0;
        FirstIndex = 0;
    }

    /// <summary>Makes room for a number of elements in all.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public void EnsureCapacity(int count, IUnmanagedMemoryPool pool)
    {
        if (count > Span.Length)
            Resize(Math.Max(count, (int)Math.Min((long)Span.Length * 2, Array.MaxLength)), pool);
    }

    /// <summary>Changes the room to what the pool gives for a number of elements, which must not be less than the count.</summary>
    public void Resize(int newSize, IUnmanagedMemoryPool pool)
    {
        ArgumentNullException.ThrowIfNull(pool);
        ArgumentOutOfRangeException.ThrowIfLessThan(newSize, Count);
        if (Span.Allocated && pool.GetCapacityForCount<T>(newSize) == Span.Length)
            return;
        pool.TakeAtLeast(newSize, out Buffer<T> resized);
        var untilEnd = Math.Min(Count, Span.Length - FirstIndex);
        Span.CopyTo(FirstIndex, resized, 0, untilEnd);
        Span.CopyTo(0, resized, untilEnd, Count - untilEnd);
        if (Span.Allocated)
            pool.Return(ref Span);
        Span = resized;
        FirstIndex = 0;
    }

    /// <summary>Gives back the room that the elements do not need.</summary>
    public void Compact(IUnmanagedMemoryPool pool) => Resize(Count, pool);

    /// <summary>Gives all memory back and resets the queue.</summary>
    public void Dispose(IUnmanagedMemoryPool pool)
    {
        Span.Dispose(pool);
        Clear();
    }
}
