using System;
using System.Runtime.ExceptionServices;
using System.Threading;

namespace BepuUtilities.TaskScheduling;

public unsafe partial struct TaskStack
{
    /// <summary>Lets no further task begin until <see cref="Reset"/>: workers leave, and who waits returns when the tasks that run have ended.</summary>
    public readonly void RequestStop() => GetState()->RequestStop();

    /// <summary>The function of the task that requests a stop.</summary>
    /// <param name="id">Not used.</param>
    /// <param name="untypedContext">Pointer to the stack.</param>
    /// <param name="workerIndex">Not used.</param>
    /// <param name="dispatcher">Not used.</param>
    public static void RequestStopTaskFunction(long id, void* untypedContext, int workerIndex, IThreadDispatcher dispatcher) =>
        ((TaskStack*)untypedContext)->RequestStop();

    /// <summary>A task that requests a stop, such as the one to run when all is done.</summary>
    /// <param name="stack">Stack to stop; the pointer must be valid when the task runs.</param>
    public static Task GetRequestStopTask(TaskStack* stack)
    {
        ArgumentNullException.ThrowIfNull(stack);
        return new Task(&RequestStopTaskFunction, stack);
    }

    /// <summary>Runs tasks of the stack that is the unmanaged context of the dispatch, until the stack stops.</summary>
    /// <param name="workerIndex">Index of the worker that calls.</param>
    /// <param name="dispatcher">Dispatcher of that worker.</param>
    public static void DispatchWorkerFunction(int workerIndex, IThreadDispatcher dispatcher)
    {
        ArgumentNullException.ThrowIfNull(dispatcher);
        var stack = (TaskStack*)dispatcher.UnmanagedContext;
        if (stack == null)
            throw new InvalidOperationException("The unmanaged context of the dispatch is not a task stack.");
        stack->RunUntilStop(workerIndex, dispatcher);
    }

    /// <summary>
    /// Dispatches workers that run tasks until the stack stops: push tasks before, one of which requests the stop in the end. The stack is the
    /// unmanaged context of the dispatch.
    /// </summary>
    /// <param name="dispatcher">Provides the workers; if it runs none, the caller is the worker.</param>
    /// <param name="taskStack">Stack to take tasks from.</param>
    /// <param name="maximumWorkerCount">Most workers to run, at least one. There are never more than the stack was created for.</param>
    /// <param name="managedContext">Managed context of the dispatch.</param>
    /// <remarks>If tasks throw exceptions, the first one is thrown here after all workers have ended.</remarks>
    public static void DispatchWorkers(IThreadDispatcher dispatcher, TaskStack* taskStack, int maximumWorkerCount = int.MaxValue,
        object? managedContext = null)
    {
        ArgumentNullException.ThrowIfNull(dispatcher);
        ArgumentNullException.ThrowIfNull(taskStack);
        ArgumentOutOfRangeException.ThrowIfNegativeOrZero(maximumWorkerCount);
        var state = taskStack->GetState();
        try
        {
            dispatcher.DispatchWorkers(&DispatchWorkerFunction, Math.Min(maximumWorkerCount, state->WorkerCount), taskStack, managedContext);
            // A worker leaves only after a stop: if there was none, no worker came.
            taskStack->RunUntilStop(0, dispatcher);
        }
        catch (Exception) when (state->HasFailed)
        {
            // What the dispatcher throws is that, or a collection of it and of the waits that it ended.
        }
        if (state->Failure is { } failure)
            ExceptionDispatchInfo.Throw(failure);
    }

    readonly void RunUntilStop(int workerIndex, IThreadDispatcher dispatcher)
    {
        var wait = default(SpinWait);
        PopTaskResult result;
        while ((result = TryPopAndRun(workerIndex, dispatcher)) != PopTaskResult.Stop)
        {
            if (result == PopTaskResult.Success)
                wait.Reset();
            else
                wait.SpinOnce(NeverSleep);
        }
    }
}
