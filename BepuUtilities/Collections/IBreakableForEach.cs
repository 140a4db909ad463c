namespace BepuUtilities;

/// <summary>Body of a loop over values that can end the loop.</summary>
public interface IBreakableForEach<T>
{
    /// <summary>Called for each value.</summary>
    /// <returns>False to stop the loop.</returns>
    bool LoopBody(T i);
}
