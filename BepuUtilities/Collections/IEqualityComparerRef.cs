namespace BepuUtilities.Collections;

/// <summary>Equality and hash of elements, as a struct so that a table inlines it.</summary>
public interface IEqualityComparerRef<T>
{
    /// <summary>Hash of an element: the same for equal ones. The tables mix its bits themselves.</summary>
    int Hash(ref T item);

    /// <summary>Whether two elements are equal.</summary>
    bool Equals(ref T a, ref T b);
}
