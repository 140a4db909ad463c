using System;
using System.Threading;

namespace BepuUtilities.TaskScheduling;

public unsafe partial struct TaskStack
{
    // A worker's blocks for jobs double up to this number of cache lines, a megabyte.
    const int MostLinesToDoubleTo = 16384;

    /// <summary>Takes a task of the newest job that a filter allows, the first of its tasks first. It is up to the caller to run it.</summary>
    /// <param name="filter">Filter of jobs.</param>
    /// <param name="task">Task that was taken.</param>
    public readonly PopTaskResult TryPop<TJobFilter>(ref TJobFilter filter, out Task task) where TJobFilter : IJobFilter
    {
        var state = GetState();
        task = default;
        if (state->IsStopped)
            return PopTaskResult.Stop;
        var link = &state->Newest;
        while (true)
        {
            var job = Read(link);
            if (job == null)
                return PopTaskResult.Empty;
            if (job->Remaining == 0)
            {
                // Leave it out for those who come after. If the link has changed meanwhile, it is looked at again; jobs never come back.
                Exchange(link, Read(&job->Previous), job);
            }
            else if (!filter.AllowJob(job->Tag))
                link = &job->Previous;
            else if (job->TryClaim(out task))
                return PopTaskResult.Success;
        }
    }

    /// <summary>Takes a task of the newest job, the first of its tasks first. It is up to the caller to run it.</summary>
    /// <param name="task">Task that was taken.</param>
    public readonly PopTaskResult TryPop(out Task task)
    {
        var filter = default(AllowAllJobs);
        return TryPop(ref filter, out task);
    }

    /// <summary>Takes a task of the newest job that a filter allows and runs it.</summary>
    /// <param name="filter">Filter of jobs.</param>
    /// <param name="workerIndex">Index of the worker that calls.</param>
    /// <param name="dispatcher">Dispatcher of that worker.</param>
    public readonly PopTaskResult TryPopAndRun<TJobFilter>(ref TJobFilter filter, int workerIndex, IThreadDispatcher dispatcher)
        where TJobFilter : IJobFilter
    {
        CheckWorker(workerIndex, dispatcher);
        var result = TryPop(ref filter, out var task);
        if (result == PopTaskResult.Success)
            RunOrFail(task, workerIndex, dispatcher);
        return result;
    }

    /// <summary>Takes a task of the newest job and runs it.</summary>
    /// <param name="workerIndex">Index of the worker that calls.</param>
    /// <param name="dispatcher">Dispatcher of that worker.</param>
    public readonly PopTaskResult TryPopAndRun(int workerIndex, IThreadDispatcher dispatcher)
    {
        var filter = default(AllowAllJobs);
        return TryPopAndRun(ref filter, workerIndex, dispatcher);
    }

    /// <summary>Pushes tasks as one job while nobody else uses the stack. An empty span is no job.</summary>
    /// <param name="tasks">Tasks, which are copied.</param>
    /// <param name="workerIndex">Index of the worker whose pool lends the memory.</param>
    /// <param name="dispatcher">Dispatcher of that worker.</param>
    /// <param name="tag">Tag of the job, for filters.</param>
    public readonly void PushUnsafely(Span<Task> tasks, int workerIndex, IThreadDispatcher dispatcher, ulong tag = 0)
    {
        CheckTasks(tasks, workerIndex, dispatcher);
        if (tasks.Length > 0)
            LinkUnsafely(CreateJob(tasks, workerIndex, dispatcher, tag));
    }

    /// <summary>Pushes a task as a job of its own while nobody else uses the stack.</summary>
    /// <param name="task">Task to push.</param>
    /// <param name="workerIndex">Index of the worker whose pool lends the memory.</param>
    /// <param name="dispatcher">Dispatcher of that worker.</param>
    /// <param name="tag">Tag of the job, for filters.</param>
    public readonly void PushUnsafely(Task task, int workerIndex, IThreadDispatcher dispatcher, ulong tag = 0) =>
        PushUnsafely(new Span<Task>(ref task), workerIndex, dispatcher, tag);

    /// <summary>Pushes tasks as one job. An empty span is no job.</summary>
    /// <param name="tasks">Tasks, which are copied.</param>
    /// <param name="workerIndex">Index of the worker that calls.</param>
    /// <param name="dispatcher">Dispatcher of that worker.</param>
    /// <param name="tag">Tag of the job, for filters.</param>
    public readonly void Push(Span<Task> tasks, int workerIndex, IThreadDispatcher dispatcher, ulong tag = 0)
    {
        CheckTasks(tasks, workerIndex, dispatcher);
        if (tasks.Length > 0)
            Link(CreateJob(tasks, workerIndex, dispatcher, tag));
    }

    /// <summary>Pushes a task as a job of its own.</summary>
    /// <param name="task">Task to push.</param>
    /// <param name="workerIndex">Index of the worker that calls.</param>
    /// <param name="dispatcher">Dispatcher of that worker.</param>
    /// <param name="tag">Tag of the job, for filters.</param>
    public readonly void Push(Task task, int workerIndex, IThreadDispatcher dispatcher, ulong tag = 0) =>
        Push(new Span<Task>(ref task), workerIndex, dispatcher, tag);

