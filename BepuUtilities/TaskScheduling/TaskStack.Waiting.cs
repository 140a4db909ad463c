using System;
using System.Threading;

namespace BepuUtilities.TaskScheduling;

public unsafe partial struct TaskStack
{
    // SpinWait.SpinOnce: spin, then yield to others, but never sleep.
    const int NeverSleep = -1;

    /// <summary>Waits until a continuation is completed, and runs tasks that a filter allows meanwhile.</summary>
    /// <param name="filter">Filter of jobs to run tasks of.</param>
    /// <param name="continuation">Continuation to wait for. There is nothing to wait for with <see cref="ContinuationHandle.Null"/>.</param>
    /// <param name="workerIndex">Index of the worker that calls.</param>
    /// <param name="dispatcher">Dispatcher of that worker.</param>
    /// <remarks>
    /// After <see cref="RequestStop"/> it returns without completion, as soon as no task of the continuation runs;
    /// <see cref="ContinuationHandle.Completed"/> tells.
    /// </remarks>
    /// <exception cref="OperationCanceledException">A task on another worker threw an exception, which is inside.</exception>
    public readonly void WaitForCompletion<TJobFilter>(ref TJobFilter filter, ContinuationHandle continuation, int workerIndex, IThreadDispatcher dispatcher)
        where TJobFilter : IJobFilter
    {
        CheckWorker(workerIndex, dispatcher);
        var wait = default(SpinWait);
        try
        {
            while (!continuation.Completed)
            {
                var result = TryPopAndRun(ref filter, workerIndex, dispatcher);
                if (result == PopTaskResult.Stop)
                    break;
                if (result == PopTaskResult.Success)
                    wait.Reset();
                else
                    wait.SpinOnce(NeverSleep);
            }
        }
        catch (Exception exception)
        {
            GetState()->Fail(exception);
            WaitForRunningTasks(continuation);
            throw;
        }
        if (continuation.Completed)
            return;
        WaitForRunningTasks(continuation);
        if (GetState()->HasFailed && !continuation.Completed)
            throw new OperationCanceledException(
                "A task threw an exception, so that tasks which are waited for will not be run.", GetState()->Failure);
    }

    /// <summary>Waits until a continuation is completed, and runs tasks meanwhile.</summary>
    /// <param name="continuation">Continuation to wait for. There is nothing to wait for with <see cref="ContinuationHandle.Null"/>.</param>
    /// <param name="workerIndex">Index of the worker that calls.</param>
    /// <param name="dispatcher">Dispatcher of that worker.</param>
    /// <inheritdoc cref="WaitForCompletion{TJobFilter}(ref TJobFilter, ContinuationHandle, int, IThreadDispatcher)" path="//remarks"/>
    /// <exception cref="OperationCanceledException">A task on another worker threw an exception, which is inside.</exception>
    public readonly void WaitForCompletion(ContinuationHandle continuation, int workerIndex, IThreadDispatcher dispatcher)
    {
        var filter = default(AllowAllJobs);
        WaitForCompletion(ref filter, continuation, workerIndex, dispatcher);
    }

    /// <summary>Runs tasks, the first one here whatever the filter says, the others wherever there is a worker, and returns when all have ended.</summary>
    /// <param name="tasks">Tasks without continuations.</param>
    /// <param name="workerIndex">Index of the worker that calls.</param>
    /// <param name="dispatcher">Dispatcher of that worker.</param>
    /// <param name="filter">Filter of jobs to run tasks of while waiting; it should allow the tag, lest only other workers run the tasks.</param>
    /// <param name="tag">Tag of the job, for filters.</param>
    /// <remarks>After <see cref="RequestStop"/> tasks that have not begun are not run.</remarks>
    /// <exception cref="OperationCanceledException">A task on another worker threw an exception, which is inside.</exception>
    public readonly void RunTasks<TJobFilter>(Span<Task> tasks, int workerIndex, IThreadDispatcher dispatcher, ref TJobFilter filter, ulong tag = 0)
        where TJobFilter : IJobFilter
    {
        CheckTasks(tasks, workerIndex, dispatcher);
        CheckHaveNoContinuation(tasks);
        if (tasks.Length == 0)
            return;
        var first = tasks[0];
        first.Continuation = AllocateContinuation(tasks.Length, workerIndex, dispatcher);
        if (tasks.Length > 1)
            Link(CreateJob(tasks[1..], workerIndex, dispatcher, tag, first.Continuation));
        RunAndWait(first, ref filter, workerIndex, dispatcher);
    }

