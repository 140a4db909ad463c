using System;

namespace BepuUtilities.TaskScheduling;

/// <summary>Allows the jobs that a function allows.</summary>
public unsafe struct FunctionPointerJobFilter : IJobFilter
{
    /// <summary>Tells whether a tag is allowed. Called on the worker that looks for a task.</summary>
    public delegate*<ulong, bool> Filter;

    /// <summary>Creates a filter from a function.</summary>
    public FunctionPointerJobFilter(delegate*<ulong, bool> filter)
    {
        if (filter == null)
            throw new ArgumentNullException(nameof(filter));
        Filter = filter;
    }

    /// <inheritdoc/>
    public readonly bool AllowJob(ulong jobTag) => Filter(jobTag);
}
