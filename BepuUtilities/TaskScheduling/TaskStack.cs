using System;
using System.Diagnostics.CodeAnalysis;
using System.Threading;
using BepuUtilities.Memory;

namespace BepuUtilities.TaskScheduling;

/// <summary>
/// A stack of tasks that the workers of a dispatcher share. What is pushed together is a job; a worker takes the tasks of the newest
/// job that its filter allows, and may push more and wait for them within a task. For work whose shape shows only while it is done;
/// the library's own stages are <see cref="StagedWork"/>. Copies of a stack are the same stack. Nothing here allocates managed memory
/// but the way of an exception.
/// </summary>
/// <remarks>
/// <b>Threads.</b> A worker index stands for one thread at a time: memory for what a worker pushes comes from its own pool of the
/// dispatcher, without a lock. All members may be used by several workers at once but the constructor, <see cref="Reset"/>,
/// <see cref="Dispose"/> and those named unsafe.
/// <para>
/// <b>Memory.</b> A job, once pushed, and a continuation stay where they are until <see cref="Reset"/>, with tasks left or without. So
/// a worker may look at a job while others take its last task and push new ones: no pointer ever dangles and none changes its meaning,
/// which is what a lock-free stack usually fails at. The price is that memory grows with all that is pushed between two resets: 64 bytes
/// per job, 32 per task of a job that was pushed as a span of more than one, 64 per continuation. Loops are one job of 64 bytes, however
/// long. Jobs without tasks are left out of the way to older ones, by whoever comes across them.
/// </para>
/// <para>
/// <b>Waiting.</b> Who waits runs other tasks meanwhile, on top of its own stack. A task must therefore wait only for tasks that it has
/// pushed itself, or that were pushed by those; for others, it could wait for one that lies below it on the same stack. A wait whose
/// filter allows nothing that is left depends on other workers. A worker that finds nothing spins for some microseconds, then yields
/// its processor again and again; it never sleeps.
/// </para>
/// <para>
/// <b>Stops and exceptions.</b> After <see cref="RequestStop"/> no task is begun. An exception that leaves a task stops the stack likewise
/// and goes on to the caller of the worker; other workers that wait for tasks which will not end any more leave their wait by an
/// <see cref="OperationCanceledException"/> with the first exception inside. In any case a wait ends only when none of the tasks that were
/// waited for runs any more, so that these may use memory of the waiting method.
/// </para>
/// </remarks>
public unsafe partial struct TaskStack
{
    // The state, then the workers.
    Buffer<byte> memory;

    /// <summary>Creates a stack. Pools of the workers lend memory only when a worker pushes.</summary>
    /// <param name="pool">Lends what the workers share.</param>
    /// <param name="dispatcher">Dispatcher whose workers will use the stack.</param>
    /// <param name="workerCount">Number of workers that may use the stack, at most the number of the dispatcher's pools.</param>
    /// <param name="initialWorkerJobCapacity">Number of jobs that a worker's first memory has room for.</param>
    /// <param name="continuationBlockCapacity">Number of continuations that a worker takes memory for at a time.</param>
    public TaskStack(BufferPool pool, IThreadDispatcher dispatcher, int workerCount, int initialWorkerJobCapacity = 128,
        int continuationBlockCapacity = 128)
    {
        ArgumentNullException.ThrowIfNull(pool);
        ArgumentNullException.ThrowIfNull(dispatcher);
        ArgumentOutOfRangeException.ThrowIfNegativeOrZero(workerCount);
        ArgumentOutOfRangeException.ThrowIfGreaterThan(workerCount, dispatcher.WorkerPools.WorkerCount);
        ArgumentOutOfRangeException.ThrowIfNegativeOrZero(initialWorkerJobCapacity);
        ArgumentOutOfRangeException.ThrowIfNegativeOrZero(continuationBlockCapacity);
        pool.Take(checked(TaskStackState.Size + workerCount * TaskStackWorker.Size), out memory);
        new Span<byte>(memory.Memory, memory.Length).Clear();
        var state = (TaskStackState*)memory.Memory;
        state->WorkerCount = workerCount;
        state->InitialJobCapacity = initialWorkerJobCapacity;
        state->ContinuationBlockCapacity = continuationBlockCapacity;
    }

