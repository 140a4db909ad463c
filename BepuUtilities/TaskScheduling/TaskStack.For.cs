using System;

namespace BepuUtilities.TaskScheduling;

public unsafe partial struct TaskStack
{
    /// <summary>Pushes a task for each index of a range, as one job of constant size, while nobody else uses the stack.</summary>
    /// <param name="function">Function to call with each index as the id.</param>
    /// <param name="context">Handed to the function; what it points to must live until the tasks have ended.</param>
    /// <param name="inclusiveStartIndex">First index.</param>
    /// <param name="iterationCount">Number of indices.</param>
    /// <param name="workerIndex">Index of the worker whose pool lends the memory.</param>
    /// <param name="dispatcher">Dispatcher of that worker.</param>
    /// <param name="tag">Tag of the job, for filters.</param>
    /// <param name="continuation">Continuation that hears of the end of each task; it must expect as many.</param>
    public readonly void PushForUnsafely(delegate*<long, void*, int, IThreadDispatcher, void> function, void* context, int inclusiveStartIndex,
        int iterationCount, int workerIndex, IThreadDispatcher dispatcher, ulong tag = 0, ContinuationHandle continuation = default)
    {
        CheckFor(function, iterationCount, workerIndex, dispatcher);
        if (iterationCount > 0)
            LinkUnsafely(CreateJob(new Task(function, context, inclusiveStartIndex, continuation), iterationCount, workerIndex, dispatcher, tag));
    }

    /// <summary>Pushes a task for each index of a range, as one job of constant size.</summary>
    /// <param name="function">Function to call with each index as the id.</param>
    /// <param name="context">Handed to the function; what it points to must live until the tasks have ended.</param>
    /// <param name="inclusiveStartIndex">First index.</param>
    /// <param name="iterationCount">Number of indices.</param>
    /// <param name="workerIndex">Index of the worker that calls.</param>
    /// <param name="dispatcher">Dispatcher of that worker.</param>
    /// <param name="tag">Tag of the job, for filters.</param>
    /// <param name="continuation">Continuation that hears of the end of each task; it must expect as many.</param>
    public readonly void PushFor(delegate*<long, void*, int, IThreadDispatcher, void> function, void* context, int inclusiveStartIndex,
        int iterationCount, int workerIndex, IThreadDispatcher dispatcher, ulong tag = 0, ContinuationHandle continuation = default)
    {
        CheckFor(function, iterationCount, workerIndex, dispatcher);
        if (iterationCount > 0)
            Link(CreateJob(new Task(function, context, inclusiveStartIndex, continuation), iterationCount, workerIndex, dispatcher, tag));
    }

    /// <summary>Runs a function for each index of a range, the first one here whatever the filter says, and returns when all calls have ended.</summary>
    /// <param name="function">Function to call with each index as the id.</param>
    /// <param name="context">Handed to the function.</param>
    /// <param name="inclusiveStartIndex">First index.</param>
    /// <param name="iterationCount">Number of indices.</param>
    /// <param name="workerIndex">Index of the worker that calls.</param>
    /// <param name="dispatcher">Dispatcher of that worker.</param>
    /// <param name="filter">Filter of jobs to run tasks of while waiting; it should allow the tag, lest only other workers run the tasks.</param>
    /// <param name="tag">Tag of the job, for filters.</param>
    /// <remarks>After <see cref="RequestStop"/> tasks that have not begun are not run.</remarks>
    /// <exception cref="OperationCanceledException">A task on another worker threw an exception, which is inside.</exception>
    public readonly void For<TJobFilter>(delegate*<long, void*, int, IThreadDispatcher, void> function, void* context, int inclusiveStartIndex,
        int iterationCount, int workerIndex, IThreadDispatcher dispatcher, ref TJobFilter filter, ulong tag = 0) where TJobFilter : IJobFilter
    {
        CheckFor(function, iterationCount, workerIndex, dispatcher);
        if (iterationCount == 0)
            return;
        var task = new Task(function, context, inclusiveStartIndex, AllocateContinuation(iterationCount, workerIndex, dispatcher));
        if (iterationCount > 1)
        {
            var second = task;
            ++second.Id;
            Link(CreateJob(second, iterationCount - 1, workerIndex, dispatcher, tag));
        }
        RunAndWait(task, ref filter, workerIndex, dispatcher);
    }

    /// <summary>Runs a function for each index of a range, the first one here, and returns when all calls have ended.</summary>
    /// <param name="function">Function to call with each index as the id.</param>
    /// <param name="context">Handed to the function.</param>
    /// <param name="inclusiveStartIndex">First index.</param>
    /// <param name="iterationCount">Number of indices.</param>
    /// <param name="workerIndex">Index of the worker that calls.</param>
    /// <param name="dispatcher">Dispatcher of that worker.</param>
    /// <param name="tag">Tag of the job, for filters.</param>
    /// <remarks>After <see cref="RequestStop"/> tasks that have not begun are not run.</remarks>
    /// <exception cref="OperationCanceledException">A task on another worker threw an exception, which is inside.</exception>
    public readonly void For(delegate*<long, void*, int, IThreadDispatcher, void> function, void* context, int inclusiveStartIndex,
        int iterationCount, int workerIndex, IThreadDispatcher dispatcher, ulong tag = 0)
    {
        var filter = default(AllowAllJobs);
        For(function, context, inclusiveStartIndex, iterationCount, workerIndex, dispatcher, ref filter, tag);
    }

    readonly void CheckFor(delegate*<long, void*, int, IThreadDispatcher, void> function, int iterationCount, int workerIndex, IThreadDispatcher dispatcher)
    {
        if (function == null)
            throw new ArgumentNullException(nameof(function));
        ArgumentOutOfRangeException.ThrowIfNegative(iterationCount);
        // One more than the tasks that a continuation can count.
        ArgumentOutOfRangeException.ThrowIfEqual(iterationCount, int.MaxValue);
        CheckWorker(workerIndex, dispatcher);
    }
}
