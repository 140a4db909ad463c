using System;
using System.Collections.Generic;
using System.Linq;
using System.Threading;
using BepuPhysics;
using Xunit;

namespace DemoTests.Locking;

/// <summary>Every call from every callback and from a second thread: it works or is refused, and the world goes on.</summary>
public class LockMatrixTests
{
    // Long, for machines on which much else runs: it only has to end what would hang for ever.
    static readonly TimeSpan patience = TimeSpan.FromMinutes(5);

    public static TheoryData<string, int, int> Places
    {
        get
        {
            var data = new TheoryData<string, int, int>();
            foreach (var place in LockPlace.All.Keys)
            {
                data.Add(place, 1, 8);
                // Enough bodies for callbacks to come from the workers of a dispatch.
                data.Add(place, 3, 300);
            }
            return data;
        }
    }

    [Theory]
    [MemberData(nameof(Places))]
    public void A_call_from_a_callback_works_or_is_refused(string placeName, int threads, int bodyCount)
    {
        var place = LockPlace.All[placeName];
        using var attempts = new Attempts(place, threads, bodyCount);
        foreach (var (name, operation) in LockOperations.All)
            attempts.Try(name, place.Allowed.Contains(operation.Kind), operation.Do);
        Assert.Empty(attempts.Wrong);
    }

    [Theory]
    [MemberData(nameof(Places))]
    public void A_call_from_a_second_thread_during_a_callback_works_or_is_refused(string placeName, int threads, int bodyCount)
    {
        var place = LockPlace.All[placeName];
        // While a query runs, and between two stages, others may ask and write values; while a stage is in progress, nobody else may do anything.
        bool isOutsideOfStages = place.Allowed.Contains(OperationKind.Write) && !placeName.StartsWith("Substep", StringComparison.Ordinal);
        using var attempts = new Attempts(place, threads, bodyCount);
        foreach (var (name, operation) in LockOperations.All)
        {
            bool isAllowed = isOutsideOfStages && operation.Kind is (OperationKind.Query or OperationKind.Write);
            attempts.Try(name, isAllowed, world => OnOtherThread(() => operation.Do(world)));
        }
        Assert.Empty(attempts.Wrong);
    }

    [Theory]
    [InlineData(1, 8)]
    [InlineData(3, 300)]
    public void What_a_callback_throws_reaches_the_caller_and_leaves_the_world_open(int threads, int bodyCount)
    {
        foreach (var place in LockPlace.All.Values)
        {
            using var world = new LockedWorld(threads, bodyCount);
            world.Step();
            world.Arm(place.Name, static () => throw new TimeZoneNotFoundException("of the test"));
            var exception = Record.Exception(() => place.Reach(world));
            Assert.True(exception is TimeZoneNotFoundException or AggregateException, $"{place.Name}: {exception}");
            world.Simulation.Bodies.Add(world.HealthyBody(new(0, 90, 0)));
            world.Step();
            world.Simulation.Validate();
        }
    }

    [Fact]
    public void Two_threads_that_add_at_once_either_succeed_or_are_refused()
    {
        const int attempts = 20_000;
        using var world = new LockedWorld(1, 8);
        int before = world.Simulation.Bodies.CountBodies();
        int succeeded = 0;
        var threads = new Thread[2];
        var failures = new Exception?[2];
        for (int i = 0; i < threads.Length; ++i)
        {
            var index = i;
            threads[i] = new Thread(() =>
            {
                for (int k = 0; k < attempts; ++k)
                {
                    try
                    {
                        world.Simulation.Bodies.Add(world.HealthyBody(new(k % 100 * 3, 100 + index * 3, k / 100)));
                        Interlocked.Increment(ref succeeded);
                    }
                    catch (InvalidOperationException)
                    {
                        // The other one was faster.
                    }
                    catch (ArgumentException exception)
                    {
                        failures[index] = exception;
                    }
                }
            });
        }
        foreach (var thread in threads)
            thread.Start();
        foreach (var thread in threads)
            Assert.True(thread.Join(patience));
        Assert.All(failures, Assert.Null);
        Assert.Equal(before + succeeded, world.Simulation.Bodies.CountBodies());
        world.Simulation.Validate();
    }

    [Fact]
    public void A_timestepper_of_a_game_may_change_the_world_between_its_stages()
    {
        var timestepper = new ChangingTimestepper();
        using var world = new LockedWorld(1, 8, timestepper);
        timestepper.World = world;
        int before = world.Simulation.Bodies.CountBodies();
        world.Step();
        Assert.Equal(before + 3, world.Simulation.Bodies.CountBodies());
        world.Simulation.Validate();
        Assert.Throws<InvalidOperationException>(() =>
        {
            timestepper.StepsAgain = true;
            world.Step();
        });
        timestepper.StepsAgain = false;
        world.Step();
    }

