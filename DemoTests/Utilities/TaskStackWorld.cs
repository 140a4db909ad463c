using System;
using System.Collections.Generic;
using System.Runtime.ExceptionServices;
using System.Threading;
using BepuUtilities;
using BepuUtilities.Memory;
using BepuUtilities.TaskScheduling;
using Xunit;

namespace DemoTests.Utilities;

/// <summary>A stack with its workers. The end of it requires that all pools have everything back.</summary>
sealed unsafe class TaskStackWorld : IDisposable
{
    readonly BufferPool pool = new();
    readonly List<Buffer<int>> counters = [];
    Buffer<TaskStack> stack;

    public TaskStackWorld(int threadCount, int initialWorkerJobCapacity = 128, int continuationBlockCapacity = 128)
    {
        Dispatcher = new ThreadDispatcher(threadCount);
        pool.Take(1, out stack);
        stack[0] = new TaskStack(pool, Dispatcher, threadCount, initialWorkerJobCapacity, continuationBlockCapacity);
    }

    public ThreadDispatcher Dispatcher { get; }

    public TaskStack* Stack => stack.Memory;

    public int WorkerCount => Dispatcher.ThreadCount;

    /// <summary>Zeroed memory that lasts until the world ends.</summary>
    public int* TakeCounters(int count)
    {
        pool.Take(count, out Buffer<int> buffer);
        buffer.Clear(0, count);
        counters.Add(buffer);
        return buffer.Memory;
    }

    /// <summary>Runs all workers until a task, which is pushed here, and what it leads to have ended.</summary>
    public void Run(delegate*<long, void*, int, IThreadDispatcher, void> root, void* context, long id = 0)
    {
        Stack->AllocateContinuationAndPush(new Task(root, context, id), 0, Dispatcher, onComplete: TaskStack.GetRequestStopTask(Stack));
        TaskStack.DispatchWorkers(Dispatcher, Stack);
    }

    public void Reset() => Stack->Reset(Dispatcher);

    public void Dispose()
    {
        Stack->Dispose(pool, Dispatcher);
        pool.Return(ref stack);
        foreach (var buffer in counters)
        {
            var lent = buffer;
            pool.Return(ref lent);
        }
        pool.AssertEmpty();
        Dispatcher.WorkerPools.AssertEmpty();
        Dispatcher.Dispose();
        pool.Dispose();
    }

    /// <summary>Runs a test on a thread of its own, and fails if it does not end.</summary>
    public static void RequireEnd(Action test)
    {
        Exception? failure = null;
        var thread = new Thread(() =>
        {
            try
            {
                test();
            }
            catch (Exception exception)
            {
                failure = exception;
            }
        })
        { IsBackground = true };
        thread.Start();
        Assert.True(thread.Join(TimeSpan.FromSeconds(60)), "It hangs.");
        if (failure != null)
            ExceptionDispatchInfo.Throw(failure);
    }
}
