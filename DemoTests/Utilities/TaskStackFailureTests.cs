using System;
using System.Threading;
using BepuUtilities;
using BepuUtilities.Memory;
using BepuUtilities.TaskScheduling;
using Xunit;

namespace DemoTests.Utilities;

/// <summary>Stops and exceptions: nobody hangs, the caller learns of it, and no task outlives the wait for it.</summary>
public unsafe class TaskStackFailureTests
{
    struct Shared
    {
        public TaskStack* Stack;
        public int Begun;
        public int Ended;
        public int Seen;
        public int Flag;
        public long Failing;
        public ContinuationHandle Handle;
    }

    static void Throw(long id, void* context, int workerIndex, IThreadDispatcher dispatcher) => throw new FormatException($"task {id}");

    static void ThrowAtOne(long id, void* context, int workerIndex, IThreadDispatcher dispatcher)
    {
        var shared = (Shared*)context;
        if (id == shared->Failing)
            throw new FormatException($"task {id}");
        Interlocked.Increment(ref shared->Begun);
    }

    static void RunInnerLoop(long id, void* context, int workerIndex, IThreadDispatcher dispatcher) =>
        ((Shared*)context)->Stack->For(&ThrowAtOne, context, (int)id * 100, 100, workerIndex, dispatcher);

    static void RunOuterLoop(long id, void* context, int workerIndex, IThreadDispatcher dispatcher) =>
        ((Shared*)context)->Stack->For(&RunInnerLoop, context, 0, 20, workerIndex, dispatcher);

    [Theory]
    [InlineData(1)]
    [InlineData(2)]
    [InlineData(3)]
    [InlineData(8)]
    public void AnExceptionReachesTheCallerFromAnyDepthAndTheStackCanBeUsedAgain(int threadCount) => TaskStackWorld.RequireEnd(() =>
    {
        using var world = new TaskStackWorld(threadCount);
        for (int repeat = 0; repeat < 60; ++repeat)
        {
            var shared = new Shared { Stack = world.Stack, Failing = repeat * 37 % 2000 };
            var failure = Assert.Throws<FormatException>(() => RunOuter(world, ref shared));
            Assert.Equal($"task {shared.Failing}", failure.Message);
            Assert.InRange(shared.Begun, 0, 1999);
            Assert.Equal(PopTaskResult.Stop, world.Stack->TryPop(out var none));
            world.Reset();
            shared = new Shared { Stack = world.Stack, Failing = -1 };
            RunOuter(world, ref shared);
            Assert.Equal(2000, shared.Begun);
            world.Reset();
        }
    });

    static void RunOuter(TaskStackWorld world, ref Shared shared)
    {
        fixed (Shared* pointer = &shared)
            world.Run(&RunOuterLoop, pointer);
    }

    [Fact]
    public void AnExceptionWaitsForTheTasksThatStillRun() => TaskStackWorld.RequireEnd(() =>
    {
        using var world = new TaskStackWorld(3);
        for (int repeat = 0; repeat < 10; ++repeat)
        {
            var shared = new Shared { Stack = world.Stack };
            var pointer = &shared;
            Assert.Throws<FormatException>(() => world.Run(&CallLoopOfSlowAndFailing, pointer));
            Assert.Equal(2, shared.Begun);
            // What the loop's caller saw when the exception came to it.
            Assert.Equal(2, shared.Seen);
            world.Reset();
        }
    });

    static void CallLoopOfSlowAndFailing(long id, void* context, int workerIndex, IThreadDispatcher dispatcher)
    {
        var shared = (Shared*)context;
        try
        {
            shared->Stack->For(&SlowOrFailing, context, 0, 3, workerIndex, dispatcher);
        }
        catch (Exception exception) when (exception is FormatException or OperationCanceledException)
        {
            shared->Seen = Volatile.Read(ref shared->Ended);
            throw;
        }
    }

    static void SlowOrFailing(long id, void* context, int workerIndex, IThreadDispatcher dispatcher)
    {
        var shared = (Shared*)context;
        if (id == 0)
        {
            while (Volatile.Read(ref shared->Begun) < 2)
                Thread.Yield();
            throw new FormatException();
        }
        Interlocked.Increment(ref shared->Begun);
        Thread.Sleep(20);
        Interlocked.Increment(ref shared->Ended);
    }

    [Fact]
    public void WhoWaitsForWhatWillNotComeLearnsWhy() => TaskStackWorld.RequireEnd(() =>
    {
        using var world = new TaskStackWorld(2);
        var never = world.Stack->AllocateContinuation(1, 0, world.Dispatcher);
        Exception? seen = null;
        var waiting = 0;
        Assert.Throws<FormatException>(() => world.Dispatcher.DispatchWorkers(worker =>
        {
            if (worker == 1)
            {
                Volatile.Write(ref waiting, 1);
                seen = Record.Exception(() => world.Stack->WaitForCompletion(never, 1, world.Dispatcher));
                return;
            }
            while (Volatile.Read(ref waiting) == 0)
                Thread.Yield();
            world.Stack->RunTask(new Task(&Throw, null, 3), 0, world.Dispatcher);
        }));
        var canceled = Assert.IsType<OperationCanceledException>(seen);
        Assert.Equal("task 3", Assert.IsType<FormatException>(canceled.InnerException).Message);
        Assert.False(never.Completed);
    });

