using System;
using System.Linq;
using System.Threading;
using BepuUtilities;
using Xunit;

namespace DemoTests.Utilities;

public unsafe class ThreadDispatcherTests
{
    [Theory]
    [InlineData(1)]
    [InlineData(2)]
    [InlineData(3)]
    [InlineData(8)]
    public void EachWorkerRunsOnceInEachOfManyDispatches(int threadCount)
    {
        using var dispatcher = new ThreadDispatcher(threadCount);
        Assert.Equal(threadCount, dispatcher.ThreadCount);
        Assert.Equal(threadCount, dispatcher.WorkerPools.WorkerCount);
        var runs = new int[threadCount];
        for (int dispatch = 1; dispatch <= 2000; ++dispatch)
        {
            var limit = dispatch % 3 == 0 ? int.MaxValue : dispatch % (threadCount + 2) + 1;
            Array.Clear(runs);
            dispatcher.DispatchWorkers(worker => Interlocked.Increment(ref runs[worker]), limit);
            Assert.Equal(Enumerable.Range(0, threadCount).Select(worker => worker < limit ? 1 : 0), runs);
        }
    }

    [Fact]
    public void WorkerZeroIsTheCallerAndWorkersRunAtTheSameTime()
    {
        using var dispatcher = new ThreadDispatcher(4);
        var caller = Environment.CurrentManagedThreadId;
        var ids = new int[4];
        using var barrier = new Barrier(4);
        dispatcher.DispatchWorkers(worker =>
        {
            ids[worker] = Environment.CurrentManagedThreadId;
            Assert.True(barrier.SignalAndWait(TimeSpan.FromSeconds(30)));
        });
        Assert.Equal(caller, ids[0]);
        Assert.Equal(4, ids.Distinct().Count());
    }

    [Fact]
    public void ContextsAreThereDuringTheDispatchOnly()
    {
        using var dispatcher = new ThreadDispatcher(3);
        var sums = stackalloc int[3];
        var managed = new object();
        dispatcher.DispatchWorkers(&WriteContext, int.MaxValue, sums, managed);
        Assert.Equal([100, 101, 102], new Span<int>(sums, 3).ToArray());
        Assert.True(dispatcher.UnmanagedContext == null);
        Assert.Null(dispatcher.ManagedContext);
    }

    static void WriteContext(int worker, IThreadDispatcher dispatcher) =>
        ((int*)dispatcher.UnmanagedContext)[worker] = dispatcher.ManagedContext == null ? -1 : 100 + worker;

    [Theory]
    [InlineData(0)]
    [InlineData(2)]
    public void AnExceptionReachesTheCallerAfterAllWorkersHaveEnded(int failing)
    {
        using var dispatcher = new ThreadDispatcher(4);
        for (int repeat = 0; repeat < 50; ++repeat)
        {
            var ended = 0;
            var exception = Assert.Throws<FormatException>(() => dispatcher.DispatchWorkers(worker =>
            {
                if (worker == failing)
                    throw new FormatException("the message");
                Thread.Sleep(repeat < 3 ? 20 : 0);
                Interlocked.Increment(ref ended);
            }));
            Assert.Equal("the message", exception.Message);
            Assert.Equal(3, ended);
            var runs = 0;
            dispatcher.DispatchWorkers(_ => Interlocked.Increment(ref runs));
            Assert.Equal(4, runs);
        }
    }

    [Fact]
    public void SeveralExceptionsComeTogetherInTheOrderOfTheWorkers()
    {
        using var dispatcher = new ThreadDispatcher(4);
        var exception = Assert.Throws<AggregateException>(() => dispatcher.DispatchWorkers(worker =>
        {
            if (worker > 0)
                throw new FormatException($"{worker}");
        }));
        Assert.Equal(["1", "2", "3"], exception.InnerExceptions.Select(inner => inner.Message));
    }

    [Fact]
    public void BadCallsAreRefused()
    {
        Assert.Throws<ArgumentOutOfRangeException>(() => new ThreadDispatcher(0));
        Assert.Throws<ArgumentOutOfRangeException>(() => new ThreadDispatcher(-3));
        using var dispatcher = new ThreadDispatcher(2);
        Assert.Throws<ArgumentOutOfRangeException>(() => dispatcher.DispatchWorkers(_ => { }, 0));
        Assert.Throws<ArgumentNullException>(() => dispatcher.DispatchWorkers((Action<int>)null!));
        Assert.Throws<ArgumentNullException>(() => dispatcher.DispatchWorkers((delegate*<int, IThreadDispatcher, void>)null));
        var failure = Assert.Throws<InvalidOperationException>(
            () => dispatcher.DispatchWorkers(_ => dispatcher.DispatchWorkers(_ => { }), maximumWorkerCount: 1));
        Assert.Contains("one dispatch at a time", failure.Message, StringComparison.Ordinal);
        Assert.Throws<InvalidOperationException>(() => dispatcher.DispatchWorkers(_ => dispatcher.Dispose(), maximumWorkerCount: 1));
        var runs = 0;
        dispatcher.DispatchWorkers(_ => Interlocked.Increment(ref runs));
        Assert.Equal(2, runs);
    }

    [Fact]
    public void DisposeEndsTheThreadsAndMayBeRepeated()
    {
        var dispatcher = new ThreadDispatcher(4);
        var threads = new Thread[4];
        dispatcher.DispatchWorkers(worker => threads[worker] = Thread.CurrentThread);
        dispatcher.WorkerPools[1].Take(10, out BepuUtilities.Memory.Buffer<int> _);
        dispatcher.Dispose();
        dispatcher.Dispose();
        Assert.All(threads.Skip(1), thread => Assert.False(thread.IsAlive));
        Assert.Equal(0ul, dispatcher.WorkerPools.GetTotalAllocatedByteCount());
        Assert.Throws<ObjectDisposedException>(() => dispatcher.DispatchWorkers(_ => { }));
        // Right after the start, and while workers are parked.
        new ThreadDispatcher(8).Dispose();
        var parked = new ThreadDispatcher(8);
        Thread.Sleep(20);
        parked.Dispose();
    }

    [Fact]
    public void ParkedWorkersWake()
    {
        using var dispatcher = new ThreadDispatcher(3);
        for (int i = 0; i < 20; ++i)
        {
            var runs = 0;
            dispatcher.DispatchWorkers(_ => Interlocked.Increment(ref runs));
            Assert.Equal(3, runs);
            Thread.Sleep(2);
        }
    }

    [Fact]
    public void ADispatchAllocatesNothing()
    {
        using var dispatcher = new ThreadDispatcher(4);
        var allocated = stackalloc long[4];
        for (int i = 0; i < 20; ++i)
            dispatcher.DispatchWorkers(&NoteAllocations, int.MaxValue, allocated);
        // What the threads of the other workers had allocated by the last dispatch of the warm-up, and by the last of all.
        var others = (allocated[1], allocated[2], allocated[3]);
        var start = GC.GetAllocatedBytesForCurrentThread();
        for (int i = 0; i < 500; ++i)
            dispatcher.DispatchWorkers(&NoteAllocations, int.MaxValue, allocated);
        Assert.Equal(0, GC.GetAllocatedBytesForCurrentThread() - start);
        Assert.Equal(others, (allocated[1], allocated[2], allocated[3]));
    }

    static void NoteAllocations(int worker, IThreadDispatcher dispatcher) =>
        ((long*)dispatcher.UnmanagedContext)[worker] = GC.GetAllocatedBytesForCurrentThread();
}
