using System;
using System.Collections.Generic;
using System.Linq;
using System.Threading;
using BepuUtilities;
using BepuUtilities.Memory;
using BepuUtilities.TaskScheduling;
using Xunit;

namespace DemoTests.Utilities;

public unsafe class StagedWorkTests
{
    /// <summary>Counts runs of each block, and looks in each whether all blocks of all stages before have ended.</summary>
    struct RecordingWork : IStagedWork
    {
        public int[] BlockCounts;
        public int[][] Runs;
        public int[] EndedBlocks;
        public int[] Sizings;
        public int Violations;
        public int WorkerLimit;
        public Action<int, int>? InBlock;

        public RecordingWork(params int[] blockCounts)
        {
            BlockCounts = blockCounts;
            Runs = [.. blockCounts.Select(count => new int[count])];
            EndedBlocks = new int[blockCounts.Length];
            Sizings = new int[blockCounts.Length];
            WorkerLimit = int.MaxValue;
        }

        public readonly int StageCount => BlockCounts.Length;

        public int GetBlockCount(int stage)
        {
            ++Sizings[stage];
            RequireEndOfStagesBefore(stage);
            return BlockCounts[stage];
        }

        public void Execute(int stage, int block, int workerIndex)
        {
            RequireEndOfStagesBefore(stage);
            if (workerIndex < 0 || workerIndex >= WorkerLimit)
                Interlocked.Increment(ref Violations);
            Interlocked.Increment(ref Runs[stage][block]);
            InBlock?.Invoke(stage, block);
            Interlocked.Increment(ref EndedBlocks[stage]);
        }

        void RequireEndOfStagesBefore(int stage)
        {
            for (int before = 0; before < stage; ++before)
            {
                if (Volatile.Read(ref EndedBlocks[before]) != BlockCounts[before])
                    Interlocked.Increment(ref Violations);
            }
        }

        public readonly void RequireDone()
        {
            Assert.Equal(0, Violations);
            Assert.All(Runs, stage => Assert.All(stage, runs => Assert.Equal(1, runs)));
            Assert.All(Sizings, calls => Assert.Equal(1, calls));
        }
    }

    static readonly int[][] shapes =
    [
        [], [0], [1], [5], [1, 1, 1], [0, 0, 3, 0], [1, 7, 1, 100, 0, 2], [64, 1, 64, 1, 64], [3, 0, 0, 0, 3], [1000, 1000],
    ];

    [Theory]
    [InlineData(1)]
    [InlineData(2)]
    [InlineData(3)]
    [InlineData(5)]
    [InlineData(8)]
    public void EachBlockRunsOnceAndStagesKeepTheirOrder(int threadCount)
    {
        using var dispatcher = new ThreadDispatcher(threadCount);
        for (int repeat = 0; repeat < 40; ++repeat)
        {
            foreach (var shape in shapes)
            {
                var work = new RecordingWork(shape) { WorkerLimit = threadCount };
                StagedWork.Run(ref work, dispatcher);
                work.RequireDone();
            }
        }
    }

    [Fact]
    public void ManyTinyStagesKeepTheirOrder()
    {
        using var dispatcher = new ThreadDispatcher(4);
        var work = new RecordingWork([.. Enumerable.Range(0, 2000).Select(stage => stage * 7 % 9)]);
        StagedWork.Run(ref work, dispatcher);
        work.RequireDone();
    }

    [Fact]
    public void WithoutDispatcherTheCallerDoesItInOrder()
    {
        var caller = Environment.CurrentManagedThreadId;
        var last = -1;
        var work = new RecordingWork(3, 0, 10)
        {
            WorkerLimit = 1,
            InBlock = (stage, block) =>
            {
                Assert.Equal(caller, Environment.CurrentManagedThreadId);
                Assert.True(stage * 100 + block > last);
                last = stage * 100 + block;
            },
        };
        StagedWork.Run(ref work, null);
        work.RequireDone();
    }

    [Fact]
    public void WhatNeedsNoOthersIsNotDispatched()
    {
        var strange = new StrangeDispatcher(4, 0);
        var single = new RecordingWork(1, 0, 1, 1);
        StagedWork.Run(ref single, strange);
        single.RequireDone();
        var limited = new RecordingWork(10, 10);
        StagedWork.Run(ref limited, strange, 1);
        limited.RequireDone();
        Assert.Equal(0, strange.DispatchCount);
    }

