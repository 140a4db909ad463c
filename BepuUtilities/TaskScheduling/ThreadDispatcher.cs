using System;
using System.Globalization;
using System.Runtime.ExceptionServices;
using System.Threading;
using BepuUtilities.Memory;
using BepuUtilities.TaskScheduling;

namespace BepuUtilities;

/// <summary>
/// Runs workers on threads of its own, which sleep between dispatches; worker 0 is the calling thread. A dispatch allocates nothing.
/// An exception in a worker reaches the caller after all workers have ended, and the dispatcher can be used again.
/// One dispatch at a time: a second one, from another thread or from within a worker, is refused.
/// </summary>
public sealed unsafe class ThreadDispatcher : IThreadDispatcher, IDisposable
{
    readonly Thread[] threads;
    readonly WakeSignal[] starts;
    readonly WakeSignal completion;
    readonly Exception?[] failures;

    delegate*<int, IThreadDispatcher, void> functionBody;
    Action<int>? delegateBody;
    int remainingWorkers;
    int dispatching;
    bool stopping;
    bool disposed;

    /// <summary>Starts the threads.</summary>
    /// <param name="threadCount">Number of workers, the calling thread included; at least one.</param>
    /// <param name="threadPoolBlockAllocationSize">Least number of bytes that a worker's memory pool asks the system for at a time.</param>
    public ThreadDispatcher(int threadCount, int threadPoolBlockAllocationSize = 16384)
    {
        ArgumentOutOfRangeException.ThrowIfNegativeOrZero(threadCount);
        ThreadCount = threadCount;
        WorkerPools = new WorkerBufferPools(threadCount, threadPoolBlockAllocationSize);
        failures = new Exception?[threadCount];
        var sharesProcessors = threadCount > Environment.ProcessorCount;
        completion = new WakeSignal(sharesProcessors);
        threads = new Thread[threadCount - 1];
        starts = new WakeSignal[threadCount - 1];
        for (int i = 0; i < threads.Length; ++i)
            starts[i] = new WakeSignal(sharesProcessors);
        for (int i = 0; i < threads.Length; ++i)
        {
            var workerIndex = i + 1;
            threads[i] = new Thread(() => RunWorkerThread(workerIndex))
            {
                IsBackground = true,
                Name = string.Create(CultureInfo.InvariantCulture, $"Physics worker {workerIndex}"),
            };
            threads[i].Start();
        }
    }

    /// <inheritdoc/>
    public int ThreadCount { get; }

    /// <inheritdoc/>
    public void* UnmanagedContext { get; private set; }

    /// <inheritdoc/>
    public object? ManagedContext { get; private set; }

    /// <inheritdoc/>
    public WorkerBufferPools WorkerPools { get; }

    /// <inheritdoc/>
    public void DispatchWorkers(delegate*<int, IThreadDispatcher, void> workerBody, int maximumWorkerCount = int.MaxValue,
        void* unmanagedContext = null, object? managedContext = null)
    {
        if (workerBody == null)
            throw new ArgumentNullException(nameof(workerBody));
        Dispatch(workerBody, null, maximumWorkerCount, unmanagedContext, managedContext);
    }

    /// <inheritdoc/>
    public void DispatchWorkers(Action<int> workerBody, int maximumWorkerCount = int.MaxValue,
        void* unmanagedContext = null, object? managedContext = null)
    {
        ArgumentNullException.ThrowIfNull(workerBody);
        Dispatch(null, workerBody, maximumWorkerCount, unmanagedContext, managedContext);
    }

    /// <summary>Ends the threads and gives the workers' memory back to the system. Not from within a worker.</summary>
    public void Dispose()
    {
        if (disposed)
            return;
        if (Interlocked.CompareExchange(ref dispatching, 1, 0) != 0)
            throw new InvalidOperationException("A dispatcher cannot be disposed while it dispatches.");
        try
        {
            WorkerPools.CheckNotBusy();
        }
        catch
        {
            Volatile.Write(ref dispatching, 0);
            throw;
        }
        disposed = true;
        stopping = true;
        foreach (var start in starts)
            start.Send();
        foreach (var thread in threads)
            thread.Join();
        foreach (var start in starts)
            start.Dispose();
        completion.Dispose();
        WorkerPools.Dispose();
        Volatile.Write(ref dispatching, 0);
    }

    void Dispatch(delegate*<int, IThreadDispatcher, void> function, Action<int>? action, int maximumWorkerCount,
        void* unmanagedContext, object? managedContext)
    {
        ArgumentOutOfRangeException.ThrowIfNegativeOrZero(maximumWorkerCount);
        if (Interlocked.CompareExchange(ref dispatching, 1, 0) != 0)
            throw new InvalidOperationException("The dispatcher is dispatching already: one dispatch at a time, and none from within a worker.");
        if (disposed)
        {
            Volatile.Write(ref dispatching, 0);
            throw new ObjectDisposedException(nameof(ThreadDispatcher));
        }
        functionBody = function;
        delegateBody = action;
        UnmanagedContext = unmanagedContext;
        ManagedContext = managedContext;
        var workerCount = Math.Min(maximumWorkerCount, ThreadCount);
        remainingWorkers = workerCount - 1;
        for (int i = 0; i < workerCount - 1; ++i)
            starts[i].Send();
        RunBody(0);
        if (workerCount > 1)
            completion.Wait();
        functionBody = null;
        delegateBody = null;
        UnmanagedContext = null;
        ManagedContext = null;
        var failure = TakeFailure();
        Volatile.Write(ref dispatching, 0);
        if (failure != null)
            ExceptionDispatchInfo.Throw(failure);
    }

    void RunWorkerThread(int workerIndex)
    {
        var start = starts[workerIndex - 1];
        while (true)
        {
            start.Wait();
            if (stopping)
                return;
            RunBody(workerIndex);
            if (Interlocked.Decrement(ref remainingWorkers) == 0)
                completion.Send();
        }
    }

    void RunBody(int workerIndex)
    {
#pragma warning disable CA1031 // Whatever it is, it belongs to the caller of the dispatch: it is thrown there.
        try
        {
            if (functionBody != null)
                functionBody(workerIndex, this);
            else
                delegateBody!(workerIndex);
        }
        catch (Exception exception)
        {
            failures[workerIndex] = exception;
        }
#pragma warning restore CA1031
    }

    /// <summary>The one exception of the workers as it is, or several together in the order of the workers.</summary>
    Exception? TakeFailure()
    {
        Exception? first = null;
        var count = 0;
        foreach (var failure in failures)
        {
            if (failure == null)
                continue;
            first ??= failure;
            ++count;
        }
        if (count == 0)
            return null;
        if (count > 1)
            first = new AggregateException("Several workers failed.", Array.FindAll(failures, failure => failure != null)!);
        Array.Clear(failures);
        return first;
    }
}
