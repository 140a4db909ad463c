using System;
using System.Runtime.CompilerServices;
using System.Threading;

namespace BepuUtilities.TaskScheduling;

/// <summary>What the workers of one <see cref="StagedWork"/> dispatch share. It lies on the caller's stack.</summary>
unsafe struct StagedRun<TWork> where TWork : struct, IStagedWork
{
    // A stage mostly ends within microseconds; after some tens of them the others may need this processor to get there.
    const int SpinLimit = 2000;

    readonly void* work;
    readonly StagedSection* sections;
    readonly int sectionCount;
    readonly int stageCount;
    // The stage that is open; stageCount when all have ended.
    int openStage;
    // Blocks of the open stage that have not ended.
    int remainingBlocks;
    Exception? failure;

    /// <summary>Prepares a run; the first stage is to be opened before the workers start.</summary>
    public StagedRun(void* work, StagedSection* sections, int sectionCount, int stageCount)
    {
        this = default;
        this.work = work;
        this.sections = sections;
        this.sectionCount = sectionCount;
        this.stageCount = stageCount;
    }

    /// <summary>The first exception that a worker met, if any.</summary>
    public readonly Exception? Failure => failure;

    /// <summary>Number of blocks of a stage, checked.</summary>
    public static int GetBlockCount(ref TWork work, int stage)
    {
        var blockCount = work.GetBlockCount(stage);
        return blockCount >= 0 ? blockCount : throw new InvalidOperationException($"Stage {stage} has a negative number of blocks: {blockCount}.");
    }

    /// <summary>Offers the blocks, at least one, of a stage.</summary>
    public void Open(int stage, int blockCount)
    {
        remainingBlocks = blockCount;
        for (int i = 0; i < sectionCount; ++i)
            sections[i].Open(stage, GetSectionStart(i, blockCount), GetSectionStart(i + 1, blockCount));
        // Last: who sees the stage sees its sections and its count.
        Volatile.Write(ref openStage, stage);
    }

    /// <summary>Does blocks until all stages have ended.</summary>
    public void RunWorker(int workerIndex)
    {
#pragma warning disable CA1031 // Whatever it is, it belongs to the caller of the run: it is thrown there.
        try
        {
            int stage;
            while ((stage = Volatile.Read(ref openStage)) < stageCount && Volatile.Read(ref failure) == null)
            {
                if (RunStage(stage, workerIndex))
                    OpenNext(stage);
                else
                    WaitForNext(stage);
            }
        }
        catch (Exception exception)
        {
            Interlocked.CompareExchange(ref failure, exception, null);
        }
#pragma warning restore CA1031
    }

    /// <summary>Does blocks of a stage while there are any to claim.</summary>
    /// <returns>Whether this worker ended the stage's last block.</returns>
    bool RunStage(int stage, int workerIndex)
    {
        ref var sharedWork = ref Unsafe.AsRef<TWork>(work);
        var section = workerIndex % sectionCount;
        for (int i = 0; i < sectionCount; ++i)
        {
            while (sections[section].TryClaim(stage, out var block))
            {
                sharedWork.Execute(stage, block, workerIndex);
                // The decrement is a fence both ways: whoever sees zero sees what all blocks wrote.
                if (Interlocked.Decrement(ref remainingBlocks) == 0)
                    return true;
                if (Volatile.Read(ref failure) != null)
                    return false;
            }
            section = section + 1 < sectionCount ? section + 1 : 0;
        }
        return false;
    }

    /// <summary>Opens the next stage that has blocks, or ends the run.</summary>
    void OpenNext(int stage)
    {
        while (++stage < stageCount)
        {
            var blockCount = GetBlockCount(ref Unsafe.AsRef<TWork>(work), stage);
            if (blockCount > 0)
            {
                Open(stage, blockCount);
                return;
            }
        }
        Volatile.Write(ref openStage, stageCount);
    }

    /// <summary>Waits until the blocks of a stage that others have claimed have ended.</summary>
    void WaitForNext(int stage)
    {
        for (int spins = 0; Volatile.Read(ref openStage) == stage && Volatile.Read(ref failure) == null; ++spins)
        {
            if (spins < SpinLimit)
                Thread.SpinWait(1);
            else if ((spins & 1) == 0)
                Thread.Yield();
            else
                Thread.Sleep(0);
        }
    }

    readonly int GetSectionStart(int section, int blockCount) => (int)((long)blockCount * section / sectionCount);
}
