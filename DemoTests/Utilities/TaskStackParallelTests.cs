using System;
using System.Linq;
using System.Threading;
using BepuUtilities;
using BepuUtilities.TaskScheduling;
using Xunit;

namespace DemoTests.Utilities;

/// <summary>Work on several threads: each task runs once, waits end when what they wait for has ended.</summary>
public unsafe class TaskStackParallelTests
{
    struct Shared
    {
        public TaskStack* Stack;
        public int* Counts;
        public int Width;
        public int Violations;
        public ContinuationHandle Handle;
    }

    static Span<int> Counts(Shared* shared, int count) => new(shared->Counts, count);

    static void Count(long id, void* context, int workerIndex, IThreadDispatcher dispatcher)
    {
        var shared = (Shared*)context;
        Interlocked.Increment(ref shared->Counts[id]);
        if (workerIndex < 0 || workerIndex >= dispatcher.ThreadCount)
            Interlocked.Increment(ref shared->Violations);
    }

    [Theory]
    [InlineData(1)]
    [InlineData(2)]
    [InlineData(3)]
    [InlineData(8)]
    public void EachIndexOfALoopRunsOnce(int threadCount) => TaskStackWorld.RequireEnd(() =>
    {
        const int Width = 5000;
        using var world = new TaskStackWorld(threadCount);
        var shared = new Shared { Stack = world.Stack, Counts = world.TakeCounters(Width), Width = Width };
        for (int repeat = 1; repeat <= 40; ++repeat)
        {
            world.Run(&RunLoop, &shared, repeat % 3);
            Assert.True(Counts(&shared, Width).IndexOfAnyExcept(repeat) < 0);
            world.Reset();
        }
        Assert.Equal(0, shared.Violations);
    });

    static void RunLoop(long id, void* context, int workerIndex, IThreadDispatcher dispatcher)
    {
        var shared = (Shared*)context;
        var filter = new EqualTagFilter(9);
        if (id == 0)
            shared->Stack->For(&Count, shared, 0, shared->Width, workerIndex, dispatcher);
        else if (id == 1)
            shared->Stack->For(&Count, shared, 0, shared->Width, workerIndex, dispatcher, ref filter, 9);
        else
        {
            var tasks = Enumerable.Range(0, shared->Width).Select(i => new Task(&Count, shared, i)).ToArray();
            shared->Stack->RunTasks(tasks.AsSpan(1), workerIndex, dispatcher, ref filter, 9);
            shared->Stack->RunTask(tasks[0], workerIndex, dispatcher);
        }
        // The loop has ended for whoever called it.
        var first = shared->Counts[0];
        if (Counts(shared, shared->Width).IndexOfAnyExcept(first) >= 0)
            Interlocked.Increment(ref shared->Violations);
    }

    [Theory]
    [InlineData(1)]
    [InlineData(2)]
    [InlineData(3)]
    [InlineData(8)]
    public void LoopsNest(int threadCount) => TaskStackWorld.RequireEnd(() =>
    {
        using var world = new TaskStackWorld(threadCount, 1, 1);
        var shared = new Shared { Stack = world.Stack, Counts = world.TakeCounters(8 * 4096), Width = 8 };
        for (int repeat = 1; repeat <= 3; ++repeat)
        {
            world.Run(&Nest, &shared, 1);
            // Ids of the innermost level: 1 followed by four digits of eight.
            Assert.True(new Span<int>(shared.Counts + 4096, 4096).IndexOfAnyExcept(repeat) < 0);
            world.Reset();
        }
        Assert.Equal(0, shared.Violations);
    });

    static void Nest(long id, void* context, int workerIndex, IThreadDispatcher dispatcher)
    {
        var shared = (Shared*)context;
        if (id < 4096)
            shared->Stack->For(&Nest, context, (int)id * shared->Width, shared->Width, workerIndex, dispatcher);
        else
            Count(id, context, workerIndex, dispatcher);
    }

    struct Node
    {
        public Shared* Shared;
        public int Start;
        public int Count;
        public long Sum;
    }

    [Theory]
    [InlineData(1)]
    [InlineData(2)]
    [InlineData(3)]
    [InlineData(8)]
    public void ASumOverATreeIsThatOfALoop(int threadCount) => TaskStackWorld.RequireEnd(() =>
    {
        const int Width = 20_001;
        using var world = new TaskStackWorld(threadCount, 4, 4);
        var shared = new Shared { Stack = world.Stack, Counts = world.TakeCounters(Width) };
        long expected = 0;
        for (int i = 0; i < Width; ++i)
            expected += shared.Counts[i] = i * 7919 % 10007 - 5000;
        for (int repeat = 0; repeat < 5; ++repeat)
        {
            var root = new Node { Shared = &shared, Count = Width };
            world.Run(&SumTree, &root);
            Assert.Equal(expected, root.Sum);
            Assert.Equal((0, 0), (world.Stack->ApproximateTaskCount, world.Stack->ApproximateContinuationCount));
            world.Reset();
        }
    });

    static void SumTree(long id, void* context, int workerIndex, IThreadDispatcher dispatcher)
    {
        var node = (Node*)context;
        if (node->Count == 1)
        {
            node->Sum = node->Shared->Counts[node->Start];
            return;
        }
        // Children lie on this method's stack: it may not return before they have ended.
        var half = node->Count / 2;
        var children = stackalloc Node[2];
        children[0] = new() { Shared = node->Shared, Start = node->Start, Count = half };
        children[1] = new() { Shared = node->Shared, Start = node->Start + half, Count = node->Count - half };
        var stack = node->Shared->Stack;
        var handle = stack->AllocateContinuation(2, workerIndex, dispatcher);
        Span<Task> tasks = [new(&SumTree, children, 0, handle), new(&SumTree, children + 1, 1, handle)];
        stack->Push(tasks, workerIndex, dispatcher);
        stack->WaitForCompletion(handle, workerIndex, dispatcher);
        node->Sum = children[0].Sum + children[1].Sum;
    }

