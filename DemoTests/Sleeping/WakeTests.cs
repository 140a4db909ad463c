using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using BepuUtilities.Collections;
using Xunit;

namespace DemoTests.Sleeping;

/// <summary>What wakes a sleeping island, and that it wakes this one alone.</summary>
public class WakeTests
{
    // Three stacks that sleep; something is done to the one in the middle.
    static readonly (string Name, Action<SleepWorld, BodyHandle[]> Do)[] causes =
    [
        ("Awake", (w, stack) => Wake(w.Bodies[stack[1]])),
        ("AwakenBody", (w, stack) => w.Simulation.Awakener.AwakenBody(stack[2])),
        ("ApplyDescription", (w, stack) => w.Bodies.ApplyDescription(stack[0], w.Bodies.GetDescription(stack[0]))),
        ("SetShape", (w, stack) => w.Bodies.SetShape(stack[1], w.Simulation.Shapes.Add(new Box(1, 1, .9f)))),
        ("SetLocalInertia", (w, stack) => w.Bodies.SetLocalInertia(stack[1], new Box(1, 1, 1).ComputeInertia(2))),
        ("BecomeKinematic", (w, stack) => w.Bodies[stack[0]].BecomeKinematic()),
        ("ApplyImpulse", (w, stack) => w.Bodies[stack[2]].ApplyImpulse(Vector3.UnitY, Vector3.Zero)),
        ("ApplyLinearImpulse", (w, stack) => w.Bodies[stack[2]].ApplyLinearImpulse(default)),
        ("ApplyAngularImpulse", (w, stack) => w.Bodies[stack[2]].ApplyAngularImpulse(Vector3.UnitY)),
        ("Solver.Add", (w, stack) => w.World.Solver.Add(stack[0], stack[2], new BallSocket { LocalOffsetA = Vector3.UnitY, LocalOffsetB = -Vector3.UnitY })),
        ("Solver.Remove", (w, stack) => w.World.Solver.Remove(w.Bodies[stack[1]].Constraints[0].ConnectingConstraintHandle)),
        ("Static below", (w, stack) => w.World.AddStatic(new Box(.1f, 1, .1f), new RigidPose(w.Bodies[stack[0]].Pose.Position - Vector3.UnitY))),
        ("Static beside that comes nearer", (w, stack) =>
        {
            var post = w.World.AddStatic(new Box(.5f, 1, .5f), new RigidPose(new Vector3(50, 1, 0)));
            var moved = w.World.Statics.GetDescription(post);
            moved.Pose.Position = w.Bodies[stack[0]].Pose.Position + new Vector3(0, 0, .7f);
            w.World.Statics.ApplyDescription(post, moved);
        }),
    ];

    public static TheoryData<string> Causes => [.. causes.Select(cause => cause.Name)];

    [Theory, MemberData(nameof(Causes))]
    public void Exactly_the_island_wakes_to_which_something_happens(string name)
    {
        using var world = new SleepWorld();
        var stacks = new[] { world.AddStack(-10, 3), world.AddStack(0, 3), world.AddStack(10, 3) };
        world.Settle();
        Assert.Equal(3, world.Simulation.Awakener.SleepingIslandCount);
        Array.Find(causes, cause => cause.Name == name).Do(world, stacks[1]);
        world.Simulation.Validate();
        world.AssertAwake(stacks[1]);
        Assert.All(stacks[1], body => Assert.Equal(0, world.Bodies[body].Activity.TimestepsUnderThresholdCount));
        world.Step(5);
        world.AssertAwake(stacks[1]);
        Assert.All(stacks[1], body => Assert.InRange(world.Bodies[body].Pose.Position.Y, .4f, 3));
    }

    static void Wake(BodyReference body) => body.Awake = true;

    [Fact]
    public void Reading_wakes_nobody()
    {
        using var world = new SleepWorld();
        var stack = world.AddStack(0, 3);
        world.Settle();
        var body = world.Bodies[stack[1]];
        body.GetDescription(out _);
        body.ComputeInverseInertia(out _);
        body.UpdateBounds();
        _ = body.Dynamics.Inertia.World.InverseMass + body.Velocity.Linear.X;
        world.Bodies[stack[1]].Pose.Position.X += 1e-6f;
        world.Step(3);
        world.AssertAwake();
    }

