using System;
using System.Collections.Generic;
using System.Linq;
using BepuUtilities;
using BepuUtilities.Memory;
using BepuUtilities.TaskScheduling;
using Xunit;

namespace DemoTests.Utilities;

/// <summary>Order, filters, continuations and bad calls, on one thread.</summary>
public unsafe class TaskStackTests
{
    static void Nothing(long id, void* context, int workerIndex, IThreadDispatcher dispatcher)
    {
    }

    static void Append(long id, void* context, int workerIndex, IThreadDispatcher dispatcher) => ((List<long>)dispatcher.ManagedContext!).Add(id);

    static Task[] Tasks(params long[] ids) => [.. ids.Select(id => new Task(&Nothing, null, id))];

    static List<long> PopAll<TJobFilter>(TaskStackWorld world, TJobFilter filter) where TJobFilter : IJobFilter
    {
        List<long> ids = [];
        while (world.Stack->TryPop(ref filter, out var task) == PopTaskResult.Success)
            ids.Add(task.Id);
        return ids;
    }

    [Fact]
    public void TheNewestJobComesFirstAndItsTasksInOrder()
    {
        using var world = new TaskStackWorld(1);
        var stack = world.Stack;
        stack->PushUnsafely(Tasks(1, 2), 0, world.Dispatcher);
        stack->Push(Tasks(3)[0], 0, world.Dispatcher);
        stack->PushUnsafely(Tasks(4)[0], 0, world.Dispatcher);
        stack->PushFor(&Nothing, null, -2, 3, 0, world.Dispatcher);
        stack->PushForUnsafely(&Nothing, null, int.MaxValue, 2, 0, world.Dispatcher);
        stack->Push(Tasks(5, 6, 7), 0, world.Dispatcher);
        Assert.Equal(12, stack->ApproximateTaskCount);
        Assert.Equal([5, 6, 7, int.MaxValue, int.MaxValue + 1L, -2, -1, 0, 4, 3, 1, 2], PopAll(world, new AllowAllJobs()));
        Assert.Equal(0, stack->ApproximateTaskCount);
        Assert.Equal(PopTaskResult.Empty, stack->TryPop(out var none));
        Assert.True(none.Function == null);
    }

    [Fact]
    public void FiltersChooseByTag()
    {
        using var world = new TaskStackWorld(1);
        void Push()
        {
            world.Reset();
            for (ulong tag = 0; tag < 6; ++tag)
                world.Stack->Push(Tasks((long)tag * 10, (long)tag * 10 + 1), 0, world.Dispatcher, tag);
        }
        Push();
        Assert.Equal([30, 31], PopAll(world, new EqualTagFilter(3)));
        Assert.Equal([50, 51, 40, 41], PopAll(world, new MinimumTagFilter(2)).Take(4));
        Assert.Equal([10, 11, 0, 1], PopAll(world, new AllowAllJobs()));
        Push();
        Assert.Equal([50, 51, 30, 31, 10, 11], PopAll(world, new FunctionPointerJobFilter(&IsOdd)));
        Assert.Equal([40, 41], PopAll(world, new DelegateJobFilter(tag => tag > 2)));
        Assert.Empty(PopAll(world, new EqualTagFilter(6)));
        Assert.Equal(PopTaskResult.Empty, world.Stack->TryPopAndRun(ref Filter(5), 0, world.Dispatcher));
        Assert.Equal([20, 21, 0, 1], PopAll(world, new AllowAllJobs()));
    }

    static EqualTagFilter filterStorage;

    static ref EqualTagFilter Filter(ulong tag)
    {
        filterStorage = new(tag);
        return ref filterStorage;
    }

    static bool IsOdd(ulong tag) => tag % 2 == 1;

