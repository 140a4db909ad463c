namespace BepuUtilities;

/// <summary>Body of a loop over elements in place that can end the loop.</summary>
public interface IBreakableForEachRef<T>
{
    /// <summary>Called for each element.</summary>
    /// <returns>False to stop the loop.</returns>
    bool LoopBody(ref T i);
}
