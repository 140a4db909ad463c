using System;
using System.Runtime.InteropServices;
using System.Threading;

namespace BepuUtilities.TaskScheduling;

/// <summary>The tasks of one push. Workers claim them one after another, the first one first.</summary>
[StructLayout(LayoutKind.Sequential)]
unsafe struct TaskStackJob
{
    // The only task, or that of the first index of a loop; unused when there is an array.
    readonly Task template;
    readonly Task* tasks;
    readonly int taskCount;
    int remaining;

    public readonly ulong Tag;

    /// <summary>The job below. Changes only to leave out jobs without tasks.</summary>
    public TaskStackJob* Previous;

    /// <summary>A job of a task for each index of a loop, which differ by their ids.</summary>
    public TaskStackJob(Task template, int taskCount, ulong tag)
    {
        this = default;
        this.template = template;
        this.taskCount = taskCount;
        remaining = taskCount;
        Tag = tag;
    }

    /// <summary>A job of tasks that lie somewhere for as long as the job.</summary>
    public TaskStackJob(Task* tasks, int taskCount, ulong tag) : this(default(Task), taskCount, tag) => this.tasks = tasks;

    /// <summary>Number of tasks that nobody has claimed. Once zero it stays so.</summary>
    public int Remaining => Math.Max(Volatile.Read(ref remaining), 0);

    /// <summary>Takes the next task, if there is one.</summary>
    public bool TryClaim(out Task task)
    {
        // Looking first keeps the count from falling further below zero than there are workers.
        if (Volatile.Read(ref remaining) > 0)
        {
            var left = Interlocked.Decrement(ref remaining);
            if (left >= 0)
            {
                var index = taskCount - 1 - left;
                task = tasks != null ? tasks[index] : template;
                if (tasks == null)
                    task.Id += index;
                return true;
            }
        }
        task = default;
        return false;
    }
}
