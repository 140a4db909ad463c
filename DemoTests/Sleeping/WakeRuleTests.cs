using System;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Constraints;
using Xunit;

namespace DemoTests.Sleeping;

/// <summary>
/// One test for each rule of waking that <see cref="WakeTests"/> has no world for: of three stacks that sleep, with a joint, a post below and a
/// platform beside them each, exactly the one that is touched wakes.
/// </summary>
public sealed class WakeRuleTests : IDisposable
{
    const int Touched = 1;

    readonly SleepWorld world = new();
    readonly BodyHandle[][] stacks = new BodyHandle[3][];
    readonly ConstraintHandle[] joints = new ConstraintHandle[3];
    readonly StaticHandle[] posts = new StaticHandle[3];
    readonly BodyHandle[] platforms = new BodyHandle[3];

    public WakeRuleTests()
    {
        for (int i = 0; i < stacks.Length; ++i)
        {
            var x = 10f * (i - Touched);
            posts[i] = world.World.AddStatic(new Box(1.5f, 1, 1.5f), new RigidPose(new Vector3(x, .5f, 0)));
            stacks[i] = world.AddStack(x, 3, 1);
            joints[i] = world.World.Solver.Add(
                stacks[i][0], stacks[i][1], new BallSocket { LocalOffsetA = .5f * Vector3.UnitY, LocalOffsetB = -.5f * Vector3.UnitY });
            platforms[i] = world.AddPlatform(new Vector3(x, 1.5f, 5));
        }
        world.Settle();
        // A kinematic body is an island by itself.
        Assert.Equal(2 * stacks.Length, world.Simulation.Awakener.SleepingIslandCount);
    }

    BodyHandle[] Stack => stacks[Touched];

    Solver Solver => world.World.Solver;

    void AssertStackWoke()
    {
        world.Simulation.Validate();
        world.AssertAwake(Stack);
        Assert.All(Stack, body => Assert.Equal(0, world.Bodies[body].Activity.TimestepsUnderThresholdCount));
    }

    [Fact]
    public void Whether_jointed_bodies_collide()
    {
        Solver.SetCollideConnected(joints[Touched], true);
        world.AssertAwake();
        Solver.SetCollideConnected(joints[Touched], false);
        AssertStackWoke();
    }

    [Fact]
    public void What_a_joint_bears()
    {
        Solver.SetBreakThreshold(joints[Touched], new BreakThreshold(1000));
        AssertStackWoke();
    }

    [Fact]
    public void A_joint_that_is_disabled_and_enabled()
    {
        Solver.SetEnabled(joints[Touched], true);
        world.AssertAwake();
        Solver.SetEnabled(joints[Touched], false);
        AssertStackWoke();
        world.Settle();
        Solver.SetEnabled(joints[Touched], true);
        AssertStackWoke();
    }

    [Fact]
    public void A_joint_that_is_changed()
    {
        Solver.GetDescription<BallSocket>(joints[Touched], out var socket);
        Solver.ApplyDescriptionWithoutWaking(joints[Touched], socket);
        world.AssertAwake();
        Solver.ApplyDescription(joints[Touched], socket);
        AssertStackWoke();
    }

    [Fact]
    public void A_joint_that_is_removed()
    {
        Solver.Remove(joints[Touched]);
        AssertStackWoke();
    }

    [Fact]
    public void A_body_that_is_removed()
    {
        world.Bodies.Remove(Stack[1]);
        world.Simulation.Validate();
        world.AssertAwake(Stack[0], Stack[2]);
    }

    [Fact]
    public void A_static_that_is_removed()
    {
        world.World.Statics.Remove(posts[Touched]);
        AssertStackWoke();
        world.Step();
        Assert.All(Stack, body => Assert.InRange(world.Bodies[body].Velocity.Linear.Y, -.17f, -.15f));
    }

    [Fact]
    public void A_static_that_goes_elsewhere()
    {
        var description = world.World.Statics.GetDescription(posts[Touched]);
        description.Pose.Position.X += 100;
        world.World.Statics.ApplyDescription(posts[Touched], description);
        AssertStackWoke();
    }

    [Fact]
    public void A_static_with_another_shape()
    {
        world.World.Statics.SetShape(posts[Touched], world.Simulation.Shapes.Add(new Box(1.5f, .5f, 1.5f)));
        AssertStackWoke();
    }

    [Fact]
    public void Layers_of_a_body_and_of_a_static()
    {
        world.Simulation.Layers[Stack[1]] = new CollisionLayers(1, 1);
        AssertStackWoke();
        world.Settle();
        world.Simulation.Layers[posts[Touched]] = new CollisionLayers(2, 2);
        AssertStackWoke();
    }

    [Fact]
    public void What_becomes_a_sensor()
    {
        world.Simulation.Events.SetSensor(world.Bodies[Stack[1]].CollidableReference, true);
        AssertStackWoke();
    }

    [Fact]
    public void A_platform_that_comes_against_it()
    {
        var platform = world.Bodies[platforms[Touched]];
        platform.Awake = true;
        platform.Velocity.Linear.Z = -5;
        world.Step();
        world.AssertAwake(platforms[Touched]);
        // It has 3 m to go, and a step of 1/12 m more at most.
        for (int i = 0; i < 40 && !world.IsAwake(Stack[0]); ++i)
            world.Step();
        world.AssertAwake([platforms[Touched], .. Stack]);
        Assert.InRange(platform.Pose.Position.Z - 2, -.1f, .1f);
        Assert.InRange(world.Bodies[Stack[0]].Velocity.Linear.Z, -5.5f, 0);
    }

    [Fact]
    public void A_body_that_becomes_dynamic()
    {
        var description = world.Bodies.GetDescription(platforms[Touched]);
        description.LocalInertia = new Box(3, 1, 3).ComputeInertia(1);
        world.Bodies.ApplyDescription(platforms[Touched], description);
        world.Simulation.Validate();
        world.AssertAwake(platforms[Touched]);
    }

    [Fact]
    public void Listening_wakes_nobody()
    {
        world.Simulation.Events.Listen(Stack[1], EventMask.All);
        world.Step(3);
        world.AssertAwake();
    }

    /// <summary>What touches a body that sleeps, and is moved or removed, wakes it; what is far does not.</summary>
    [Fact]
    public void Only_the_islands_that_a_static_of_many_touches()
    {
        var description = world.World.Statics.GetDescription(posts[0]);
        world.World.Statics.ApplyDescription(posts[0], description);
        world.AssertAwake(stacks[0]);
        world.World.Statics.Remove(world.Floor);
        // Nobody stands on the floor: all bounds end above it.
        world.AssertAwake(stacks[0]);
        world.Simulation.Awakener.AwakenAll();
        world.AssertAwake(stacks.SelectMany(stack => stack).Concat(platforms));
    }

    public void Dispose() => world.Dispose();
}