    [Fact]
    public void AnySequenceOfPushesAndFilteredPopsFollowsAListOfQueues()
    {
        for (int seed = 0; seed < 200; ++seed)
        {
            using var world = new TaskStackWorld(1, 1 + seed % 3, 1);
            var random = new Random(seed);
            List<(ulong Tag, Queue<long> Ids)> model = [];
            long nextId = 0;
            for (int step = 0; step < 300; ++step)
            {
                var tag = (ulong)random.Next(4);
                if (random.Next(4) == 0)
                {
                    var ids = Enumerable.Range(0, random.Next(5)).Select(_ => nextId++).ToArray();
                    world.Stack->Push(Tasks(ids), 0, world.Dispatcher, tag);
                    model.Insert(0, (tag, new(ids)));
                    continue;
                }
                var filter = new MinimumTagFilter(tag);
                var result = world.Stack->TryPop(ref filter, out var task);
                var (_, expected) = model.Find(job => job.Tag >= tag && job.Ids.Count > 0);
                Assert.Equal(expected == null ? PopTaskResult.Empty : PopTaskResult.Success, result);
                if (expected != null)
                    Assert.Equal(expected.Dequeue(), task.Id);
                Assert.Equal(model.Sum(job => job.Ids.Count), world.Stack->ApproximateTaskCount);
            }
        }
    }

    [Fact]
    public void ATaskGetsWhatItWasMadeWith()
    {
        using var world = new TaskStackWorld(3);
        var seen = stackalloc long[4];
        new Task(&WriteArguments, seen, -7).Run(2, world.Dispatcher);
        Assert.Equal([-7, 2, 1], new Span<long>(seen, 3).ToArray());
        Task converted = (delegate*<long, void*, int, IThreadDispatcher, void>)&Nothing;
        Assert.True(converted.Function != null && converted.Context == null && converted.Id == 0 && !converted.Continuation.Initialized);
        Assert.Throws<InvalidOperationException>(() => default(Task).Run(0, world.Dispatcher));
    }

    static void WriteArguments(long id, void* context, int workerIndex, IThreadDispatcher dispatcher)
    {
        var seen = (long*)context;
        seen[0] = id;
        seen[1] = workerIndex;
        seen[2] = dispatcher is ThreadDispatcher ? 1 : 0;
    }

    [Fact]
    public void AContinuationCompletesWithItsLastTaskAndTheTaskAfterIt()
    {
        using var world = new TaskStackWorld(1);
        List<long> order = [];
        world.Dispatcher.DispatchWorkers(_ =>
        {
            var stack = world.Stack;
            var last = stack->AllocateContinuation(1, 0, world.Dispatcher, new Task(&Append, null, 300));
            var handle = stack->AllocateContinuation(3, 0, world.Dispatcher, new Task(&Append, null, 200, last));
            Assert.Equal(2, stack->ApproximateContinuationCount);
            Task[] tasks = [new(&Append, null, 1, handle), new(&Append, null, 2, handle)];
            stack->Push(tasks, 0, world.Dispatcher);
            Assert.Equal(PopTaskResult.Success, stack->TryPopAndRun(0, world.Dispatcher));
            Assert.Equal(PopTaskResult.Success, stack->TryPopAndRun(0, world.Dispatcher));
            Assert.False(handle.Completed);
            Assert.Equal([1, 2], order);
            handle.NotifyTaskCompleted(0, world.Dispatcher);
            Assert.Equal([1, 2, 200, 300], order);
            Assert.True(handle.Completed && last.Completed);
            Assert.Equal(0, stack->ApproximateContinuationCount);
            Assert.Throws<InvalidOperationException>(() => handle.NotifyTaskCompleted(0, world.Dispatcher));
            Assert.Throws<InvalidOperationException>(() => new Task(&Append, null, 4, handle).Run(0, world.Dispatcher));
            Assert.Equal(4, order.Count);
        }, managedContext: order);
    }

    [Fact]
    public void NoTasksAreCompleteAtOnce()
    {
        using var world = new TaskStackWorld(1);
        List<long> order = [];
        world.Dispatcher.DispatchWorkers(_ =>
        {
            var stack = world.Stack;
            Assert.True(stack->AllocateContinuation(0, 0, world.Dispatcher).Completed);
            Assert.True(stack->AllocateContinuation(0, 0, world.Dispatcher, new Task(&Append, null, 1)).Completed);
            Assert.True(stack->AllocateContinuationAndPush([], 0, world.Dispatcher, 0, new Task(&Append, null, 2)).Completed);
            stack->Push([], 0, world.Dispatcher);
            stack->PushUnsafely([], 0, world.Dispatcher);
            stack->RunTasks([], 0, world.Dispatcher);
            stack->For(&Append, null, 5, 0, 0, world.Dispatcher);
            stack->PushFor(&Append, null, 5, 0, 0, world.Dispatcher);
            stack->PushForUnsafely(&Append, null, 5, 0, 0, world.Dispatcher);
            Assert.Equal(PopTaskResult.Empty, stack->TryPop(out var none));
            Assert.Equal(0, stack->ApproximateContinuationCount);
        }, managedContext: order);
        Assert.Equal([1, 2], order);
    }

