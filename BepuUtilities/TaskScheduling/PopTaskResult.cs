namespace BepuUtilities.TaskScheduling;

/// <summary>What came of an attempt to take a task from a <see cref="TaskStack"/>.</summary>
public enum PopTaskResult
{
    /// <summary>A task was taken.</summary>
    Success,
    /// <summary>There was no task that the filter allows; there may be one later.</summary>
    Empty,
    /// <summary>The stack gives out no more tasks: a stop was requested or a task threw an exception.</summary>
    Stop
}