    [Fact]
    public void A_body_that_falls_on_a_sleeper_wakes_it_in_the_step_of_the_touch()
    {
        using var world = new SleepWorld();
        var stacks = new[] { world.AddStack(-10, 3), world.AddStack(0, 3), world.AddStack(10, 3) };
        world.Settle();
        var ball = world.World.AddDynamic(new Sphere(.3f), 1, new RigidPose(new Vector3(.2f, 6, 0)));
        for (int i = 0; i < 200 && !world.IsAwake(stacks[1][2]); ++i)
        {
            world.AssertAwake(ball);
            world.Step();
        }
        world.AssertAwake([ball, .. stacks[1]]);
        // Its contact was solved in that step: the ball has not gone through by what it would have.
        Assert.InRange(world.Bodies[ball].Pose.Position.Y, 3.25f, 3.6f);
        var contacts = 0;
        foreach (var constraint in world.Bodies[stacks[1][2]].Constraints)
            contacts += world.World.Solver.GetAccumulatedImpulseMagnitude(constraint.ConnectingConstraintHandle) > 0 ? 1 : 0;
        Assert.Equal(2, contacts);
        world.Step(30);
        Assert.InRange(world.Bodies[stacks[1][2]].Pose.Position.Y, 2.4f, 2.6f);
    }

    [Fact]
    public void A_platform_that_starts_wakes_what_stands_on_it_in_that_step()
    {
        using var world = new SleepWorld();
        var platform = world.AddPlatform(new Vector3(0, 5, 0));
        var stack = world.AddStack(0, 3, 5.5f);
        var other = world.AddStack(10, 2);
        world.Settle();
        Wake(world.Bodies[platform]);
        world.Step();
        world.AssertAwake(platform);
        world.Bodies[platform].Velocity.Linear = new Vector3(0, 1, 0);
        world.Step();
        world.AssertAwake([platform, .. stack]);
        Assert.All(stack, body => Assert.InRange(world.Bodies[body].Velocity.Linear.Y, .5f, 1.5f));
        world.Step(60);
        Assert.Equal(world.Bodies[platform].Pose.Position.Y + 1, world.Bodies[stack[0]].Pose.Position.Y, .02f);
        Assert.All(other, body => Assert.False(world.IsAwake(body)));
    }

    [Fact]
    public void A_platform_that_was_put_elsewhere_wakes_what_stood_on_it()
    {
        using var world = new SleepWorld();
        var platform = world.AddPlatform(new Vector3(0, 5, 0));
        var stack = world.AddStack(0, 3, 5.5f);
        world.Settle();
        Wake(world.Bodies[platform]);
        world.Step();
        world.AssertAwake(platform);
        world.Bodies[platform].Pose.Position.X = 20;
        world.Step();
        world.AssertAwake([platform, .. stack]);
        world.Step(200);
        Assert.Equal(.5f, world.Bodies[stack[0]].Pose.Position.Y, .02f);
    }

    // A door has been turned by its orientation alone. It passed through what slept.
    [Theory, InlineData(false), InlineData(true)]
    public void What_is_turned_by_its_pose_wakes_what_it_meets_and_stays_awake(bool describes)
    {
        using var world = new SleepWorld();
        var door = world.AddPlatform(new Vector3(0, .5f, 0));
        var cube = world.AddCube(new Vector3(1.2f, .5f, 2.1f));
        world.Settle();
        Wake(world.Bodies[door]);
        for (int i = 0; i < 60; ++i)
        {
            var description = world.Bodies.GetDescription(door);
            description.Pose.Orientation = Quaternion.CreateFromAxisAngle(Vector3.UnitY, -.012f * i);
            if (describes)
                world.Bodies.ApplyDescription(door, description);
            else
                world.Bodies[door].Pose.Orientation = description.Pose.Orientation;
            world.Step();
        }
        world.AssertAwake(door, cube);
        // The corner of the door, 1.5 m along and aside, has turned by .71: to .17 along and 2.11 aside, where the cube was up to 1.6.
        Assert.InRange(world.Bodies[cube].Pose.Position.Z, 2.3f, 4);
        // Once it is not turned any more, both sleep.
        world.Step(120);
        world.AssertAwake();
    }

    [Fact]
    public void A_body_that_lands_on_a_sleeping_platform_wakes_it_and_nobody_else_there()
    {
        using var world = new SleepWorld();
        var platform = world.AddPlatform(new Vector3(0, 5, 0));
        var still = world.AddCube(new Vector3(-.9f, 6, 0));
        world.Settle();
        var falling = world.AddCube(new Vector3(.9f, 6.5f, 0));
        world.Step(30);
        world.AssertAwake(platform, falling);
        Assert.False(world.IsAwake(still));
        world.Settle();
    }