    /// <summary>Number of tasks that wait to be taken, roughly, while other workers use the stack.</summary>
    public readonly int ApproximateTaskCount
    {
        get
        {
            long count = 0;
            for (var job = Read(&GetState()->Newest); job != null; job = Read(&job->Previous))
                count += job->Remaining;
            return (int)Math.Min(count, int.MaxValue);
        }
    }

    /// <summary>Number of continuations that are not completed, roughly, while other workers use the stack.</summary>
    public readonly int ApproximateContinuationCount
    {
        get
        {
            var state = GetState();
            var count = 0;
            for (int i = 0; i < state->WorkerCount; ++i)
                count += Volatile.Read(ref state->GetWorker(i)->ActiveContinuationCount);
            return count;
        }
    }

    /// <summary>
    /// Drops all tasks and continuations, gives their memory back, and lets a stack that had stopped start again. Only while no worker
    /// uses the stack. Handles of continuations must not be used any more.
    /// </summary>
    /// <param name="dispatcher">Dispatcher whose workers have used the stack.</param>
    public readonly void Reset(IThreadDispatcher dispatcher)
    {
        var state = GetState();
        ArgumentNullException.ThrowIfNull(dispatcher);
        if (dispatcher.WorkerPools.WorkerCount < state->WorkerCount)
            throw new ArgumentException(
                $"The dispatcher has {dispatcher.WorkerPools.WorkerCount} worker pools, the stack {state->WorkerCount} workers.", nameof(dispatcher));
        for (int i = 0; i < state->WorkerCount; ++i)
        {
            var worker = state->GetWorker(i);
            worker->Jobs.Return(dispatcher.WorkerPools[i]);
            worker->Continuations.Return(dispatcher.WorkerPools[i]);
            worker->ActiveContinuationCount = 0;
        }
        state->Restart();
    }

    /// <summary>Gives all memory back. Only while no worker uses the stack.</summary>
    /// <param name="pool">Pool that the stack was created with.</param>
    /// <param name="dispatcher">Dispatcher whose workers have used the stack.</param>
    public void Dispose(BufferPool pool, IThreadDispatcher dispatcher)
    {
        ArgumentNullException.ThrowIfNull(pool);
        Reset(dispatcher);
        pool.Return(ref memory);
    }

    /// <summary>Creates a continuation, which waits for a number of tasks that are yet to be pushed, run or notified with its handle.</summary>
    /// <param name="taskCount">Number of tasks. With none, the task to run after them is run here at once.</param>
    /// <param name="workerIndex">Index of the worker that calls.</param>
    /// <param name="dispatcher">Dispatcher of that worker.</param>
    /// <param name="onCompleted">Task to run after the others, on the worker that ends the last of them; default for none.</param>
    /// <returns>A handle that is valid until the stack is reset.</returns>
    public readonly ContinuationHandle AllocateContinuation(int taskCount, int workerIndex, IThreadDispatcher dispatcher, Task onCompleted = default)
    {
        var state = GetState();
        ArgumentOutOfRangeException.ThrowIfNegative(taskCount);
        // The continuation counts that task as well.
        ArgumentOutOfRangeException.ThrowIfEqual(taskCount, int.MaxValue);
        ArgumentNullException.ThrowIfNull(dispatcher);
        var worker = state->GetWorker(workerIndex);
        var continuation = (TaskContinuation*)worker->Continuations.Take(1, state->ContinuationBlockCapacity, dispatcher.WorkerPools[workerIndex]);
        *continuation = new TaskContinuation(taskCount, onCompleted, state, worker);
        if (taskCount == 0 && onCompleted.Function != null)
            TaskContinuation.Run(onCompleted, continuation, workerIndex, dispatcher);
        return new ContinuationHandle(continuation);
    }

    readonly TaskStackState* GetState()
    {
        if (memory.Memory == null)
            ThrowNotAllocated();
        return (TaskStackState*)memory.Memory;
    }

    [DoesNotReturn]
    static void ThrowNotAllocated() => throw new ObjectDisposedException(nameof(TaskStack), "The stack was disposed, or not created by its constructor.");
}