    /// <summary>Runs tasks, the first one here, the others wherever there is a worker, and returns when all have ended.</summary>
    /// <param name="tasks">Tasks without continuations.</param>
    /// <param name="workerIndex">Index of the worker that calls.</param>
    /// <param name="dispatcher">Dispatcher of that worker.</param>
    /// <param name="tag">Tag of the job, for filters.</param>
    /// <remarks>After <see cref="RequestStop"/> tasks that have not begun are not run.</remarks>
    /// <exception cref="OperationCanceledException">A task on another worker threw an exception, which is inside.</exception>
    public readonly void RunTasks(Span<Task> tasks, int workerIndex, IThreadDispatcher dispatcher, ulong tag = 0)
    {
        var filter = default(AllowAllJobs);
        RunTasks(tasks, workerIndex, dispatcher, ref filter, tag);
    }

    /// <summary>Runs a task here; the same as <see cref="RunTasks{TJobFilter}"/> with one task.</summary>
    /// <param name="task">Task without a continuation.</param>
    /// <param name="workerIndex">Index of the worker that calls.</param>
    /// <param name="dispatcher">Dispatcher of that worker.</param>
    /// <param name="filter">Filter of jobs to run tasks of while waiting.</param>
    /// <param name="tag">Tag of the job, for filters.</param>
    public readonly void RunTask<TJobFilter>(Task task, int workerIndex, IThreadDispatcher dispatcher, ref TJobFilter filter, ulong tag = 0)
        where TJobFilter : IJobFilter =>
        RunTasks(new Span<Task>(ref task), workerIndex, dispatcher, ref filter, tag);

    /// <summary>Runs a task here; the same as <see cref="RunTasks(Span{Task}, int, IThreadDispatcher, ulong)"/> with one task.</summary>
    /// <param name="task">Task without a continuation.</param>
    /// <param name="workerIndex">Index of the worker that calls.</param>
    /// <param name="dispatcher">Dispatcher of that worker.</param>
    /// <param name="tag">Tag of the job, for filters.</param>
    public readonly void RunTask(Task task, int workerIndex, IThreadDispatcher dispatcher, ulong tag = 0) =>
        RunTasks(new Span<Task>(ref task), workerIndex, dispatcher, tag);

    /// <summary>Runs a task here and waits for its continuation.</summary>
    readonly void RunAndWait<TJobFilter>(Task task, ref TJobFilter filter, int workerIndex, IThreadDispatcher dispatcher) where TJobFilter : IJobFilter
    {
        try
        {
            task.Run(workerIndex, dispatcher);
        }
        catch (Exception exception)
        {
            // The others may use memory of whoever called: let them end before the exception takes it away.
            GetState()->Fail(exception);
            WaitForRunningTasks(task.Continuation);
            throw;
        }
        WaitForCompletion(ref filter, task.Continuation, workerIndex, dispatcher);
    }

    /// <summary>Runs a task; an exception stops the stack before it goes on.</summary>
    readonly void RunOrFail(Task task, int workerIndex, IThreadDispatcher dispatcher)
    {
        try
        {
            task.Run(workerIndex, dispatcher);
        }
        catch (Exception exception)
        {
            GetState()->Fail(exception);
            throw;
        }
    }

    /// <summary>Waits, after a stop, until no task of a continuation runs; none of them begins any more.</summary>
    static void WaitForRunningTasks(ContinuationHandle continuation)
    {
        // Pairs with the fence of a task that begins, see TaskContinuation.
        Interlocked.MemoryBarrier();
        var wait = default(SpinWait);
        while (continuation.Initialized && continuation.Memory->HasRunningTasks)
            wait.SpinOnce(NeverSleep);
    }
}
