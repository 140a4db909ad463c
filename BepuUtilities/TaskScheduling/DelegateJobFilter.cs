using System;

namespace BepuUtilities.TaskScheduling;

/// <summary>Allows the jobs that a delegate allows.</summary>
public struct DelegateJobFilter : IJobFilter
{
    /// <summary>Tells whether a tag is allowed. Called on the worker that looks for a task.</summary>
    public Func<ulong, bool> Filter;

    /// <summary>Creates a filter from a delegate.</summary>
    public DelegateJobFilter(Func<ulong, bool> filter)
    {
        ArgumentNullException.ThrowIfNull(filter);
        Filter = filter;
    }

    /// <inheritdoc/>
    public readonly bool AllowJob(ulong jobTag) => Filter(jobTag);
}
