using System;
using System.Diagnostics;
using System.Runtime.CompilerServices;
using System.Runtime.ExceptionServices;
using BepuUtilities.Diagnostics;

namespace BepuUtilities.TaskScheduling;

/// <summary>Runs staged work on the workers of a dispatcher, in one dispatch for all stages. It allocates nothing.</summary>
/// <remarks>
/// Each stage's blocks are divided into as many sections as there are workers. A worker begins with its own section, the same part
/// of every stage, so that it finds in its cache what it wrote in the stage before; then it takes what is left of the others'.
/// Which worker does a block is up to chance, so blocks must not care.
/// <para>
/// The worker that ends the last block of a stage opens the next one. Nobody waits for a worker to arrive: a worker waits only for
/// blocks that others have claimed, and those are running. So the work gets done by however many workers the dispatcher provides,
/// at the same time or one after another, down to none at all, since the caller looks after the dispatch whether something is left.
/// </para>
/// </remarks>
public static unsafe class StagedWork
{
    // More sections would only make the way around them longer; workers beyond that share sections.
    const int MaximumSectionCount = 64;

    /// <summary>Does all stages of a work and returns when they have ended.</summary>
    /// <param name="work">The work; all workers use this very variable.</param>
    /// <param name="dispatcher">Provides the workers; null to do everything on the caller.</param>
    /// <param name="maximumWorkerCount">Most workers to use, at least one.</param>
    /// <remarks>An exception from a block ends the work: blocks that run are ended, no others are begun, and the first one is thrown here.</remarks>
    public static void Run<TWork>(ref TWork work, IThreadDispatcher? dispatcher, int maximumWorkerCount = int.MaxValue)
        where TWork : struct, IStagedWork
    {
        ArgumentOutOfRangeException.ThrowIfNegativeOrZero(maximumWorkerCount);
        var workerCount = dispatcher == null ? 1 : Math.Min(dispatcher.ThreadCount, maximumWorkerCount);
        var stageCount = work.StageCount;
        // Leading stages without anything to share stay on the caller, and often there are no others.
        var stage = 0;
        var blockCount = 0;
        for (; stage < stageCount; ++stage)
        {
            blockCount = StagedRun<TWork>.GetBlockCount(ref work, stage);
            if (workerCount > 1 && blockCount > 1)
                break;
            for (int block = 0; block < blockCount; ++block)
                work.Execute(stage, block, 0);
        }
        if (stage == stageCount)
            return;
        if (dispatcher is IStagedWorkObserver observer)
            RunObserved(ref work, observer, stage, stageCount, blockCount);
        else
            Dispatch(ref work, dispatcher!, workerCount, stage, stageCount, blockCount);
    }

    static void RunObserved<TWork>(ref TWork work, IStagedWorkObserver observer, int stage, int stageCount, int blockCount)
        where TWork : struct, IStagedWork
    {
        while (true)
        {
            long longest = 0;
            var start = Stopwatch.GetTimestamp();
            var last = start;
            for (int block = 0; block < blockCount; ++block)
            {
                // Each worker's memory gets its share, as it would with as many threads.
                work.Execute(stage, block, block % observer.ThreadCount);
                var now = Stopwatch.GetTimestamp();
                longest = Math.Max(longest, now - last);
                last = now;
            }
            if (blockCount > 0)
                observer.StageEnded(blockCount, last - start, longest);
            if (++stage == stageCount)
                return;
            blockCount = StagedRun<TWork>.GetBlockCount(ref work, stage);
        }
    }

    /// <summary>Compiles what <see cref="Run"/> needs for a kind of work.</summary>
    public static void Compile<TWork>() where TWork : struct, IStagedWork
    {
        foreach (var name in (ReadOnlySpan<string>)[nameof(Run), nameof(Dispatch), nameof(RunWorker)])
            Precompilation.Compile(typeof(StagedWork), name, typeof(TWork));
        Precompilation.Compile(typeof(StagedRun<TWork>));
        Precompilation.Compile(typeof(TWork));
    }

    static void Dispatch<TWork>(ref TWork work, IThreadDispatcher dispatcher, int workerCount, int stage, int stageCount, int blockCount)
        where TWork : struct, IStagedWork
    {
        var sectionCount = Math.Min(workerCount, MaximumSectionCount);
        // One more than there are, to move the first to the start of a cache line.
        var memory = stackalloc StagedSection[sectionCount + 1];
        var sections = (StagedSection*)(((nuint)memory + StagedSection.Size - 1) / StagedSection.Size * StagedSection.Size);
        // The work may be a field of an object, which the collector must not move while other threads hold its address.
        fixed (byte* pinnedWork = &Unsafe.As<TWork, byte>(ref work))
        {
            var run = new StagedRun<TWork>(pinnedWork, sections, sectionCount, stageCount);
            run.Open(stage, blockCount);
            dispatcher.DispatchWorkers(&RunWorker<TWork>, workerCount, Unsafe.AsPointer(ref run));
            // For a dispatcher that ran no worker; otherwise there is nothing left.
            run.RunWorker(0);
            if (run.Failure != null)
                ExceptionDispatchInfo.Throw(run.Failure);
        }
    }

    static void RunWorker<TWork>(int workerIndex, IThreadDispatcher dispatcher) where TWork : struct, IStagedWork =>
        Unsafe.AsRef<StagedRun<TWork>>(dispatcher.UnmanagedContext).RunWorker(workerIndex);
}
