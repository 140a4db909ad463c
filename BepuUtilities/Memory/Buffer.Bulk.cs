using System;
using BepuUtilities.Collections;

namespace BepuUtilities.Memory;

/// <content>Operations on many elements. They check their ranges in every build: the check is nothing beside the work.</content>
public unsafe partial struct Buffer<T>
{
    /// <summary>Sets all bytes of a range of elements to zero.</summary>
    public readonly void Clear(int start, int count) => Range(start, count).Clear();

    /// <summary>Copies elements to another buffer. The ranges may overlap.</summary>
    public readonly void CopyTo(int sourceStart, in Buffer<T> target, int targetStart, int count) =>
        Range(sourceStart, count).CopyTo(target.Range(targetStart, count));

    /// <summary>Copies elements to a span. The ranges may overlap.</summary>
    public readonly void CopyTo(int sourceStart, Span<T> target, int targetStart, int count) =>
        Range(sourceStart, count).CopyTo(target.Slice(targetStart, count));

    /// <summary>Copies elements from another buffer. The ranges may overlap.</summary>
    public readonly void CopyFrom(in Buffer<T> source, int sourceStart, int targetStart, int count) =>
        source.CopyTo(sourceStart, this, targetStart, count);

    /// <summary>Copies elements from a span. The ranges may overlap.</summary>
    public readonly void CopyFrom(ReadOnlySpan<T> source, int sourceStart, int targetStart, int count) =>
        source.Slice(sourceStart, count).CopyTo(Range(targetStart, count));

    /// <summary>Index of the first element of a range that equals a value, or -1.</summary>
    public readonly int IndexOf(in T element, int start, int count)
    {
        var found = ElementSearch.IndexOf(Range(start, count), in element);
        return found < 0 ? -1 : start + found;
    }

    /// <summary>Index of the first element of a range that a predicate accepts, or -1.</summary>
    public readonly int IndexOf<TPredicate>(ref TPredicate predicate, int start, int count) where TPredicate : IPredicate<T>
    {
        var found = ElementSearch.IndexOf(Range(start, count), ref predicate);
        return found < 0 ? -1 : start + found;
    }

    readonly Span<T> Range(int start, int count) => new Span<T>(Memory, Length).Slice(start, count);
}
