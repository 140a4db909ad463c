using System.Runtime.CompilerServices;

namespace BepuUtilities.Collections;

/// <summary>Identity of objects. Hashes differ from run to run: use it only where no result depends on them.</summary>
public struct ReferenceComparer<T> : IEqualityComparerRef<T> where T : class
{
    /// <inheritdoc/>
    public readonly int Hash(ref T item) => RuntimeHelpers.GetHashCode(item);

    /// <inheritdoc/>
    public readonly bool Equals(ref T a, ref T b) => ReferenceEquals(a, b);
}