    [Fact]
    public void Stages_may_be_called_without_a_step()
    {
        using var world = new LockedWorld(1, 8);
        for (int i = 0; i < 3; ++i)
        {
            world.Simulation.PredictBoundingBoxes(LockedWorld.Dt);
            world.Simulation.CollisionDetection(LockedWorld.Dt);
            world.Simulation.Solve(LockedWorld.Dt);
        }
        world.Simulation.Validate();
    }

    [Fact]
    public void A_refusal_says_what_was_called_and_what_is_in_progress()
    {
        using var world = new LockedWorld(1, 8);
        string message = "";
        world.Arm("AllowContactGeneration", () =>
            message = Assert.Throws<InvalidOperationException>(() => world.Simulation.Bodies.Remove(world.Spare)).Message);
        world.Step();
        Assert.Contains("Bodies.Remove", message);
        Assert.Contains("Simulation.CollisionDetection", message);
    }

    // A call that is refused changes nothing, so the next one is made in the same world; after one that works there is another world.
    sealed class Attempts(LockPlace place, int threads, int bodyCount) : IDisposable
    {
        LockedWorld? current;

        public List<string> Wrong { get; } = [];

        public void Try(string name, bool isAllowed, Action<LockedWorld> operation)
        {
            var failures = Wrong.Count;
            if (current is null)
            {
                current = new LockedWorld(threads, bodyCount);
                current.Step();
            }
            Try(current, name, isAllowed, operation);
            if (isAllowed || Wrong.Count > failures)
                Dispose();
        }

        void Try(LockedWorld world, string name, bool isAllowed, Action<LockedWorld> operation)
        {
            Exception? outcome = null;
            world.Arm(place.Name, () => outcome = Record.Exception(() => operation(world)));
            var finished = false;
            Exception? failure = null;
            var thread = new Thread(() =>
            {
                failure = Record.Exception(() => place.Reach(world));
                finished = true;
            });
            thread.Start();
            if (!thread.Join(patience))
            {
                Wrong.Add($"{name} from {place.Name}: hangs");
                return;
            }
            if (!world.WasReached || !finished)
                Wrong.Add($"{name} from {place.Name}: never got there");
            if (isAllowed ? outcome is not null : outcome is not InvalidOperationException)
                Wrong.Add($"{name} from {place.Name}: {outcome?.GetType().Name ?? "worked"} {outcome?.Message}");
            if (failure is not null)
                Wrong.Add($"{name} from {place.Name}: then {failure}");
            var after = Record.Exception(() =>
            {
                // Predicted bounds are fitted by the collision detection that follows.
                if (name != "Simulation.PredictBoundingBoxes")
                    world.Simulation.Validate();
                BodyHandle? added = world.Simulation.Shapes.Exists(world.OtherShape)
                    ? world.Simulation.Bodies.Add(world.HealthyBody(new(0, 120, 0))) : null;
                world.Step();
                world.Step();
                world.Simulation.Validate();
                if (added is { } body)
                    world.Simulation.Bodies.Remove(body);
            });
            if (after is not null)
                Wrong.Add($"{name} from {place.Name}: afterwards {after}");
        }

        public void Dispose()
        {
            current?.Dispose();
            current = null;
        }
    }

    static void OnOtherThread(Action action)
    {
        Exception? failure = null;
        var thread = new Thread(() => failure = Record.Exception(action));
        thread.Start();
        if (!thread.Join(patience))
            throw new TimeoutException("The second thread hangs.");
        if (failure is not null)
            throw failure;
    }

    sealed class ChangingTimestepper : ITimestepper
    {
        public event TimestepperStageHandler? BeforeCollisionDetection { add { } remove { } }

        public event TimestepperStageHandler? CollisionsDetected { add { } remove { } }

        public LockedWorld World { get; set; } = null!;

        public bool StepsAgain { get; set; }

        public void Timestep(Simulation simulation, float dt, BepuUtilities.IThreadDispatcher? threadDispatcher = null)
        {
            simulation.PredictBoundingBoxes(dt, threadDispatcher);
            Add(0);
            simulation.CollisionDetection(dt, threadDispatcher);
            Add(1);
            simulation.Solve(dt, threadDispatcher);
            Add(2);
            if (StepsAgain)
                simulation.Timestep(dt, threadDispatcher);
        }

        void Add(int i) => World.Simulation.Bodies.Add(World.HealthyBody(new(5 * i, 60, 0)));
    }
}
