namespace BepuUtilities.TaskScheduling;

/// <summary>
/// A dispatcher that watches what it is given to do: staged work runs on the caller, and each stage is reported. So one can see, on any machine, how much
/// of a work could be shared among how many threads.
/// </summary>
public interface IStagedWorkObserver : IThreadDispatcher
{
    /// <summary>A stage of a work has ended.</summary>
    /// <param name="blockCount">Independent blocks that it had, at least one.</param>
    /// <param name="ticks">Time that they took together, in ticks of <see cref="System.Diagnostics.Stopwatch"/>.</param>
    /// <param name="longestBlockTicks">Time of the one that took longest.</param>
    void StageEnded(int blockCount, long ticks, long longestBlockTicks);
}
