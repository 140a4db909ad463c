using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using Xunit;

namespace DemoTests.Sleeping;

/// <summary>Who falls asleep, when, and what is left of a step then.</summary>
public class SleepTests
{
    [Fact]
    public void What_rests_sleeps_after_as_many_steps_as_its_description_says()
    {
        using var world = new SleepWorld();
        var cube = world.AddCube(new Vector3(0, .5f, 0));
        var patient = world.Bodies.Add(BodyDescription.CreateDynamic(
            new Vector3(5, .5f, 0), new Box(1, 1, 1).ComputeInertia(1), world.Cube, new BodyActivityDescription(.01f, 60)));
        var never = world.Bodies.Add(BodyDescription.CreateDynamic(
            new Vector3(10, .5f, 0), new Box(1, 1, 1).ComputeInertia(1), world.Cube, new BodyActivityDescription(-1)));
        // Counted at the beginning of steps, the first of which has nothing behind it; sleep is the beginning of the next.
        world.Step(32);
        world.AssertAwake(cube, patient, never);
        world.Step();
        world.AssertAwake(patient, never);
        world.Step(40);
        world.AssertAwake(never);
        Assert.Equal(default, world.Bodies[cube].Velocity.Linear);
        Assert.Equal(.5f, world.Bodies[cube].Pose.Position.Y, 1e-3f);
    }

    // What is at its highest point, or was let go, is slower than .1 m/s for .02 s: for more than 32 steps of less than .6 ms. It hung in the air for ever.
    [Theory, InlineData(60), InlineData(240), InlineData(3000), InlineData(6000), InlineData(60000)]
    public void In_slow_motion_nothing_hangs_in_the_air(int stepsPerSecond)
    {
        const float time = .25f;
        using var world = new SleepWorld();
        var thrown = world.AddCube(new Vector3(0, 5, 0));
        world.Bodies[thrown].Velocity.Linear.Y = .5f;
        var released = world.AddCube(new Vector3(5, 5, 0));
        var anchor = world.AddPlatform(new Vector3(10, 5, 0));
        var swinging = world.AddCube(new Vector3(14, 5, 0));
        world.World.Solver.Add(anchor, swinging, new BallSocket { LocalOffsetA = new Vector3(2, 0, 0), LocalOffsetB = new Vector3(-2, 0, 0) });
        for (int i = 0; i < (int)(time * stepsPerSecond); ++i)
            world.World.Step(1f / stepsPerSecond);
        world.AssertAwake(thrown, released, swinging, anchor);
        const float fall = -.5f * 9.81f * time * time;
        Assert.Equal(5 + .5f * time + fall, world.Bodies[thrown].Pose.Position.Y, .01f);
        Assert.Equal(5 + fall, world.Bodies[released].Pose.Position.Y, .01f);
        Assert.True(world.Bodies[swinging].Pose.Position.Y < 5 + fall / 2);
        // What rests sleeps there too, once it has for as long as in 32 steps of 240 a second.
        var resting = world.AddCube(new Vector3(20, .5f, 0));
        for (int i = 0; i < Math.Max(40, (int)(.15f * stepsPerSecond)); ++i)
            world.World.Step(1f / stepsPerSecond);
        Assert.False(world.IsAwake(resting));
    }

    [Fact]
    public void What_moves_does_not_sleep()
    {
        using var world = new SleepWorld();
        var floating = world.AddPlatform(new Vector3(0, 10, 0));
        var slow = world.AddPlatform(new Vector3(10, 10, 0));
        world.Bodies[slow].Velocity.Linear.X = 1e-3f;
        var sliding = world.AddCube(new Vector3(10, 11, 0));
        var still = world.AddCube(new Vector3(0, 11, 0));
        world.Step(100);
        // Slower than the threshold, but carried by what moves.
        world.AssertAwake(slow, sliding);
        Assert.False(world.IsAwake(still) || world.IsAwake(floating));
    }

