namespace BepuUtilities;

/// <summary>Body of a loop over elements in place.</summary>
public interface IForEachRef<T>
{
    /// <summary>Called for each element.</summary>
    void LoopBody(ref T i);
}
