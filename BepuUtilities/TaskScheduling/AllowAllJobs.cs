namespace BepuUtilities.TaskScheduling;

/// <summary>Allows every job.</summary>
public struct AllowAllJobs : IJobFilter
{
    /// <inheritdoc/>
    public readonly bool AllowJob(ulong jobTag) => true;
}
