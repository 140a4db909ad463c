using System;
using System.Collections.Generic;

namespace BepuUtilities.Collections;

/// <summary>The linear searches that buffers, lists and queues share.</summary>
static class ElementSearch
{
    /// <summary>Index of the first element that equals a value, or -1.</summary>
    public static int IndexOf<T>(ReadOnlySpan<T> span, in T element) where T : unmanaged
    {
        for (int i = 0; i < span.Length; ++i)
        {
            if (EqualityComparer<T>.Default.Equals(span[i], element))
                return i;
        }
        return -1;
    }

    /// <summary>Index of the first element that a predicate accepts, or -1.</summary>
    public static int IndexOf<T, TPredicate>(Span<T> span, ref TPredicate predicate) where T : unmanaged where TPredicate : IPredicate<T>
    {
        for (int i = 0; i < span.Length; ++i)
        {
            if (predicate.Matches(ref span[i]))
                return i;
        }
        return -1;
    }
}