    /// <summary>Pushes tasks as one job, with a new continuation that waits for them.</summary>
    /// <param name="tasks">Tasks without continuations; they are copied, and the copies get the new one.</param>
    /// <param name="workerIndex">Index of the worker that calls.</param>
    /// <param name="dispatcher">Dispatcher of that worker.</param>
    /// <param name="tag">Tag of the job, for filters.</param>
    /// <param name="onComplete">Task to run after the others, on the worker that ends the last of them; default for none.</param>
    public readonly ContinuationHandle AllocateContinuationAndPush(Span<Task> tasks, int workerIndex, IThreadDispatcher dispatcher, ulong tag = 0,
        Task onComplete = default)
    {
        CheckTasks(tasks, workerIndex, dispatcher);
        CheckHaveNoContinuation(tasks);
        var continuation = AllocateContinuation(tasks.Length, workerIndex, dispatcher, onComplete);
        if (tasks.Length > 0)
            Link(CreateJob(tasks, workerIndex, dispatcher, tag, continuation));
        return continuation;
    }

    /// <summary>Pushes a task as a job of its own, with a new continuation that waits for it.</summary>
    /// <param name="task">Task without a continuation.</param>
    /// <param name="workerIndex">Index of the worker that calls.</param>
    /// <param name="dispatcher">Dispatcher of that worker.</param>
    /// <param name="tag">Tag of the job, for filters.</param>
    /// <param name="onComplete">Task to run after the other, on the same worker; default for none.</param>
    public readonly ContinuationHandle AllocateContinuationAndPush(Task task, int workerIndex, IThreadDispatcher dispatcher, ulong tag = 0,
        Task onComplete = default) =>
        AllocateContinuationAndPush(new Span<Task>(ref task), workerIndex, dispatcher, tag, onComplete);

    /// <summary>Makes a job of checked tasks, at least one, with their own continuations or with a common one.</summary>
    readonly TaskStackJob* CreateJob(Span<Task> tasks, int workerIndex, IThreadDispatcher dispatcher, ulong tag, ContinuationHandle continuation = default)
    {
        if (tasks.Length == 1)
        {
            var task = tasks[0];
            if (continuation.Initialized)
                task.Continuation = continuation;
            return CreateJob(task, 1, workerIndex, dispatcher, tag);
        }
        const int TasksPerLine = 2;
        var job = TakeJob(1 + tasks.Length / TasksPerLine + tasks.Length % TasksPerLine, workerIndex, dispatcher);
        var copies = (Task*)(job + 1);
        tasks.CopyTo(new Span<Task>(copies, tasks.Length));
        if (continuation.Initialized)
        {
            for (int i = 0; i < tasks.Length; ++i)
                copies[i].Continuation = continuation;
        }
        *job = new TaskStackJob(copies, tasks.Length, tag);
        return job;
    }

    /// <summary>Makes a job of tasks whose ids ascend from that of the first.</summary>
    readonly TaskStackJob* CreateJob(Task first, int taskCount, int workerIndex, IThreadDispatcher dispatcher, ulong tag)
    {
        var job = TakeJob(1, workerIndex, dispatcher);
        *job = new TaskStackJob(first, taskCount, tag);
        return job;
    }

    readonly TaskStackJob* TakeJob(int lineCount, int workerIndex, IThreadDispatcher dispatcher)
    {
        var state = GetState();
        ref var arena = ref state->GetWorker(workerIndex)->Jobs;
        var blockLength = Math.Max(state->InitialJobCapacity, Math.Min(arena.NewestBlockLength, MostLinesToDoubleTo / 2) * 2 - 1);
        return (TaskStackJob*)arena.Take(lineCount, blockLength, dispatcher.WorkerPools[workerIndex]);
    }

    readonly void LinkUnsafely(TaskStackJob* job)
    {
        var state = GetState();
        job->Previous = state->Newest;
        state->Newest = job;
    }

    readonly void Link(TaskStackJob* job)
    {
        var state = GetState();
        TaskStackJob* newest;
        do
        {
            newest = Read(&state->Newest);
            job->Previous = newest;
        }
        while (!Exchange(&state->Newest, job, newest));
    }

    readonly void CheckWorker(int workerIndex, IThreadDispatcher dispatcher)
    {
        ArgumentNullException.ThrowIfNull(dispatcher);
        GetState()->GetWorker(workerIndex);
    }

    readonly void CheckTasks(Span<Task> tasks, int workerIndex, IThreadDispatcher dispatcher)
    {
        CheckWorker(workerIndex, dispatcher);
        for (int i = 0; i < tasks.Length; ++i)
        {
            if (tasks[i].Function == null)
                throw new ArgumentException($"Task {i} has no function.", nameof(tasks));
        }
    }

    static void CheckHaveNoContinuation(Span<Task> tasks)
    {
        for (int i = 0; i < tasks.Length; ++i)
        {
            if (tasks[i].Continuation.Initialized)
                throw new ArgumentException($"Task {i} has a continuation already, which would never hear of its end.", nameof(tasks));
        }
    }

    static TaskStackJob* Read(TaskStackJob** link) => (TaskStackJob*)Volatile.Read(ref *(nint*)link);

    static bool Exchange(TaskStackJob** link, TaskStackJob* value, TaskStackJob* expected) =>
        Interlocked.CompareExchange(ref *(nint*)link, (nint)value, (nint)expected) == (nint)expected;
}
