using System;
using BepuUtilities.Memory;

namespace BepuUtilities;

/// <summary>
/// The only way by which this library uses threads, so that a game can bring its own. A dispatch calls a body once per worker,
/// concurrently or not, and returns when all calls have returned; what workers wrote is then visible to the caller. A dispatcher
/// may run fewer workers than asked for, or all of them one after another: the library's own bodies allow for that.
/// </summary>
public unsafe interface IThreadDispatcher
{
    /// <summary>Number of workers that a dispatch has when it is not limited.</summary>
    int ThreadCount { get; }

    /// <summary>Unmanaged context of the dispatch that runs now; null outside one.</summary>
    void* UnmanagedContext { get; }

    /// <summary>Managed context of the dispatch that runs now; null outside one.</summary>
    object? ManagedContext { get; }

    /// <summary>A memory pool for each worker. A worker uses its own alone.</summary>
    WorkerBufferPools WorkerPools { get; }

    /// <summary>Calls a function once per worker and returns when all calls have returned.</summary>
    /// <param name="workerBody">Function to call with the index of the worker and this dispatcher.</param>
    /// <param name="maximumWorkerCount">Most workers to run, at least one.</param>
    /// <param name="unmanagedContext">Context to be had from <see cref="UnmanagedContext"/> meanwhile.</param>
    /// <param name="managedContext">Context to be had from <see cref="ManagedContext"/> meanwhile.</param>
    void DispatchWorkers(delegate*<int, IThreadDispatcher, void> workerBody, int maximumWorkerCount = int.MaxValue,
        void* unmanagedContext = null, object? managedContext = null);

    /// <summary>Calls a delegate once per worker and returns when all calls have returned.</summary>
    /// <param name="workerBody">Delegate to call with the index of the worker.</param>
    /// <param name="maximumWorkerCount">Most workers to run, at least one.</param>
    /// <param name="unmanagedContext">Context to be had from <see cref="UnmanagedContext"/> meanwhile.</param>
    /// <param name="managedContext">Context to be had from <see cref="ManagedContext"/> meanwhile.</param>
    void DispatchWorkers(Action<int> workerBody, int maximumWorkerCount = int.MaxValue,
        void* unmanagedContext = null, object? managedContext = null);
}