    [Fact]
    public void AnExceptionThatTheGameCatchesStillReachesTheCallerOfTheDispatch() => TaskStackWorld.RequireEnd(() =>
    {
        using var world = new TaskStackWorld(2);
        var shared = new Shared { Stack = world.Stack };
        var pointer = &shared;
        Assert.Throws<FormatException>(() => world.Run(&Swallow, pointer));
        Assert.Equal(1, shared.Seen);
    });

    static void Swallow(long id, void* context, int workerIndex, IThreadDispatcher dispatcher)
    {
        var shared = (Shared*)context;
        if (Record.Exception(() => shared->Stack->For(&Throw, null, 0, 4, workerIndex, dispatcher)) != null)
            shared->Seen = 1;
    }

    struct ThrowingFilter : IJobFilter
    {
        public readonly bool AllowJob(ulong jobTag) => throw new FormatException("filter");
    }

    [Fact]
    public void ExceptionsOfFiltersAndTasksAfterOthersStopTheStackToo() => TaskStackWorld.RequireEnd(() =>
    {
        using var world = new TaskStackWorld(2);
        world.Stack->AllocateContinuationAndPush(new Task(&Nothing), 0, world.Dispatcher, 0, new Task(&Throw, null, 8));
        Assert.Equal("task 8", Assert.Throws<FormatException>(() => TaskStack.DispatchWorkers(world.Dispatcher, world.Stack)).Message);
        world.Reset();
        Assert.Throws<FormatException>(() => world.Stack->AllocateContinuation(0, 0, world.Dispatcher, new Task(&Throw)));
        Assert.Equal(PopTaskResult.Stop, world.Stack->TryPopAndRun(0, world.Dispatcher));
        world.Reset();
        var filter = default(ThrowingFilter);
        var handle = world.Stack->AllocateContinuationAndPush(new Task(&Nothing), 0, world.Dispatcher);
        Assert.Throws<FormatException>(() => world.Stack->WaitForCompletion(ref filter, handle, 0, world.Dispatcher));
        Assert.Equal(PopTaskResult.Stop, world.Stack->TryPopAndRun(0, world.Dispatcher));
    });

    static void Nothing(long id, void* context, int workerIndex, IThreadDispatcher dispatcher)
    {
    }

    static void Begin(long id, void* context, int workerIndex, IThreadDispatcher dispatcher) => Interlocked.Increment(ref ((Shared*)context)->Begun);

    [Fact]
    public void AfterAStopNothingBegins() => TaskStackWorld.RequireEnd(() =>
    {
        using var world = new TaskStackWorld(2);
        var stack = world.Stack;
        var shared = new Shared { Stack = stack };
        // The newest job is the stop: the others are left.
        var handle = stack->AllocateContinuation(5, 0, world.Dispatcher, new Task(&Begin, &shared));
        stack->PushFor(&Begin, &shared, 0, 5, 0, world.Dispatcher, 0, handle);
        stack->Push(TaskStack.GetRequestStopTask(stack), 0, world.Dispatcher);
        TaskStack.DispatchWorkers(world.Dispatcher, stack, 1);
        Assert.Equal(5, stack->ApproximateTaskCount);
        Assert.Equal(PopTaskResult.Stop, stack->TryPop(out var none));
        stack->WaitForCompletion(handle, 0, world.Dispatcher);
        Assert.False(handle.Completed);
        stack->For(&Begin, &shared, 0, 10, 0, world.Dispatcher);
        stack->RunTask(new Task(&Begin, &shared), 0, world.Dispatcher);
        for (int i = 0; i < 5; ++i)
            handle.NotifyTaskCompleted(0, world.Dispatcher);
        TaskStack.DispatchWorkers(world.Dispatcher, stack);
        Assert.Equal(0, shared.Begun);
        Assert.False(handle.Completed);
        world.Reset();
        Assert.Equal(0, stack->ApproximateTaskCount);
        stack->For(&Begin, &shared, 0, 10, 0, world.Dispatcher);
        Assert.Equal(10, shared.Begun);
    });

