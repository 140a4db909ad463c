using System;
using System.Collections.Generic;

namespace BepuUtilities.Collections;

/// <summary>Lets the framework's comparers serve the tables of this library. Slower than a comparer of one's own: each call is virtual.</summary>
public struct WrapperEqualityComparer<T> : IEqualityComparerRef<T>
{
    /// <summary>The comparer that does the work.</summary>
    public IEqualityComparer<T> Comparer;

    /// <summary>Wraps a comparer.</summary>
    public WrapperEqualityComparer(IEqualityComparer<T> comparer)
    {
        ArgumentNullException.ThrowIfNull(comparer);
        Comparer = comparer;
    }

    /// <summary>Wraps the type's default comparer.</summary>
    public static void CreateDefault(out WrapperEqualityComparer<T> comparer) => comparer = new(EqualityComparer<T>.Default);

    /// <inheritdoc/>
    public readonly int Hash(ref T item) => item is null ? 0 : Comparer.GetHashCode(item);

    /// <inheritdoc/>
    public readonly bool Equals(ref T a, ref T b) => Comparer.Equals(a, b);
}
