namespace BepuUtilities;

/// <summary>Body of a loop over values.</summary>
public interface IForEach<T>
{
    /// <summary>Called for each value.</summary>
    void LoopBody(T i);
}
