using System;
using System.Threading;
using BepuUtilities;
using BepuUtilities.Memory;
using BepuUtilities.TaskScheduling;
using Xunit;

namespace DemoTests.Utilities;

/// <summary>Where memory comes from and goes to.</summary>
public unsafe class TaskStackMemoryTests
{
    struct Shared
    {
        public TaskStack* Stack;
        public int Count;
    }

    static void Count(long id, void* context, int workerIndex, IThreadDispatcher dispatcher) => Interlocked.Increment(ref ((Shared*)context)->Count);

    static void Work(long id, void* context, int workerIndex, IThreadDispatcher dispatcher)
    {
        var shared = (Shared*)context;
        shared->Stack->For(&Inner, context, 0, 50, workerIndex, dispatcher);
    }

    static void Inner(long id, void* context, int workerIndex, IThreadDispatcher dispatcher)
    {
        var shared = (Shared*)context;
        Span<Task> tasks = [new(&Count, context), new(&Count, context), new(&Count, context), new(&Count, context), new(&Count, context)];
        if (id % 2 == 0)
            shared->Stack->RunTasks(tasks, workerIndex, dispatcher);
        else
            shared->Stack->WaitForCompletion(shared->Stack->AllocateContinuationAndPush(tasks, workerIndex, dispatcher), workerIndex, dispatcher);
    }

    [Fact]
    public void MemoryOfAPushComesFromThePoolOfItsWorkerAndGoesBackAtAReset()
    {
        using var pool = new BufferPool();
        using var dispatcher = new ThreadDispatcher(3);
        var stack = new TaskStack(pool, dispatcher, 3);
        dispatcher.WorkerPools.AssertEmpty();
        stack.Push(new Task(&Count), 1, dispatcher);
        dispatcher.WorkerPools[0].AssertEmpty();
        dispatcher.WorkerPools[2].AssertEmpty();
        Assert.Throws<InvalidOperationException>(dispatcher.WorkerPools[1].AssertEmpty);
        stack.AllocateContinuation(1, 2, dispatcher);
        Assert.Throws<InvalidOperationException>(dispatcher.WorkerPools[2].AssertEmpty);
        stack.Reset(dispatcher);
        dispatcher.WorkerPools.AssertEmpty();
        Assert.Equal((0, 0), (stack.ApproximateTaskCount, stack.ApproximateContinuationCount));
        Assert.Equal(PopTaskResult.Empty, stack.TryPop(out _));
        stack.PushFor(&Count, null, 0, 10, 2, dispatcher);
        Assert.Throws<InvalidOperationException>(pool.AssertEmpty);
        stack.Dispose(pool, dispatcher);
        pool.AssertEmpty();
        dispatcher.WorkerPools.AssertEmpty();
    }

    [Theory]
    [InlineData(1, 1)]
    [InlineData(3, 100)]
    [InlineData(1000, 2)]
    public void MemoryGrowsAsNeeded(int jobCapacity, int continuationCapacity)
    {
        using var world = new TaskStackWorld(1, jobCapacity, continuationCapacity);
        var shared = new Shared { Stack = world.Stack };
        var tasks = new Task[70_001];
        for (int repeat = 0; repeat < 3; ++repeat)
        {
            shared.Count = 0;
            var expected = 0;
            foreach (var length in new[] { 1, 2, 3, 700, tasks.Length, 5 })
            {
                tasks.AsSpan().Fill(new Task(&Count, &shared));
                // Copied at once: what becomes of the caller's span does not matter.
                world.Stack->Push(tasks.AsSpan(0, length), 0, world.Dispatcher);
                tasks.AsSpan().Fill(new Task(&Fail));
                expected += length;
            }
            for (int i = 0; i < 3000; ++i)
                world.Stack->AllocateContinuationAndPush(new Task(&Count, &shared), 0, world.Dispatcher);
            expected += 3000;
            Assert.Equal(expected, world.Stack->ApproximateTaskCount);
            while (world.Stack->TryPopAndRun(0, world.Dispatcher) == PopTaskResult.Success) ;
            Assert.Equal((expected, 0), (shared.Count, world.Stack->ApproximateContinuationCount));
            world.Reset();
            world.Dispatcher.WorkerPools.AssertEmpty();
        }
    }

