namespace BepuUtilities.Collections;

/// <summary>A condition on elements, as a struct so that a search inlines it.</summary>
public interface IPredicate<T>
{
    /// <summary>Whether an element fulfils the condition.</summary>
    bool Matches(ref T item);
}