    /// <summary>Whoever watches does all of it, and is told of each stage that has blocks, but for those that need nobody.</summary>
    [Fact]
    public void AnObserverIsToldOfEachStage()
    {
        var observer = new Observer(3);
        var work = new RecordingWork(1, 0, 4, 0, 1, 2) { WorkerLimit = 3 };
        StagedWork.Run(ref work, observer);
        work.RequireDone();
        Assert.Equal([4, 1, 2], observer.BlockCounts);
        Assert.All(observer.Times, times => Assert.InRange(times.Longest, 0, times.All));
    }

    sealed class Observer(int threadCount) : IStagedWorkObserver
    {
        public List<int> BlockCounts { get; } = [];
        public List<(long All, long Longest)> Times { get; } = [];
        public int ThreadCount => threadCount;
        public void* UnmanagedContext => null;
        public object? ManagedContext => null;
        public WorkerBufferPools WorkerPools => throw new NotSupportedException();

        public void StageEnded(int blockCount, long ticks, long longestBlockTicks)
        {
            BlockCounts.Add(blockCount);
            Times.Add((ticks, longestBlockTicks));
        }

        public void DispatchWorkers(delegate*<int, IThreadDispatcher, void> workerBody, int maximumWorkerCount, void* unmanagedContext,
            object? managedContext) => throw new NotSupportedException();

        public void DispatchWorkers(Action<int> workerBody, int maximumWorkerCount, void* unmanagedContext, object? managedContext) =>
            throw new NotSupportedException();
    }

    /// <summary>A dispatcher that runs its workers one after another, forwards, backwards, some, or none: the work gets done all the same.</summary>
    [Fact]
    public void DispatchersNeedNotRunWorkersTogether()
    {
        int[][] orders = [[0, 1, 2, 3], [3, 2, 1, 0], [2], []];
        foreach (var order in orders)
        {
            var dispatcher = new StrangeDispatcher(4, order);
            foreach (var shape in shapes)
            {
                var work = new RecordingWork(shape) { WorkerLimit = 4 };
                StagedWork.Run(ref work, dispatcher);
                work.RequireDone();
            }
        }
    }

    [Fact]
    public void MoreWorkersThanSectionsShareThem()
    {
        var dispatcher = new StrangeDispatcher(200, [.. Enumerable.Range(0, 200).Reverse()]);
        var work = new RecordingWork(500, 3, 500) { WorkerLimit = 200 };
        StagedWork.Run(ref work, dispatcher);
        work.RequireDone();
    }

    /// <summary>Claims alone, with nothing between them: a claim that is not atomic gives some block twice.</summary>
    [Fact]
    public void ABlockIsClaimedOnceHoweverManyWantIt()
    {
        const int blockCount = 2_000_000;
        using var dispatcher = new ThreadDispatcher(4);
        using var start = new Barrier(4);
        var section = new StagedSection[1];
        var claims = new int[blockCount];
        for (int stage = 0; stage < 8; ++stage)
        {
            section[0].Open(stage, 10, blockCount);
            dispatcher.DispatchWorkers(_ =>
            {
                start.SignalAndWait();
                Assert.False(section[0].TryClaim(stage + 1, out int _));
                while (section[0].TryClaim(stage, out var block))
                    Interlocked.Increment(ref claims[block]);
            });
            Assert.Equal(-1, claims.AsSpan(0, 10).IndexOfAnyExcept(0));
            Assert.Equal(-1, claims.AsSpan(10).IndexOfAnyExcept(stage + 1));
        }
    }

    [Theory]
    [InlineData(0)]
    [InlineData(2)]
    public void AnExceptionEndsTheWorkAndReachesTheCaller(int failingStage)
    {
        using var dispatcher = new ThreadDispatcher(4);
        for (int repeat = 0; repeat < 50; ++repeat)
        {
            var running = 0;
            var work = new RecordingWork(20, 20, 20, 20)
            {
                InBlock = (stage, block) =>
                {
                    Interlocked.Increment(ref running);
                    try
                    {
                        if (stage == failingStage && block == 13)
                            throw new FormatException("the message");
                        Thread.Yield();
                    }
                    finally
                    {
                        Interlocked.Decrement(ref running);
                    }
                },
            };
            Assert.Equal("the message", Assert.Throws<FormatException>(() => StagedWork.Run(ref work, dispatcher)).Message);
            Assert.Equal(0, running);
            Assert.All(work.Runs.Skip(failingStage + 1), stage => Assert.All(stage, runs => Assert.Equal(0, runs)));
            Assert.All(work.Runs, stage => Assert.All(stage, runs => Assert.InRange(runs, 0, 1)));
            // The dispatcher is as good as before.
            var next = new RecordingWork(20, 20);
            StagedWork.Run(ref next, dispatcher);
            next.RequireDone();
        }
    }