    [Theory]
    [InlineData(1)]
    [InlineData(2)]
    [InlineData(8)]
    public void ManySmallJobsFromAllWorkersRunOnceEach(int threadCount) => TaskStackWorld.RequireEnd(() =>
    {
        // Task i pushes 3i + 1 to 3i + 3, in turn together and one by one; the last to end requests the stop.
        const int Width = 60_000;
        using var world = new TaskStackWorld(threadCount, 2, 2);
        var shared = new Shared { Stack = world.Stack, Counts = world.TakeCounters(Width), Width = Width };
        for (int repeat = 1; repeat <= 3; ++repeat)
        {
            var handle = shared.Handle = world.Stack->AllocateContinuation(Width, 0, world.Dispatcher, TaskStack.GetRequestStopTask(world.Stack));
            world.Stack->PushUnsafely(new Task(&Spread, &shared, 0, handle), 0, world.Dispatcher);
            TaskStack.DispatchWorkers(world.Dispatcher, world.Stack);
            Assert.True(handle.Completed);
            Assert.True(Counts(&shared, Width).IndexOfAnyExcept(repeat) < 0);
            Assert.Equal(0, world.Stack->ApproximateTaskCount);
            world.Reset();
        }
        Assert.Equal(0, shared.Violations);
    });

    static void Spread(long id, void* context, int workerIndex, IThreadDispatcher dispatcher)
    {
        var shared = (Shared*)context;
        Count(id, context, workerIndex, dispatcher);
        Span<Task> children = stackalloc Task[3];
        var childCount = (int)Math.Clamp(shared->Width - (3 * id + 1), 0, 3);
        for (int i = 0; i < childCount; ++i)
        {
            children[i] = new Task(&Spread, context, 3 * id + 1 + i, shared->Handle);
            if (id % 2 == 0)
                shared->Stack->Push(children[i], workerIndex, dispatcher, (ulong)i);
        }
        if (id % 2 == 1)
            shared->Stack->Push(children[..childCount], workerIndex, dispatcher);
    }

    [Theory]
    [InlineData(1)]
    [InlineData(2)]
    [InlineData(8)]
    public void PhasesFollowEachOtherByContinuations(int threadCount) => TaskStackWorld.RequireEnd(() =>
    {
        const int Width = 40;
        using var world = new TaskStackWorld(threadCount);
        var shared = new Shared { Stack = world.Stack, Counts = world.TakeCounters(Width), Width = Width };
        BeginPhase(0, &shared, 0, world.Dispatcher);
        TaskStack.DispatchWorkers(world.Dispatcher, world.Stack);
        Assert.Equal(0, shared.Violations);
        Assert.True(Counts(&shared, Width).IndexOfAnyExcept(PhaseCount) < 0);
    });

    const int PhaseCount = 500;

    static void BeginPhase(long phase, void* context, int workerIndex, IThreadDispatcher dispatcher)
    {
        var shared = (Shared*)context;
        if (Counts(shared, shared->Width).IndexOfAnyExcept((int)phase) >= 0)
            Interlocked.Increment(ref shared->Violations);
        if (phase == PhaseCount)
        {
            shared->Stack->RequestStop();
            return;
        }
        var handle = shared->Stack->AllocateContinuation(shared->Width, workerIndex, dispatcher, new Task(&BeginPhase, context, phase + 1));
        shared->Stack->PushFor(&Count, context, 0, shared->Width, workerIndex, dispatcher, 0, handle);
    }

    [Fact]
    public void WorkersKeepToTheirFilters() => TaskStackWorld.RequireEnd(() =>
    {
        // Worker w takes tags w and above; a task notes who ran it.
        const int Width = 4000;
        using var world = new TaskStackWorld(4);
        var stack = world.Stack;
        var ranBy = world.TakeCounters(Width);
        var handle = stack->AllocateContinuation(Width, 0, world.Dispatcher, TaskStack.GetRequestStopTask(stack));
        for (int i = 0; i < Width; ++i)
            stack->PushUnsafely(new Task(&NoteWorker, ranBy, i, handle), 0, world.Dispatcher, (ulong)(i % 4));
        world.Dispatcher.DispatchWorkers(worker =>
        {
            var filter = new MinimumTagFilter((ulong)worker);
            while (stack->TryPopAndRun(ref filter, worker, world.Dispatcher) != PopTaskResult.Stop)
                Thread.Yield();
        });
        for (int i = 0; i < Width; ++i)
            Assert.InRange(ranBy[i], 1, i % 4 + 1);
    });

    static void NoteWorker(long id, void* context, int workerIndex, IThreadDispatcher dispatcher) =>
        Interlocked.Add(ref ((int*)context)[id], workerIndex + 1);

    [Fact]
    public void AWaitWithAFilterRunsOnlyWhatItAllows() => TaskStackWorld.RequireEnd(() =>
    {
        using var world = new TaskStackWorld(1);
        var counts = world.TakeCounters(3);
        var shared = new Shared { Counts = counts };
        var stack = world.Stack;
        var handle = stack->AllocateContinuationAndPush(new Task(&Count, &shared, 0), 0, world.Dispatcher, 5);
        stack->Push(new Task(&Count, &shared, 1), 0, world.Dispatcher, 4);
        stack->Push(new Task(&Count, &shared, 2), 0, world.Dispatcher, 5);
        var filter = new EqualTagFilter(5);
        stack->WaitForCompletion(ref filter, handle, 0, world.Dispatcher);
        Assert.Equal([1, 0, 1], new Span<int>(counts, 3).ToArray());
    });
}
