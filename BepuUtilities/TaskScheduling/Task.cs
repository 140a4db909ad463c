using System;

namespace BepuUtilities.TaskScheduling;

/// <summary>A function to call once, with what it is to be called with, and who is to hear of its end.</summary>
public unsafe struct Task
{
    /// <summary>Function to call with <see cref="Id"/>, <see cref="Context"/>, the index of the worker that calls, and its dispatcher.</summary>
    public delegate*<long, void*, int, IThreadDispatcher, void> Function;

    /// <summary>Handed to the function. What it points to must live until the task has ended.</summary>
    public void* Context;

    /// <summary>Handed to the function.</summary>
    public long Id;

    /// <summary>Continuation that hears of the end of the task; <see cref="ContinuationHandle.Null"/> for none.</summary>
    public ContinuationHandle Continuation;

    /// <summary>Creates a task.</summary>
    /// <param name="function">Function to call.</param>
    /// <param name="context">Handed to the function; what it points to must live until the task has ended.</param>
    /// <param name="taskId">Handed to the function.</param>
    /// <param name="continuation">Continuation that hears of the end of the task; it must expect it, see <see cref="TaskStack.AllocateContinuation"/>.</param>
    public Task(delegate*<long, void*, int, IThreadDispatcher, void> function, void* context = null, long taskId = 0,
        ContinuationHandle continuation = default)
    {
        Id = taskId;
        Function = function;
        Context = context;
        Continuation = continuation;
    }

    /// <summary>
    /// Calls the function, then notifies the continuation, and runs here what that leads to. A task whose continuation belongs to a
    /// stack that has stopped is not begun.
    /// </summary>
    /// <param name="workerIndex">Index of the worker that calls.</param>
    /// <param name="dispatcher">Dispatcher of that worker.</param>
    /// <exception cref="InvalidOperationException">There is no function.</exception>
    public readonly void Run(int workerIndex, IThreadDispatcher dispatcher)
    {
        if (Function == null)
            throw new InvalidOperationException("The task has no function.");
        TaskContinuation.Run(this, null, workerIndex, dispatcher);
    }

    /// <summary>A task that calls a function without a context.</summary>
    public static implicit operator Task(delegate*<long, void*, int, IThreadDispatcher, void> function) => new(function);
}