    [Fact]
    public void ALongChainOfContinuationsTakesNoThreadStack()
    {
        const int Length = 200_000;
        using var world = new TaskStackWorld(1);
        var count = world.TakeCounters(1);
        var handle = ContinuationHandle.Null;
        for (int i = 0; i < Length; ++i)
            handle = world.Stack->AllocateContinuation(1, 0, world.Dispatcher, new Task(&Increment, count, i, handle));
        Assert.Equal(Length, world.Stack->ApproximateContinuationCount);
        handle.NotifyTaskCompleted(0, world.Dispatcher);
        Assert.Equal(Length, *count);
        Assert.Equal(0, world.Stack->ApproximateContinuationCount);
    }

    static void Increment(long id, void* context, int workerIndex, IThreadDispatcher dispatcher) => ++*(int*)context;

    [Fact]
    public void HandlesAreEqualWhenTheyNameTheSameContinuation()
    {
        using var world = new TaskStackWorld(1);
        var a = world.Stack->AllocateContinuation(1, 0, world.Dispatcher);
        var b = world.Stack->AllocateContinuation(1, 0, world.Dispatcher);
        var copy = a;
        Assert.True(a == copy && a.Equals((object)copy) && a.GetHashCode() == copy.GetHashCode());
        Assert.True(a != b && !a.Equals((object)b) && a != ContinuationHandle.Null && !a.Equals("a"));
        Assert.True(a.Initialized && !a.Completed);
        Assert.True(!ContinuationHandle.Null.Initialized && ContinuationHandle.Null.Completed && ContinuationHandle.Null == default);
        Assert.Throws<InvalidOperationException>(() => ContinuationHandle.Null.NotifyTaskCompleted(0, world.Dispatcher));
        world.Stack->WaitForCompletion(ContinuationHandle.Null, 0, world.Dispatcher);
    }

