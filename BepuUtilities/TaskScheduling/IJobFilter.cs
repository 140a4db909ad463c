namespace BepuUtilities.TaskScheduling;

/// <summary>Chooses, by the tag under which they were pushed, the jobs of a <see cref="TaskStack"/> that a worker takes tasks from.</summary>
public interface IJobFilter
{
    /// <summary>Whether tasks of a job may be taken. Called on the worker that looks for a task.</summary>
    /// <param name="jobTag">Tag under which the job was pushed.</param>
    bool AllowJob(ulong jobTag);
}
