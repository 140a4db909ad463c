using System;

namespace BepuUtilities.Memory;

/// <summary>A pool for each worker of a dispatcher. A pool may be used by one thread at a time; different pools by different threads.</summary>
public sealed class WorkerBufferPools : IDisposable
{
    BufferPool[] pools = [];

    /// <summary>Creates a pool for each of a number of workers.</summary>
    /// <param name="initialWorkerCount">Number of workers.</param>
    /// <param name="defaultBlockCapacity">Least number of bytes that a pool asks the system for at a time.</param>
    public WorkerBufferPools(int initialWorkerCount, int defaultBlockCapacity = 16384)
    {
        ArgumentOutOfRangeException.ThrowIfNegative(initialWorkerCount);
        ArgumentOutOfRangeException.ThrowIfNegativeOrZero(defaultBlockCapacity);
        DefaultBlockCapacity = defaultBlockCapacity;
        Resize(initialWorkerCount);
    }

    /// <summary>Least number of bytes that a pool asks the system for at a time.</summary>
    public int DefaultBlockCapacity { get; }

    /// <summary>Number of workers that have a pool.</summary>
    public int WorkerCount => pools.Length;

    /// <summary>Pool of a worker.</summary>
    public BufferPool this[int workerIndex] => pools[workerIndex];

    /// <summary>Changes the number of pools. Pools that go give their memory back to the system. Not while workers run.</summary>
    public void Resize(int workerCount)
    {
        ArgumentOutOfRangeException.ThrowIfNegative(workerCount);
        CheckNotBusy();
        for (int i = workerCount; i < pools.Length; ++i)
            pools[i].Clear();
        var oldCount = pools.Length;
        Array.Resize(ref pools, workerCount);
        for (int i = oldCount; i < workerCount; ++i)
            pools[i] = new BufferPool(DefaultBlockCapacity);
    }

    /// <summary>Bytes that the pools hold from the system, whether lent or not.</summary>
    public ulong GetTotalAllocatedByteCount()
    {
        ulong total = 0;
        foreach (var pool in pools)
            total += pool.GetTotalAllocatedByteCount();
        return total;
    }

    /// <summary>Gives memory back to the system that nobody has borrowed since the last call: <see cref="BufferPool.Trim"/>. Not while workers run.</summary>
    public void Trim()
    {
        foreach (var pool in pools)
            pool.Trim();
    }

    /// <summary>For each pool: <see cref="BufferPool.EmptyIfGrown"/>. Not while workers run.</summary>
    public void EmptyIfGrown()
    {
        foreach (var pool in pools)
            pool.EmptyIfGrown();
    }

    /// <summary>Requires that all that was lent by any of the pools has been given back.</summary>
    /// <exception cref="InvalidOperationException">Something is still lent.</exception>
    public void AssertEmpty()
    {
        foreach (var pool in pools)
            pool.AssertEmpty();
    }

    /// <summary>Refuses to go on while somebody needs the memory of a pool.</summary>
    internal void CheckNotBusy()
    {
        foreach (var pool in pools)
            pool.CheckNotBusy();
    }

    /// <summary>Gives all memory of all pools back to the system. The pools may be used again.</summary>
    /// <exception cref="InvalidOperationException">A step is in progress that has memory in one of them; nothing was changed.</exception>
    public void Clear()
    {
        CheckNotBusy();
        foreach (var pool in pools)
            pool.Clear();
    }

    /// <summary>The same as <see cref="Clear"/>.</summary>
    public void Dispose() => Clear();
}