    /// <summary>While one body holds the others awake, islands are looked for seldom, but only so long.</summary>
    [Theory]
    [InlineData(0)]
    [InlineData(5)]
    [InlineData(10)]
    [InlineData(15)]
    [InlineData(20)]
    [InlineData(25)]
    [InlineData(30)]
    public void Who_was_held_awake_sleeps_as_soon_as_others_when_nobody_holds_it(int phase)
    {
        using var world = new SleepWorld();
        var stack = world.AddStack(0, 2);
        world.Bodies[stack[1]].Activity.SleepThreshold = -1;
        world.Step(100 + phase);
        world.AssertAwake(stack);
        world.Bodies.Remove(stack[1]);
        world.Step(SleepWorld.StepsUntilAsleep + 2);
        world.AssertAwake();
    }

    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void An_island_with_what_is_no_number_does_not_sleep(bool isInertia)
    {
        using var world = new SleepWorld();
        var stack = world.AddStack(0, 2);
        var other = world.AddStack(5, 2);
        world.Step(32);
        world.AssertAwake([.. stack, .. other]);
        if (isInertia)
            world.Bodies[stack[0]].LocalInertia.InverseMass = float.NaN;
        else
            world.Bodies[stack[0]].Pose.Position.Y = float.NaN;
        world.World.Step();
        Assert.True(world.IsAwake(stack[0]) && world.IsAwake(stack[1]));
        Assert.False(world.IsAwake(other[0]) || world.IsAwake(other[1]));
    }

    [Fact]
    public void An_island_sleeps_as_a_whole_or_not_at_all()
    {
        using var world = new SleepWorld();
        var stack = world.AddStack(0, 3);
        var other = world.AddStack(5, 3);
        world.Bodies[stack[2]].Activity.SleepThreshold = -1;
        world.Step(100);
        world.AssertAwake(stack);
        world.Bodies[stack[2]].Activity.SleepThreshold = .01f;
        world.Step(50);
        world.AssertAwake();
        Assert.Equal(2, world.Simulation.Awakener.SleepingIslandCount);
        Assert.All(other, body => Assert.False(world.IsAwake(body)));
    }

    [Fact]
    public void Bodies_that_a_joint_connects_sleep_together()
    {
        using var world = new SleepWorld();
        var a = world.AddCube(new Vector3(0, .5f, 0));
        var b = world.AddCube(new Vector3(3, .5f, 0));
        var joint = world.World.Solver.Add(a, b, new DistanceLimit { MinimumDistance = 1, MaximumDistance = 5, SpringSettings = new(30, 1) });
        world.Settle();
        Assert.Equal(1, world.Simulation.Awakener.SleepingIslandCount);
        world.World.Solver.GetDescription<DistanceLimit>(joint, out var description);
        Assert.Equal(5, description.MaximumDistance);
        var found = new Others { Found = [] };
        world.Bodies.EnumerateConnectedBodies(a, ref found);
        Assert.Contains(b, found.Found);
    }

    [Fact]
    public void What_sleeps_can_be_described_and_found()
    {
        using var world = new SleepWorld();
        var stack = world.AddStack(0, 4);
        world.Settle();
        Assert.Equal(4, world.Bodies.CountBodies());
        Assert.Equal(.01f, world.Bodies.GetDescription(stack[1]).Activity.SleepThreshold);
        Assert.Equal(world.Cube, world.Bodies[stack[1]].Collidable.Shape);
        Assert.InRange(world.Bodies[stack[3]].BoundingBox.Max.Y, 3.9f, 4.5f);
        // Floor and neighbour, or two neighbours.
        Assert.Equal(2, world.Bodies[stack[0]].Constraints.Count);
        var hit = new NearestHit();
        world.Simulation.RayCast(new Vector3(0, 20, 0), -Vector3.UnitY, 100, world.World.Pool, ref hit);
        Assert.Equal(world.Bodies[stack[3]].CollidableReference, hit.Collidable);
        Assert.Equal(16, hit.T, .01f);
        Assert.False(world.IsAwake(stack[3]));
    }

