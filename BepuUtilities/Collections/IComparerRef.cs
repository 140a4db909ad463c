namespace BepuUtilities.Collections;

/// <summary>An order of elements, as a struct so that a sort inlines it.</summary>
public interface IComparerRef<T>
{
    /// <summary>Negative when a comes before b, positive when after, zero when neither.</summary>
    int Compare(ref T a, ref T b);
}
