namespace BepuUtilities.TaskScheduling;

/// <summary>Allows the jobs with one tag.</summary>
public struct EqualTagFilter : IJobFilter
{
    /// <summary>Tag that is allowed.</summary>
    public ulong RequiredTag;

    /// <summary>Creates a filter from the tag that it allows.</summary>
    public EqualTagFilter(ulong requiredTag) => RequiredTag = requiredTag;

    /// <inheritdoc/>
    public readonly bool AllowJob(ulong jobTag) => jobTag == RequiredTag;
}