    [Fact]
    public void A_game_puts_an_island_to_sleep()
    {
        using var world = new SleepWorld();
        var stack = world.AddStack(0, 3);
        var falling = world.AddCube(new Vector3(5, 10, 0));
        world.Step(10);
        SetAwake(world.Bodies[falling], false);
        SetAwake(world.Bodies[stack[1]], false);
        world.AssertAwake();
        Assert.Equal(Vector3.Zero, world.Bodies[falling].Velocity.Linear);
        var height = world.Bodies[falling].Pose.Position.Y;
        world.Step(10);
        Assert.Equal(height, world.Bodies[falling].Pose.Position.Y);
        SetAwake(world.Bodies[falling], true);
        world.AssertAwake(falling);
        world.Step(10);
        Assert.InRange(world.Bodies[falling].Pose.Position.Y, height - .5f, height - .1f);
    }

    [Fact]
    public void Everything_settles_and_nothing_that_is_fast_sleeps()
    {
        using var world = new SleepWorld();
        const int rows = 12;
        for (int row = 0; row < rows; ++row)
        {
            for (int i = 0; i < rows - row; ++i)
                world.AddCube(new Vector3((i - (rows - row) * .5f) * 1.1f, row + .5f, 0));
        }
        var random = new System.Random(5);
        for (int i = 0; i < 40; ++i)
            world.AddCube(new Vector3(20, 1 + i, 0) + Scenes.TestWorld.Scatter(random, 1));
        var speeds = new Dictionary<int, float>();
        var last = 0;
        for (int step = 0; step < 1500 && world.Bodies.ActiveSet.Count > 0; ++step)
        {
            speeds.Clear();
            for (int i = 0; i < world.Bodies.ActiveSet.Count; ++i)
            {
                var velocity = world.Bodies.ActiveSet.MotionStates[i].Velocity;
                var speed = velocity.Linear.LengthSquared() + velocity.Angular.LengthSquared();
                speeds.Add(world.Bodies.ActiveSet.IndexToHandle[i].Slot, speed);
                if (speed > .01f)
                    last = step;
            }
            world.World.Step();
            foreach (var (slot, speed) in speeds)
            {
                Assert.True(world.Bodies.TryGetHandle(slot, out var handle));
                Assert.True(world.IsAwake(handle) || speed <= .01f, $"{handle} slept at {speed}");
            }
            Assert.InRange(step, 0, last + 300);
        }
        Assert.Equal(0, world.Bodies.ActiveSet.Count);
        world.Simulation.Validate();
    }

    [Theory, InlineData(1), InlineData(2)]
    public void A_world_asleep_dispatches_nothing_and_allocates_nothing(int threads)
    {
        using var world = new SleepWorld(threads);
        for (int i = 0; i < 20; ++i)
            world.AddStack(3 * i, 3);
        world.Settle();
        var dispatcher = new CountingDispatcher();
        var before = System.GC.GetAllocatedBytesForCurrentThread();
        for (int i = 0; i < 1000; ++i)
            world.Simulation.Timestep(1 / 60f, dispatcher);
        Assert.Equal(0, System.GC.GetAllocatedBytesForCurrentThread() - before);
        Assert.Equal(0, dispatcher.Count);
    }

    [Fact]
    public void Events_of_the_timestepper_are_raised_in_order_whether_anything_is_awake_or_not()
    {
        var timestepper = new DefaultTimestepper();
        var events = new List<string>();
        timestepper.Slept += (_, _) => events.Add("slept");
        timestepper.BeforeCollisionDetection += (_, _) => events.Add("before");
        timestepper.CollisionsDetected += (_, _) => events.Add("detected");
        timestepper.ConstraintsSolved += (_, _) => events.Add("solved");
        using var world = new SleepWorld(timestepper: timestepper);
        world.AddCube(new Vector3(0, .5f, 0));
        world.Step();
        string[] expected = ["slept", "before", "detected", "solved"];
        Assert.Equal(expected, events);
        world.Settle();
        events.Clear();
        world.Step(2);
        Assert.Equal(expected.Concat(expected), events);
    }

    static void SetAwake(BodyReference body, bool value) => body.Awake = value;
}