    [Fact]
    public void BadArgumentsAreRefused()
    {
        var work = new RecordingWork(1);
        Assert.Throws<ArgumentOutOfRangeException>(() => StagedWork.Run(ref work, null, 0));
        var negative = new RecordingWork(1) { BlockCounts = [-1] };
        Assert.Throws<InvalidOperationException>(() => StagedWork.Run(ref negative, null));
        using var dispatcher = new ThreadDispatcher(2);
        var negativeLater = new RecordingWork(5, 1) { BlockCounts = [5, -1] };
        Assert.Throws<InvalidOperationException>(() => StagedWork.Run(ref negativeLater, dispatcher));
    }

    /// <summary>Each stage is as long as the sum of the one before: what a stage wrote is seen by the sizing and the blocks of the next.</summary>
    struct ChainWork : IStagedWork
    {
        public int[] Sums;
        public readonly int StageCount => Sums.Length;
        public readonly int GetBlockCount(int stage) => stage == 0 ? 3 : Sums[stage - 1] % 100;
        public readonly void Execute(int stage, int block, int workerIndex) =>
            Interlocked.Add(ref Sums[stage], stage == 0 ? 10 : block + Sums[stage - 1] % 7);
    }

    [Fact]
    public void AStageMaySizeTheNext()
    {
        var alone = new ChainWork { Sums = new int[50] };
        StagedWork.Run(ref alone, null);
        using var dispatcher = new ThreadDispatcher(4);
        var together = new ChainWork { Sums = new int[50] };
        StagedWork.Run(ref together, dispatcher);
        Assert.Equal(alone.Sums, together.Sums);
    }

    struct CountingWork : IStagedWork
    {
        public long Count;
        public readonly int StageCount => 4;
        public readonly int GetBlockCount(int stage) => 16;
        public void Execute(int stage, int block, int workerIndex) => Interlocked.Increment(ref Count);
    }

    sealed class Holder
    {
        public CountingWork Work;
    }

    [Fact]
    public void ARunAllocatesNothing()
    {
        using var dispatcher = new ThreadDispatcher(4);
        var holder = new Holder();
        for (int i = 0; i < 20; ++i)
            StagedWork.Run(ref holder.Work, dispatcher);
        var before = GC.GetAllocatedBytesForCurrentThread();
        for (int i = 0; i < 500; ++i)
            StagedWork.Run(ref holder.Work, dispatcher);
        Assert.Equal(0, GC.GetAllocatedBytesForCurrentThread() - before);
        Assert.Equal(520 * 64, holder.Work.Count);
    }

    [Fact]
    public void WorkInAnObjectStaysInPlaceWhileTheCollectorMovesOthers()
    {
        using var dispatcher = new ThreadDispatcher(3);
        for (int i = 0; i < 30; ++i)
        {
            var before = new byte[1000];
            var holder = new Holder();
            GC.KeepAlive(before);
            var collector = new Thread(() => GC.Collect(0, GCCollectionMode.Forced, true, true));
            collector.Start();
            StagedWork.Run(ref holder.Work, dispatcher);
            collector.Join();
            Assert.Equal(64, holder.Work.Count);
        }
    }

    /// <summary>Runs the given workers one after another on the caller.</summary>
    sealed class StrangeDispatcher(int threadCount, params int[] order) : IThreadDispatcher
    {
        public int DispatchCount { get; private set; }
        public int ThreadCount => threadCount;
        public void* UnmanagedContext { get; private set; }
        public object? ManagedContext => null;
        public WorkerBufferPools WorkerPools => throw new NotSupportedException();

        public void DispatchWorkers(delegate*<int, IThreadDispatcher, void> workerBody, int maximumWorkerCount, void* unmanagedContext, object? managedContext)
        {
            ++DispatchCount;
            UnmanagedContext = unmanagedContext;
            foreach (var worker in order)
                workerBody(worker, this);
        }

        public void DispatchWorkers(Action<int> workerBody, int maximumWorkerCount, void* unmanagedContext, object? managedContext) =>
            throw new NotSupportedException();
    }
}
