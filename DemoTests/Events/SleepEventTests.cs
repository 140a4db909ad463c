using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Compatibility;
using DemoTests.Sleeping;
using Xunit;

namespace DemoTests.Events;

/// <summary>Who falls asleep and wakes is told; contacts neither begin nor end by it, and cost no step anything meanwhile.</summary>
public sealed class SleepEventTests
{
    // What was told since it was last asked, by kind.
    sealed class Journal(SleepWorld world)
    {
        readonly CollisionEvents events = world.Simulation.Events;
        int began, ended, hits, slept, woke;

        public void Step(int count = 1)
        {
            for (int i = 0; i < count; ++i)
            {
                world.Step();
                began += events.Began.Length;
                ended += events.Ended.Length;
                hits += events.Hits.Length;
                slept += events.Slept.Length;
                woke += events.Woke.Length;
            }
        }

        public (int Began, int Ended, int Hits, int Slept, int Woke) Take()
        {
            var all = (began, ended, hits, slept, woke);
            began = ended = hits = slept = woke = 0;
            return all;
        }
    }

    [Fact]
    public void A_box_that_is_dropped_sleeps_wakes_and_is_lifted()
    {
        using var world = new SleepWorld();
        var events = world.Simulation.Events;
        var journal = new Journal(world);
        var box = world.AddCube(new Vector3(0, 2, 0));
        events.Listen(box, EventMask.All);
        journal.Step(150);
        Assert.Equal((1, 0, 1, 1, 0), journal.Take());
        Assert.False(world.IsAwake(box));
        SetAwake(world, box, true);
        journal.Step();
        Assert.Equal([box], events.Woke.ToArray());
        journal.Step(10);
        Assert.Equal((0, 0, 0, 0, 1), journal.Take());
        world.Bodies[box].Velocity.Linear = new Vector3(0, 8, 0);
        journal.Step(10);
        Assert.Equal((0, 1, 0, 0, 0), journal.Take());
    }

    [Fact]
    public void What_is_taken_away_in_its_sleep_ends_and_wakes()
    {
        using var world = new SleepWorld();
        var events = world.Simulation.Events;
        var journal = new Journal(world);
        var stack = world.AddStack(0, 2);
        foreach (var cube in stack)
            events.Listen(cube, EventMask.All);
        world.Settle();
        journal.Take();
        // The upper one is put far away; the lower one still touches the floor.
        var description = world.Bodies.GetDescription(stack[1]);
        description.Pose.Position = new Vector3(50, 30, 0);
        world.Bodies.ApplyDescription(stack[1], description);
        journal.Step();
        Assert.Equal(stack, events.Woke.ToArray());
        Assert.Equal([(stack[0], stack[1])], events.Ended.ToArray().Select(e => (e.Pair.A.BodyHandle, e.Pair.B.BodyHandle)));
        Assert.Equal(stack[0], Assert.Single(events.Persisting.ToArray()).Pair.A.BodyHandle);
    }

    [Fact]
    public void What_is_removed_in_its_sleep_ends_and_is_not_named()
    {
        using var world = new SleepWorld();
        var events = world.Simulation.Events;
        var stack = world.AddStack(0, 2);
        foreach (var cube in stack)
            events.Listen(cube, EventMask.All);
        world.Settle();
        world.Bodies.Remove(stack[0]);
        world.Step();
        Assert.Equal([stack[1]], events.Woke.ToArray());
        Assert.Equal(2, events.Ended.Length);
    }

    [Fact]
    public void Who_turns_twice_between_two_steps_is_not_told_of()
    {
        using var world = new SleepWorld();
        var events = world.Simulation.Events;
        var box = world.AddCube(new Vector3(0, .5f, 0));
        events.Listen(box, EventMask.All);
        world.Settle();
        SetAwake(world, box, true);
        SetAwake(world, box, false);
        world.Step();
        Assert.True(events.Woke.IsEmpty && events.Slept.IsEmpty && events.Began.IsEmpty && events.Ended.IsEmpty);
        SetAwake(world, box, true);
        world.Step();
        Assert.Equal([box], events.Woke.ToArray());
        // It touched when it first fell asleep, and has touched since.
        Assert.Equal((0, 1), (events.Began.Length, events.Persisting.Length));
        SetAwake(world, box, false);
        world.Step();
        Assert.Equal([box], events.Slept.ToArray());
        world.Step();
        Assert.True(events.Slept.IsEmpty);
    }

    [Fact]
    public void Who_is_heard_when_asleep_begins_when_it_wakes()
    {
        using var world = new SleepWorld();
        var events = world.Simulation.Events;
        var box = world.AddCube(new Vector3(0, .5f, 0));
        world.Settle();
        events.Listen(box, EventMask.Begin | EventMask.End);
        world.Step();
        Assert.True(events.Began.IsEmpty);
        SetAwake(world, box, true);
        world.Step();
        Assert.Equal(1, events.Began.Length);
        // Nobody listens to its sleep.
        Assert.True(events.Woke.IsEmpty);
    }