    [Fact]
    public void What_stands_on_a_static_that_is_removed_falls_at_once()
    {
        using var world = new SleepWorld();
        var stack = world.AddStack(0, 3);
        world.Settle();
        world.World.Statics.Remove(world.Floor);
        world.AssertAwake(stack);
        world.Step();
        Assert.All(stack, body => Assert.InRange(world.Bodies[body].Velocity.Linear.Y, -.2f, -.1f));
    }

    [Fact]
    public void What_has_rested_for_long_does_not_sleep_when_its_ground_goes()
    {
        using var world = new SleepWorld();
        var stack = world.AddStack(0, 2);
        // Rests for as long as it needs, and is held awake by its neighbour.
        world.Bodies[stack[1]].Activity.SleepThreshold = -1;
        world.Step(50);
        Assert.True(world.Bodies[stack[0]].Activity.SleepCandidate);
        world.World.Statics.Remove(world.Floor);
        world.Bodies.Remove(stack[1]);
        world.Step(5);
        Assert.InRange(world.Bodies[stack[0]].Pose.Position.Y, 0, .49f);
    }

    [Fact]
    public void A_filter_chooses_who_wakes_with_a_static()
    {
        using var world = new SleepWorld();
        var stacks = new[] { world.AddStack(-10, 2), world.AddStack(0, 2) };
        var platform = world.AddPlatform(new Vector3(20, .45f, 0));
        world.Settle();
        var nobody = default(StaticsShouldntAwakenBodies);
        var description = world.World.Statics.GetDescription(world.Floor);
        world.World.Statics.ApplyDescription(world.Floor, description, ref nobody);
        var added = world.World.Statics.AddWithoutAwakeningBodies(description);
        world.World.Statics.Remove(added, ref nobody);
        world.AssertAwake();
        var one = new One { Chosen = stacks[1][0], Asked = [] };
        world.World.Statics.SetShape(world.Floor, world.Simulation.Shapes.Add(new Box(100, 2, 100)), ref one);
        world.AssertAwake(stacks[1]);
        Assert.Equal([platform, stacks[0][0], stacks[1][0]], one.Asked.Distinct().OrderBy(body => body.Slot == platform.Slot ? -1 : body.Slot));
        world.World.Statics.ApplyDescription(world.Floor, description);
        world.AssertAwake(stacks[0].Concat(stacks[1]));
    }

    struct One : IStaticChangeAwakeningFilter
    {
        public BodyHandle Chosen;
        public List<BodyHandle> Asked;

        public readonly bool AllowAwakening => true;

        public readonly bool ShouldAwaken(BodyReference body)
        {
            Asked.Add(body.Handle);
            return body.Handle == Chosen;
        }
    }

    [Fact]
    public void A_static_whose_pose_was_written_wakes_who_is_there_with_its_bounds()
    {
        using var world = new SleepWorld();
        var stacks = new[] { world.AddStack(-10, 2), world.AddStack(0, 2), world.AddStack(10, 2) };
        var post = world.World.AddStatic(new Box(.5f, 1, .5f), new RigidPose(new Vector3(-9.25f, .5f, 0)));
        world.Settle();
        var reference = world.World.Statics[post];
        reference.Pose.Position = new Vector3(.75f, .5f, 0);
        world.AssertAwake();
        reference.UpdateBounds();
        world.AssertAwake(stacks[0].Concat(stacks[1]));
    }

    [Fact]
    public void A_joint_wakes_both_of_its_islands()
    {
        using var world = new SleepWorld();
        var stacks = new[] { world.AddStack(-5, 2), world.AddStack(0, 2), world.AddStack(5, 2) };
        world.Settle();
        var limit = new DistanceLimit { MinimumDistance = 1, MaximumDistance = 20, SpringSettings = new(30, 1) };
        var joint = world.World.Solver.Add(stacks[0][1], stacks[2][1], limit);
        world.AssertAwake(stacks[0].Concat(stacks[2]));
        world.Settle();
        Assert.Equal(2, world.Simulation.Awakener.SleepingIslandCount);
        world.World.Solver.ApplyDescriptionWithoutWaking(joint, limit with { MaximumDistance = 21 });
        world.AssertAwake();
        world.World.Solver.ApplyDescription(joint, limit with { MaximumDistance = 22 });
        world.AssertAwake(stacks[0].Concat(stacks[2]));
        world.World.Solver.GetDescription<DistanceLimit>(joint, out var description);
        Assert.Equal(22, description.MaximumDistance);
        world.Settle();
        world.World.Solver.Remove(joint);
        world.AssertAwake(stacks[0].Concat(stacks[2]));
    }

