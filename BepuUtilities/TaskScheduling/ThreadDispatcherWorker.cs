namespace BepuUtilities;

/// <summary>What a worker of a dispatch does.</summary>
/// <param name="workerIndex">Index of the worker, in [0, number of workers of the dispatch).</param>
/// <param name="context">Context that was handed to the dispatch.</param>
public unsafe delegate void ThreadDispatcherWorker(int workerIndex, void* context);
