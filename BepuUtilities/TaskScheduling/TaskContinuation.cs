using System;
using System.Runtime.InteropServices;
using System.Threading;

namespace BepuUtilities.TaskScheduling;

/// <summary>What is to be done once a number of tasks have ended. A <see cref="TaskStack"/> owns it; a <see cref="ContinuationHandle"/> names it.</summary>
/// <remarks>
/// Two counts share a word: of the tasks that have yet to end, and of those among them that run now. A stop makes tasks be dropped
/// instead of begun, so the first count may stay above zero for ever, but the second falls to zero in finite time. Whoever waits
/// needs both: it leaves when the first is zero, or after a stop when the second is. Only then does no task use its memory any more.
/// <para>
/// A task begins by counting itself as running and looks for a stop afterwards; who waits sees the stop first and looks at the count
/// afterwards. Both have a fence between the two, so that either the task sees the stop, and withdraws, or the count shows the task.
/// </para>
/// </remarks>
[StructLayout(LayoutKind.Explicit, Size = TaskStackArena.LineSize)]
public unsafe struct TaskContinuation
{
    const long OneRunning = 1L << 32;

    /// <summary>Task that the worker which ends the last of the tasks runs; it has no function when there is nothing to do.</summary>
    [FieldOffset(0)] public Task OnCompleted;

    /// <summary>Number of tasks that have not ended, <see cref="OnCompleted"/> included.</summary>
    [FieldOffset(32)] public int RemainingTaskCounter;

    // The remaining tasks in the low half, the running ones in the high half.
    [FieldOffset(32)] long counts;
    [FieldOffset(40)] readonly TaskStackState* stack;
    [FieldOffset(48)] readonly TaskStackWorker* allocator;

    /// <summary>Creates a continuation that counts as active at its allocator until it is completed.</summary>
    internal TaskContinuation(int taskCount, Task onCompleted, TaskStackState* stack, TaskStackWorker* allocator)
    {
        OnCompleted = onCompleted;
        counts = (long)taskCount + (onCompleted.Function != null ? 1 : 0);
        this.stack = stack;
        this.allocator = allocator;
        if (counts > 0)
            Interlocked.Increment(ref allocator->ActiveContinuationCount);
    }

    internal bool Completed => (int)Volatile.Read(ref counts) <= 0;

    internal bool HasRunningTasks => (int)(Volatile.Read(ref counts) >> 32) > 0;

    /// <summary>Counts a task as ended that never counted as running.</summary>
    /// <returns>Whether the caller is to run <see cref="OnCompleted"/>.</returns>
    internal bool EndWithoutRunning()
    {
        if (Completed)
            ThrowTooMany();
        return End(-1);
    }

    /// <summary>Runs a task, and what its end leads to, one after another: a chain of continuations takes no stack.</summary>
    /// <param name="task">Task to run.</param>
    /// <param name="completing">Continuation that this task completes, being its last; null for none.</param>
    /// <param name="workerIndex">Index of the worker that runs the task.</param>
    /// <param name="dispatcher">Dispatcher of that worker.</param>
    internal static void Run(Task task, TaskContinuation* completing, int workerIndex, IThreadDispatcher dispatcher)
    {
        while (true)
        {
            var next = task.Continuation.Memory;
            if (next != null && !next->TryBegin())
                return;
            if (completing != null && !completing->TryBegin())
            {
                if (next != null)
                    next->Withdraw();
                return;
            }
            try
            {
                task.Function(task.Id, task.Context, workerIndex, dispatcher);
            }
            catch (Exception exception)
            {
                if (completing != null)
                    completing->Abandon(exception);
                if (next != null)
                    next->Abandon(exception);
                throw;
            }
            if (completing != null)
                completing->End(-OneRunning - 1);
            if (next == null || !next->End(-OneRunning - 1))
                return;
            completing = next;
            task = next->OnCompleted;
        }
    }

    /// <summary>Counts a task as running, unless the stack has stopped.</summary>
    bool TryBegin()
    {
        var now = Interlocked.Add(ref counts, OneRunning);
        if (stack->IsStopped)
        {
            Withdraw();
            return false;
        }
        if ((int)(now >> 32) > (int)now)
        {
            Withdraw();
            ThrowTooMany();
        }
        return true;
    }

    /// <summary>Takes back that a task runs; it remains to be done.</summary>
    void Withdraw() => Interlocked.Add(ref counts, -OneRunning);

    /// <summary>Ends a running task that threw an exception: the stack stops first, so that who waits learns why there will be no end.</summary>
    void Abandon(Exception exception)
    {
        stack->Fail(exception);
        Withdraw();
    }

    bool End(long change)
    {
        // A fence both ways: whoever sees the last of the counts sees what all tasks wrote.
        var remaining = (int)Interlocked.Add(ref counts, change);
        if (remaining == 0)
            Interlocked.Decrement(ref allocator->ActiveContinuationCount);
        return remaining == 1 && OnCompleted.Function != null;
    }

    static void ThrowTooMany() =>
        throw new InvalidOperationException("More tasks were run for the continuation, or it was notified more often, than it was allocated for.");
}