    static void Fail(long id, void* context, int workerIndex, IThreadDispatcher dispatcher) => throw new InvalidOperationException();

    [Fact]
    public void ALoopTakesNoMoreMemoryThanItsLength()
    {
        using var world = new TaskStackWorld(1);
        world.Stack->PushFor(&Fail, null, 0, int.MaxValue - 1, 0, world.Dispatcher);
        Assert.Equal(int.MaxValue - 1, world.Stack->ApproximateTaskCount);
        world.Stack->PushFor(&Fail, null, 0, int.MaxValue - 1, 0, world.Dispatcher);
        Assert.Equal(int.MaxValue, world.Stack->ApproximateTaskCount);
        Assert.InRange(world.Dispatcher.WorkerPools.GetTotalAllocatedByteCount(), 1ul, 1ul << 20);
    }

    [Fact]
    public void ResetsKeepMemoryBounded()
    {
        using var world = new TaskStackWorld(2, 1, 1);
        var shared = new Shared { Stack = world.Stack };
        // A worker may have pushed nothing in the first rounds, and everything in a later one.
        for (int repeat = 0; repeat < 200; ++repeat)
        {
            world.Run(&Work, &shared);
            world.Reset();
        }
        Assert.Equal(200 * 250, shared.Count);
        // A round takes less than 100 jobs and continuations and 250 tasks: below 32 kilobytes, whoever pushes them, several times that in blocks.
        Assert.InRange(world.Dispatcher.WorkerPools.GetTotalAllocatedByteCount(), 1ul, 1ul << 20);
    }

    [Fact]
    public void CopiesAreTheSameStack()
    {
        using var world = new TaskStackWorld(1);
        var copy = *world.Stack;
        copy.Push(new Task(&Count), 0, world.Dispatcher);
        Assert.Equal(1, world.Stack->ApproximateTaskCount);
        world.Stack->RequestStop();
        Assert.Equal(PopTaskResult.Stop, copy.TryPop(out _));
    }

    [Fact]
    public void NothingIsAllocatedOnTheManagedHeap()
    {
        using var world = new TaskStackWorld(3);
        var shared = new Shared { Stack = world.Stack };
        var allocated = new long[3];
        for (int repeat = 0; repeat < 100; ++repeat)
        {
            // The pools' own bookkeeping has grown by then.
            if (repeat == 50)
            {
                Array.Clear(allocated);
                for (int i = 0; i < 3; ++i)
                    WarmPool(world.Dispatcher.WorkerPools[i]);
            }
            world.Stack->AllocateContinuationAndPush(new Task(&Work, &shared), 0, world.Dispatcher, onComplete: TaskStack.GetRequestStopTask(world.Stack));
            world.Dispatcher.DispatchWorkers(&RunMeasured, int.MaxValue, world.Stack, allocated);
            world.Reset();
        }
        Assert.Equal([0, 0, 0], allocated);
        Assert.Equal(100 * 250, shared.Count);
    }

    static void WarmPool(BufferPool pool)
    {
        for (int power = 6; power < 18; ++power)
        {
            pool.TakeForPower(power, out var block);
            pool.Return(ref block);
        }
    }

    static void RunMeasured(int worker, IThreadDispatcher dispatcher)
    {
        var before = GC.GetAllocatedBytesForCurrentThread();
        TaskStack.DispatchWorkerFunction(worker, dispatcher);
        ((long[])dispatcher.ManagedContext!)[worker] += GC.GetAllocatedBytesForCurrentThread() - before;
    }
}
