using System;
using BepuUtilities.Memory;

namespace BepuUtilities.Collections;

/// <content>Many elements at a time, removal, and search.</content>
public partial struct QuickList<T>
{
    /// <summary>Adds elements at the end. They must not be the list's own.</summary>
    public void AddRange(ReadOnlySpan<T> span, IUnmanagedMemoryPool pool)
    {
        EnsureCapacity(checked(Count + span.Length), pool);
        AddRangeUnsafely(span);
    }

    /// <summary>Adds elements at the end. They must not be the list's own.</summary>
    public void AddRange(Span<T> span, IUnmanagedMemoryPool pool) => AddRange((ReadOnlySpan<T>)span, pool);

    /// <summary>Adds elements at the end. They must not be the list's own.</summary>
    public void AddRange(in Buffer<T> span, IUnmanagedMemoryPool pool) => AddRange((ReadOnlySpan<T>)span, pool);

    /// <summary>Adds a part of a buffer at the end.</summary>
    public void AddRange(in Buffer<T> span, int start, int count, IUnmanagedMemoryPool pool) =>
        AddRange(((ReadOnlySpan<T>)span).Slice(start, count), pool);

    /// <summary>Adds a part of a span at the end.</summary>
    public void AddRange(ReadOnlySpan<T> span, int start, int count, IUnmanagedMemoryPool pool) =>
        AddRange(span.Slice(start, count), pool);

    /// <summary>Adds elements at the end, into room that is there.</summary>
    public void AddRangeUnsafely(ReadOnlySpan<T> span)
    {
        span.CopyTo(Span.AsSpan()[Count..]);
        Count += span.Length;
    }

    /// <summary>Adds a part of a buffer at the end, into room that is there.</summary>
    public void AddRangeUnsafely(in Buffer<T> span, int start, int count) =>
        AddRangeUnsafely(((ReadOnlySpan<T>)span).Slice(start, count));

    /// <summary>Removes an element; those behind it move up and stay in order.</summary>
    public void RemoveAt(int index)
    {
        CheckIndex(index);
        AsSpan()[(index + 1)..].CopyTo(AsSpan()[index..]);
        --Count;
    }

    /// <summary>Removes an element; the last one takes its place.</summary>
    public void FastRemoveAt(int index)
    {
        CheckIndex(index);
        --Count;
        if (index < Count)
            Span[index] = Span[Count];
    }

    /// <summary>Removes the first element that equals a value; those behind it move up.</summary>
    /// <returns>Whether there was one.</returns>
    public bool Remove(in T element) => RemoveFound(IndexOf(in element));

    /// <summary>Removes the first element that a predicate accepts; those behind it move up.</summary>
    /// <returns>Whether there was one.</returns>
    public bool Remove<TPredicate>(ref TPredicate predicate) where TPredicate : IPredicate<T> => RemoveFound(IndexOf(ref predicate));

    /// <summary>Removes the first element that equals a value; the last one takes its place.</summary>
    /// <returns>Whether there was one.</returns>
    public bool FastRemove(in T element) => FastRemoveFound(IndexOf(in element));

    /// <summary>Removes the first element that a predicate accepts; the last one takes its place.</summary>
    /// <returns>Whether there was one.</returns>
    public bool FastRemove<TPredicate>(ref TPredicate predicate) where TPredicate : IPredicate<T> =>
        FastRemoveFound(IndexOf(ref predicate));

    /// <summary>Takes the last element away.</summary>
    /// <exception cref="InvalidOperationException">The list is empty.</exception>
    public void Pop(out T element)
    {
        if (!TryPop(out element))
            throw new InvalidOperationException("The list is empty.");
    }

    /// <summary>Takes the last element away.</summary>
    /// <exception cref="InvalidOperationException">The list is empty.</exception>
    public T Pop()
    {
        Pop(out var element);
        return element;
    }

    /// <summary>Takes the last element away, if there is one.</summary>
    public bool TryPop(out T element)
    {
        if (Count == 0)
        {
            element = default;
            return false;
        }
        element = Span[--Count];
        return true;
    }

    /// <summary>Index of the first element that equals a value, or -1.</summary>
    public readonly int IndexOf(in T element) => ElementSearch.IndexOf(AsSpan(), in element);

    /// <summary>Index of the first element that a predicate accepts, or -1.</summary>
    public readonly int IndexOf<TPredicate>(ref TPredicate predicate) where TPredicate : IPredicate<T> =>
        ElementSearch.IndexOf(AsSpan(), ref predicate);

    /// <summary>Whether an element equals a value.</summary>
    public readonly bool Contains(in T element) => IndexOf(in element) >= 0;

    /// <summary>Whether a predicate accepts an element.</summary>
    public readonly bool Contains<TPredicate>(ref TPredicate predicate) where TPredicate : IPredicate<T> => IndexOf(ref predicate) >= 0;

    bool RemoveFound(int index)
    {
        if (index < 0)
            return false;
        RemoveAt(index);
        return true;
    }

    bool FastRemoveFound(int index)
    {
        if (index < 0)
            return false;
        FastRemoveAt(index);
        return true;
    }

    readonly void CheckIndex(int index)
    {
        ArgumentOutOfRangeException.ThrowIfNegative(index);
        ArgumentOutOfRangeException.ThrowIfGreaterThanOrEqual(index, Count);
    }
}
