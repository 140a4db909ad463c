using System;
using BepuUtilities;
using BepuUtilities.Memory;
using BepuUtilities.TaskScheduling;

namespace Demos.Stages;

/// <summary>Claims to have many threads, does everything on the caller, and reports the stages of what it is given.</summary>
sealed unsafe class ObservingDispatcher(int threadCount, Action<int, long, long> stageEnded) : IStagedWorkObserver, IDisposable
{
    public int ThreadCount => threadCount;

    public void* UnmanagedContext { get; private set; }

    public object? ManagedContext { get; private set; }

    public WorkerBufferPools WorkerPools { get; } = new(threadCount);

    public void StageEnded(int blockCount, long ticks, long longestBlockTicks) => stageEnded(blockCount, ticks, longestBlockTicks);

    public void DispatchWorkers(delegate*<int, IThreadDispatcher, void> workerBody, int maximumWorkerCount = int.MaxValue,
        void* unmanagedContext = null, object? managedContext = null)
    {
        Begin(unmanagedContext, managedContext);
        workerBody(0, this);
        Begin(null, null);
    }

    public void DispatchWorkers(Action<int> workerBody, int maximumWorkerCount = int.MaxValue, void* unmanagedContext = null, object? managedContext = null)
    {
        Begin(unmanagedContext, managedContext);
        workerBody(0);
        Begin(null, null);
    }

    void Begin(void* unmanagedContext, object? managedContext)
    {
        UnmanagedContext = unmanagedContext;
        ManagedContext = managedContext;
    }

    public void Dispose() => WorkerPools.Dispose();
}
