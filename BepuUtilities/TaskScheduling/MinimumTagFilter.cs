namespace BepuUtilities.TaskScheduling;

/// <summary>Allows the jobs whose tag is no less than a value.</summary>
public struct MinimumTagFilter : IJobFilter
{
    /// <summary>Least tag that is allowed.</summary>
    public ulong MinimumTagValue;

    /// <summary>Creates a filter from the least tag that it allows.</summary>
    public MinimumTagFilter(ulong minimumTagValue) => MinimumTagValue = minimumTagValue;

    /// <inheritdoc/>
    public readonly bool AllowJob(ulong jobTag) => jobTag >= MinimumTagValue;
}