    [Fact]
    public void AWaitThatAStopEndsLastsAsLongAsItsTasksRun() => TaskStackWorld.RequireEnd(() =>
    {
        using var world = new TaskStackWorld(2);
        for (int repeat = 0; repeat < 10; ++repeat)
        {
            var shared = new Shared { Stack = world.Stack };
            var pointer = &shared;
            shared.Handle = world.Stack->AllocateContinuation(2, 0, world.Dispatcher);
            world.Dispatcher.DispatchWorkers(worker =>
            {
                if (worker == 1)
                {
                    new Task(&StopThenLinger, pointer, 0, pointer->Handle).Run(1, world.Dispatcher);
                    return;
                }
                while (Volatile.Read(ref pointer->Begun) == 0)
                    Thread.Yield();
                world.Stack->WaitForCompletion(pointer->Handle, 0, world.Dispatcher);
                pointer->Seen = Volatile.Read(ref pointer->Ended);
            });
            Assert.Equal(1, shared.Seen);
            Assert.False(shared.Handle.Completed);
            world.Reset();
        }
    });

    static void StopThenLinger(long id, void* context, int workerIndex, IThreadDispatcher dispatcher)
    {
        var shared = (Shared*)context;
        Volatile.Write(ref shared->Begun, 1);
        shared->Stack->RequestStop();
        Thread.Sleep(10);
        Volatile.Write(ref shared->Ended, 1);
    }

    static void StopFromWithin(long id, void* context, int workerIndex, IThreadDispatcher dispatcher)
    {
        var shared = (Shared*)context;
        Interlocked.Increment(ref shared->Begun);
        if (id == shared->Failing)
            shared->Stack->RequestStop();
        Interlocked.Increment(ref shared->Ended);
    }

    static void CountLoopsThatEndEarly(long id, void* context, int workerIndex, IThreadDispatcher dispatcher)
    {
        // Memory of this method, which must not be written to after it has returned.
        var local = new Shared { Stack = ((Shared*)context)->Stack, Failing = ((Shared*)context)->Failing - id * 50 };
        local.Stack->For(&StopFromWithin, &local, 0, 50, workerIndex, dispatcher);
        if (local.Begun != local.Ended)
            Interlocked.Increment(ref ((Shared*)context)->Flag);
        local.Begun = int.MinValue;
        Thread.SpinWait(20);
        if (local.Begun != int.MinValue)
            Interlocked.Increment(ref ((Shared*)context)->Flag);
    }

    [Theory]
    [InlineData(2)]
    [InlineData(8)]
    public void StopsAtRandomMomentsLeaveNoTaskBehind(int threadCount) => TaskStackWorld.RequireEnd(() =>
    {
        using var world = new TaskStackWorld(threadCount);
        for (int repeat = 0; repeat < 300; ++repeat)
        {
            var shared = new Shared { Stack = world.Stack, Failing = repeat * 17 % 1000 };
            world.Stack->PushFor(&CountLoopsThatEndEarly, &shared, 0, 20, 0, world.Dispatcher);
            TaskStack.DispatchWorkers(world.Dispatcher, world.Stack);
            Assert.Equal(0, shared.Flag);
            world.Reset();
        }
    });

    /// <summary>Runs its workers one after another, or none.</summary>
    sealed class SerialDispatcher(int threadCount) : IThreadDispatcher
    {
        public int ThreadCount => threadCount;
        public void* UnmanagedContext { get; private set; }
        public object? ManagedContext { get; private set; }
        public WorkerBufferPools WorkerPools { get; } = new(Math.Max(threadCount, 1));

        public void DispatchWorkers(delegate*<int, IThreadDispatcher, void> workerBody, int maximumWorkerCount = int.MaxValue,
            void* unmanagedContext = null, object? managedContext = null)
        {
            UnmanagedContext = unmanagedContext;
            ManagedContext = managedContext;
            for (int i = 0; i < Math.Min(maximumWorkerCount, threadCount); ++i)
                workerBody(i, this);
            UnmanagedContext = null;
            ManagedContext = null;
        }

        public void DispatchWorkers(Action<int> workerBody, int maximumWorkerCount = int.MaxValue,
            void* unmanagedContext = null, object? managedContext = null) => throw new NotSupportedException();
    }

    [Theory]
    [InlineData(0)]
    [InlineData(1)]
    [InlineData(3)]
    public void DispatchersThatRunWorkersInTurnOrNoneAreEnough(int threadCount) => TaskStackWorld.RequireEnd(() =>
    {
        using var pool = new BufferPool();
        var dispatcher = new SerialDispatcher(threadCount);
        var stack = new TaskStack(pool, dispatcher, Math.Max(threadCount, 1));
        var shared = new Shared { Stack = &stack, Failing = -1 };
        stack.AllocateContinuationAndPush(new Task(&RunOuterLoop, &shared), 0, dispatcher, 0, TaskStack.GetRequestStopTask(&stack));
        TaskStack.DispatchWorkers(dispatcher, &stack);
        Assert.Equal(2000, shared.Begun);
        stack.Dispose(pool, dispatcher);
        dispatcher.WorkerPools.AssertEmpty();
        pool.AssertEmpty();
        dispatcher.WorkerPools.Dispose();
    });
}