    [Fact]
    public void Sleepers_are_removed_like_others_and_what_stood_on_them_falls()
    {
        using var world = new SleepWorld();
        var stack = world.AddStack(0, 3);
        var other = world.AddStack(5, 1);
        world.Settle();
        world.Bodies.Remove(stack[0]);
        world.Simulation.Validate();
        world.AssertAwake(stack[1], stack[2]);
        world.Step(90);
        Assert.Equal(.5f, world.Bodies[stack[1]].Pose.Position.Y, .02f);
        world.Bodies.Remove(other[0]);
        world.Simulation.Validate();
        world.Settle();
        Assert.Equal(2, world.Bodies.CountBodies());
    }

    [Fact]
    public void All_wake_when_they_are_told_to()
    {
        using var world = new SleepWorld();
        var stacks = world.AddStack(-5, 3).Concat(world.AddStack(5, 2)).ToArray();
        world.Settle();
        world.Simulation.Awakener.AwakenAll();
        world.AssertAwake(stacks);
        world.Settle();
        world.Simulation.Awakener.AwakenSet(0);
        world.AssertAwake();
        world.Simulation.Awakener.AwakenSet(1);
        world.AssertAwake(stacks);
        Assert.Throws<ArgumentOutOfRangeException>(() => world.Simulation.Awakener.AwakenSet(2));
        Assert.Throws<ArgumentOutOfRangeException>(() => world.Simulation.Awakener.AwakenSet(-1));
        world.Settle();
        var pool = world.World.Pool;
        var sets = new QuickList<int>(4, pool);
        sets.Add(1, pool);
        sets.Add(2, pool);
        Assert.Throws<ArgumentOutOfRangeException>(() => world.Simulation.Awakener.AwakenSets(ref sets));
        world.AssertAwake();
        sets.Pop();
        sets.Add(0, pool);
        world.Simulation.Awakener.AwakenSets(ref sets);
        world.AssertAwake(stacks);
        sets.Dispose(pool);
    }

    [Fact]
    public void Nothing_sags_that_wakes_and_sleeps_a_thousand_times()
    {
        using var world = new SleepWorld();
        var stack = world.AddStack(0, 10);
        world.Settle();
        var poses = Array.ConvertAll(stack, body => world.Bodies[body].Pose);
        for (int i = 0; i < 1000; ++i)
        {
            Wake(world.Bodies[stack[i % stack.Length]]);
            var sleeping = world.Bodies[stack[0]];
            sleeping.Awake = false;
        }
        for (int i = 0; i < stack.Length; ++i)
            Assert.Equal(poses[i], world.Bodies[stack[i]].Pose);
        world.Simulation.Validate();
        world.Bodies[stack[0]].ApplyLinearImpulse(default);
        for (int step = 0; step < 60; ++step)
        {
            world.Step();
            for (int i = 0; i < stack.Length; ++i)
                Assert.InRange(Vector3.Distance(poses[i].Position, world.Bodies[stack[i]].Pose.Position), 0, 1e-4f);
        }
    }

    [Fact]
    public void A_pose_that_is_no_number_does_not_sleep()
    {
        using var world = new SleepWorld();
        var stack = world.AddStack(0, 3);
        world.Step();
        world.Bodies[stack[1]].Pose.Position.X = float.NaN;
        var top = world.Bodies[stack[2]];
        Assert.Throws<InvalidOperationException>(() => top.Awake = false);
        world.AssertAwake(stack);
        world.Step();
        Assert.Equal(1, world.Simulation.Quarantine.Count);
        // Written while it sleeps, it is found when it wakes.
        world.Settle();
        world.Bodies[stack[1]].Pose.Position.X = float.NaN;
        Wake(world.Bodies[stack[1]]);
        world.Step();
        Assert.Equal([stack[1]], world.Simulation.Quarantine.Bodies.ToArray());
        Assert.Equal(1.5f, world.Bodies[stack[1]].Pose.Position.Y, .01f);
    }
}