    [Fact]
    public void BadCallsAreRefusedAndChangeNothing()
    {
        using var world = new TaskStackWorld(2);
        using var pool = new BufferPool();
        var dispatcher = world.Dispatcher;
        var stack = world.Stack;
        Assert.Throws<ArgumentNullException>(() => new TaskStack(null!, dispatcher, 1));
        Assert.Throws<ArgumentNullException>(() => new TaskStack(pool, null!, 1));
        Assert.Throws<ArgumentOutOfRangeException>(() => new TaskStack(pool, dispatcher, 0));
        Assert.Throws<ArgumentOutOfRangeException>(() => new TaskStack(pool, dispatcher, 3));
        Assert.Throws<ArgumentOutOfRangeException>(() => new TaskStack(pool, dispatcher, 1, 0));
        Assert.Throws<ArgumentOutOfRangeException>(() => new TaskStack(pool, dispatcher, 1, 1, -1));
        Assert.Throws<ArgumentNullException>(() => new DelegateJobFilter(null!));
        Assert.Throws<ArgumentNullException>(() => new FunctionPointerJobFilter(null));
        foreach (var worker in new[] { -1, 2, int.MinValue })
        {
            Assert.Throws<ArgumentOutOfRangeException>(() => stack->Push(Tasks(1), worker, dispatcher));
            Assert.Throws<ArgumentOutOfRangeException>(() => stack->PushUnsafely(Tasks(1)[0], worker, dispatcher));
            Assert.Throws<ArgumentOutOfRangeException>(() => stack->PushFor(&Nothing, null, 0, 1, worker, dispatcher));
            Assert.Throws<ArgumentOutOfRangeException>(() => stack->PushForUnsafely(&Nothing, null, 0, 1, worker, dispatcher));
            Assert.Throws<ArgumentOutOfRangeException>(() => stack->For(&Nothing, null, 0, 1, worker, dispatcher));
            Assert.Throws<ArgumentOutOfRangeException>(() => stack->RunTask(Tasks(1)[0], worker, dispatcher));
            Assert.Throws<ArgumentOutOfRangeException>(() => stack->AllocateContinuation(1, worker, dispatcher));
            Assert.Throws<ArgumentOutOfRangeException>(() => stack->AllocateContinuationAndPush(Tasks(1), worker, dispatcher));
            Assert.Throws<ArgumentOutOfRangeException>(() => stack->TryPopAndRun(worker, dispatcher));
            Assert.Throws<ArgumentOutOfRangeException>(() => stack->WaitForCompletion(default, worker, dispatcher));
        }
        Assert.Throws<ArgumentNullException>(() => stack->Push(Tasks(1), 0, null!));
        Assert.Throws<ArgumentNullException>(() => stack->AllocateContinuation(1, 0, null!));
        Assert.Throws<ArgumentNullException>(() => stack->TryPopAndRun(0, null!));
        Assert.Throws<ArgumentOutOfRangeException>(() => stack->AllocateContinuation(-1, 0, dispatcher));
        Assert.Throws<ArgumentOutOfRangeException>(() => stack->PushFor(&Nothing, null, 0, -1, 0, dispatcher));
        Assert.Throws<ArgumentOutOfRangeException>(() => stack->For(&Nothing, null, 0, int.MinValue, 0, dispatcher));
        Assert.Throws<ArgumentNullException>(() => stack->PushFor(null, null, 0, 1, 0, dispatcher));
        Assert.Throws<ArgumentNullException>(() => stack->For(null, null, 0, 1, 0, dispatcher));
        Assert.Throws<ArgumentException>(() => stack->Push(default(Task), 0, dispatcher));
        var message = Assert.Throws<ArgumentException>(() => stack->RunTasks(new Task[] { new(&Nothing), default }, 0, dispatcher)).Message;
        Assert.Contains("Task 1 ", message, StringComparison.Ordinal);
        Assert.Throws<ArgumentNullException>(() => TaskStack.GetRequestStopTask(null));
        Assert.Throws<ArgumentNullException>(() => TaskStack.DispatchWorkers(dispatcher, null));
        Assert.Throws<ArgumentNullException>(() => TaskStack.DispatchWorkers(null!, stack));
        Assert.Throws<ArgumentOutOfRangeException>(() => TaskStack.DispatchWorkers(dispatcher, stack, 0));
        Assert.Throws<InvalidOperationException>(() => dispatcher.DispatchWorkers(&TaskStack.DispatchWorkerFunction, 1));
        Assert.Equal((0, 0), (stack->ApproximateTaskCount, stack->ApproximateContinuationCount));
        dispatcher.WorkerPools.AssertEmpty();
        pool.AssertEmpty();

        var handle = stack->AllocateContinuation(1, 0, dispatcher);
        Task[] continued = [new(&Nothing, null, 0, handle)];
        Assert.Throws<ArgumentException>(() => stack->RunTasks(continued, 0, dispatcher));
        Assert.Throws<ArgumentException>(() => stack->AllocateContinuationAndPush(continued, 0, dispatcher));
        Assert.Equal((0, 1), (stack->ApproximateTaskCount, stack->ApproximateContinuationCount));
    }

    [Fact]
    public void AStackThatWasNotCreatedOrIsDisposedSaysSo()
    {
        using var dispatcher = new ThreadDispatcher(1);
        using var pool = new BufferPool();
        var stack = new TaskStack(pool, dispatcher, 1);
        stack.Dispose(pool, dispatcher);
        Assert.Throws<ObjectDisposedException>(() => stack.TryPop(out _));
        Assert.Throws<ObjectDisposedException>(() => stack.Push(Tasks(1), 0, dispatcher));
        Assert.Throws<ObjectDisposedException>(() => stack.RequestStop());
        Assert.Throws<ObjectDisposedException>(() => stack.ApproximateTaskCount);
        Assert.Throws<ObjectDisposedException>(() => default(TaskStack).Reset(dispatcher));
    }
}