    [Fact]
    public void Who_was_not_heard_when_it_woke_begins_again_when_it_next_touches()
    {
        using var world = new SleepWorld();
        var events = world.Simulation.Events;
        var box = world.AddCube(new Vector3(0, .5f, 0));
        events.Listen(box, EventMask.All);
        world.Settle();
        events.Listen(box, EventMask.None);
        SetAwake(world, box, true);
        world.Step();
        world.Bodies[box].Velocity.Linear = new Vector3(0, 3, 0);
        world.Step(6);
        events.Listen(box, EventMask.All);
        int began = 0;
        for (int i = 0; i < 60; ++i)
        {
            world.Step();
            began += events.Began.Length;
        }
        Assert.Equal(1, began);
    }

    [Fact]
    public void Sleepers_are_in_no_list_that_a_step_goes_through()
    {
        using var world = new SleepWorld();
        var events = world.Simulation.Events;
        for (int i = 0; i < 30; ++i)
            events.Listen(world.AddCube(new Vector3(3 * i, .5f, 0)), EventMask.All);
        world.Step();
        Assert.Equal(30, events.ListedPairCount);
        world.Settle();
        world.Step();
        Assert.Equal(0, events.ListedPairCount);
    }

    [Fact]
    public void A_sensor_forgets_whom_it_saw_asleep_when_that_one_is_removed_and_nobody_is_awake()
    {
        using var world = new SleepWorld();
        var events = world.Simulation.Events;
        var zone = world.World.AddStatic(new Box(2, 2, 2), new RigidPose(new Vector3(0, 1, 0)));
        events.SetSensor(zone, true);
        events.Listen(zone, EventMask.Contacts);
        var box = world.AddCube(new Vector3(0, .5f, 0));
        world.Settle();
        world.Step(3);
        Assert.True(events.Ended.IsEmpty);
        world.Bodies.Remove(box);
        world.Step();
        Assert.True(Assert.Single(events.Ended.ToArray()).IsSensor);
    }

    [Fact]
    public void Threads_do_not_change_who_slept_and_woke_in_which_order()
    {
        var expected = Record(1);
        Assert.True(expected.Count > 30);
        Assert.Equal(expected, Record(2));
        Assert.Equal(expected, Record(3));
    }

    static void SetAwake(SleepWorld world, BodyHandle body, bool value)
    {
        var reference = world.Bodies[body];
        reference.Awake = value;
    }

    static List<(int Step, bool Slept, BodyHandle Body)> Record(int threads)
    {
        using var world = new SleepWorld(threads);
        world.Fill();
        var events = world.Simulation.Events;
        for (int slot = 0; slot < world.Bodies.ActiveSet.Count; ++slot)
            events.Listen(world.Bodies.ActiveSet.IndexToHandle[slot], EventMask.Sleep);
        var stream = new List<(int, bool, BodyHandle)>();
        for (int step = 0; step < 200; ++step)
        {
            world.Step();
            foreach (var body in events.Slept)
                stream.Add((step, true, body));
            foreach (var body in events.Woke)
                stream.Add((step, false, body));
        }
        return stream;
    }

    [Fact]
    public void A_handler_hears_nothing_of_sleep_and_of_what_ended_meanwhile()
    {
        using var world = new SleepWorld();
        using var events = new ContactEvents();
        events.Initialize(world.Simulation);
        var boxes = new[] { world.AddCube(new Vector3(0, .5f, 0)), world.AddCube(new Vector3(5, .5f, 0)) };
        var handlers = new[] { new Handler(), new Handler() };
        events.Register(boxes[0], handlers[0]);
        events.Register(boxes[1], handlers[1]);
        for (int i = 0; i < 100; ++i)
            Step();
        Assert.False(world.IsAwake(boxes[0]) || world.IsAwake(boxes[1]));
        SetAwake(world, boxes[0], true);
        var description = world.Bodies.GetDescription(boxes[1]);
        description.Pose.Position.Y = 20;
        world.Bodies.ApplyDescription(boxes[1], description);
        Step();
        Assert.Equal((1, 0, 0), handlers[0].Heard);
        Assert.Equal((1, 1, 1), handlers[1].Heard);

        void Step()
        {
            world.Step();
            events.Flush();
        }
    }

    sealed class Handler : IContactEventHandler
    {
        int started, stopped, ended;

        public (int Started, int Stopped, int Ended) Heard => (started, stopped, ended);

        public void OnStartedTouching<TManifold>(CollidableReference eventSource, CollidablePair pair, ref TManifold contactManifold, int workerIndex)
            where TManifold : unmanaged, IContactManifold<TManifold> => ++started;

        public void OnStoppedTouching<TManifold>(CollidableReference eventSource, CollidablePair pair, ref TManifold contactManifold, int workerIndex)
            where TManifold : unmanaged, IContactManifold<TManifold> => ++stopped;

        public void OnPairEnded(CollidableReference eventSource, CollidablePair pair) => ++ended;
    }
}
