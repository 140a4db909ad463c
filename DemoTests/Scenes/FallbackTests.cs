using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using Demos.Accuracy;
using Demos.References;
using Demos.Stages;
using Xunit;

namespace DemoTests.Scenes;

/// <summary>Bodies with more constraints than there are batches.</summary>
public class FallbackTests
{
    const int ArmCount = 200;
    const float Radius = 2;
    // The arms are 400 kg.
    const float LightHub = 20;
    const float HeavyHub = 100;
    static readonly AccuracySettings weightless = new() { Gravity = Vector3.Zero, Contacts = ContactScope.None };

    [Fact]
    public void A_hub_with_moving_arms_keeps_its_momentum_and_its_joints()
    {
        using var world = new TestWorld(weightless);
        var bodies = AddHub(world, speed: 1);
        AssertKeepsMomentum(world, bodies, 120);
        Assert.InRange(GreatestError(world, bodies), 0, .1);
    }

    /// <summary>The same with a hub that is heavier, for longer, and with relaxations, which sweep the fallback batch as well.</summary>
    // The energy is that of motion, without what the joints hold for a while; and the arms start with velocities that the joints do not allow.
    [Theory]
    [InlineData(0)]
    [InlineData(1)]
    [InlineData(2)]
    public void A_heavy_hub_with_moving_arms_gains_no_energy(int relaxations)
    {
        using var world = new TestWorld(weightless with { RelaxationCount = relaxations });
        var bodies = AddHub(world, speed: 1, HeavyHub);
        double start = Energy(world, bodies);
        AssertKeepsMomentum(world, bodies, 60);
        double settled = Energy(world, bodies), highest = settled;
        Assert.InRange(settled, .5 * start, start);
        AssertKeepsMomentum(world, bodies, 300, () => highest = Tally.Most(highest, Energy(world, bodies)));
        Assert.True(highest < 1.0002 * settled, $"energy rose from {settled} to {highest}");
        Assert.InRange(GreatestError(world, bodies), 0, .002);
    }

    [Theory]
    [InlineData(0)]
    [InlineData(1)]
    [InlineData(2)]
    public void A_hub_at_rest_stays_at_rest(int relaxations)
    {
        using var world = new TestWorld(weightless with { RelaxationCount = relaxations });
        var bodies = AddHub(world, speed: 0);

        world.Step(60);

        AssertHasFallback(world);
        foreach (var body in bodies)
            Assert.InRange(world.Bodies[body].Velocity.Linear.Length() + world.Bodies[body].Velocity.Angular.Length(), 0, 1e-4);
        Assert.InRange(world.Bodies[bodies[0]].Pose.Position.Length(), 0, 1e-5);
    }

    [Theory]
    [InlineData(0)]
    [InlineData(1)]
    [InlineData(2)]
    public void Threads_do_not_change_the_hub(int relaxations) =>
        AssertSameForThreads(world => AddHub(world, speed: 1), weightless with { RelaxationCount = relaxations }, 60);

    /// <summary>A body with very many parts is a block of its own, the first one: whoever began with it last would keep all others waiting.</summary>
    [Fact]
    public void The_parts_of_a_hub_are_summed_beside_those_of_its_arms()
    {
        using var world = new TestWorld(weightless, fallbackBatchThreshold: 4);
        AddHub(world, speed: 1);
        var counts = new List<int>();
        using var dispatcher = new ObservingDispatcher(2, (blocks, _, _) => counts.Add(blocks));
        world.Simulation.Timestep(1 / 60f, dispatcher);
        ref var batches = ref world.Solver.ActiveSet.Batches;
        var parts = batches[Solver.FindBatch(world.Solver.ActiveSet, BatchKind.Fallback)].CountConstraints();
        Assert.True(parts > 3 * 64, $"{parts} parts");
        // Of the arms 64 are a block. No other stage has so many.
        Assert.Equal(2 * world.Solver.SubstepCount, counts.FindAll(blocks => blocks == 1 + (parts + 63) / 64).Count);
    }

    /// <summary>The order in which the batches of a hub are solved is random: each time in the same way.</summary>
    [Fact]
    public void A_cleared_simulation_repeats_the_hub_to_the_bit()
    {
        using var world = new TestWorld(weightless);
        AddHub(world, speed: 1);
        var expected = world.HashSteps(30);
        world.Simulation.Clear();
        AddHub(world, speed: 1);
        Assert.Equal(expected, world.HashSteps(30));
    }

    [Theory]
    [InlineData(0)]
    [InlineData(1)]
    [InlineData(2)]
    public void Three_hundred_boxes_rest_on_one(int relaxations)
    {
        using var world = new TestWorld(new AccuracySettings { RelaxationCount = relaxations });
        var bodies = AddLoadedTable(world);

        world.Step(180);

        AssertHasFallback(world);
        world.Simulation.Validate();
        foreach (var body in bodies)
        {
            var velocity = world.Bodies[body].Velocity;
            Assert.True(velocity.Linear.Length() < .02f && velocity.Angular.Length() < .05f, $"{body} moves with {velocity.Linear}, {velocity.Angular}");
        }
        Assert.Equal(1, world.Bodies[bodies[0]].Pose.Position.Y, .02f);
        for (int i = 1; i < bodies.Count; ++i)
            Assert.Equal(2.25f, world.Bodies[bodies[i]].Pose.Position.Y, .03f);
    }

    [Theory]
    [InlineData(0)]
    [InlineData(1)]
    [InlineData(2)]
    public void Threads_do_not_change_the_loaded_table(int relaxations) =>
        AssertSameForThreads(world => AddLoadedTable(world), new AccuracySettings { RelaxationCount = relaxations }, 60);

    [Fact]
    public void Removing_constraints_empties_the_fallback_batch_and_a_body_can_leave_it()
    {
        using var world = new TestWorld(weightless);
        var bodies = AddHub(world, speed: 1);
        world.Step(5);
        for (int i = 1; i < bodies.Count; i += 2)
        {
            world.Bodies.Remove(bodies[i]);
            world.Simulation.Validate();
        }
        world.Step(5);
        world.Bodies[bodies[0]].BecomeKinematic();
        world.Simulation.Validate();
        // Joints to a kinematic hub have no dynamic body in common.
        Assert.Equal(ArmCount / 2, world.Solver.ActiveSet.Batches[0].CountConstraints());
        world.Step(5);
        world.Bodies.Remove(bodies[0]);
        world.Simulation.Validate();
        Assert.Equal(0, world.Solver.CountConstraints());
    }

    static void AssertHasFallback(TestWorld world)
    {
        ref var batches = ref world.Solver.ActiveSet.Batches;
        var fallback = batches[Solver.FindBatch(world.Solver.ActiveSet, BatchKind.Fallback)];
        Assert.True(fallback.CountConstraints() > ArmCount / 4, $"{fallback.CountConstraints()} of {world.Solver.CountConstraints()}");
    }

    static void AssertKeepsMomentum(TestWorld world, List<BodyHandle> bodies, int steps, Action? afterStep = null)
    {
        var (linear, angular, scale) = Momentum(world, bodies);
        for (int i = 0; i < steps; ++i)
        {
            world.Step();
            var (nowLinear, nowAngular, _) = Momentum(world, bodies);
            Assert.True((nowLinear - linear).Length < 1e-4 * scale, $"momentum {nowLinear}, was {linear}, after {i + 1} steps");
            Assert.True((nowAngular - angular).Length < 5e-3 * scale * Radius, $"angular momentum {nowAngular}, was {angular}, after {i + 1} steps");
            afterStep?.Invoke();
        }
        AssertHasFallback(world);
        world.Simulation.Validate();
    }

    static void AssertSameForThreads(Action<TestWorld> add, AccuracySettings settings, int steps)
    {
        List<ulong>? expected = null;
        for (int threads = 1; threads <= 3; ++threads)
        {
            using var world = new TestWorld(settings, threads);
            add(world);
            var hashes = world.HashSteps(steps);
            expected ??= hashes;
            Assert.Equal(expected, hashes);
        }
    }

    // The hub comes first. Arms lie around it on a spiral, about evenly.
    static List<BodyHandle> AddHub(TestWorld world, float speed, float mass = LightHub)
    {
        var random = new Random(8);
        var bodies = new List<BodyHandle> { world.AddDynamic(new Sphere(.5f), mass, RigidPose.Identity) };
        for (int i = 0; i < ArmCount; ++i)
        {
            double y = 1 - (2 * i + 1) / (double)ArmCount, r = Math.Sqrt(1 - y * y), turn = i * Math.PI * (3 - Math.Sqrt(5));
            var direction = new Vector3((float)(r * Math.Cos(turn)), (float)y, (float)(r * Math.Sin(turn)));
            var velocity = new BodyVelocity(TestWorld.Scatter(random, 2) * speed, TestWorld.Scatter(random, 2) * speed);
            var arm = world.AddDynamic(new Sphere(.25f), 1 + i % 3, new RigidPose(direction * Radius), velocity);
            world.Solver.Add(bodies[0], arm, new BallSocket { LocalOffsetA = direction * .5f, LocalOffsetB = direction * (.5f - Radius) });
            bodies.Add(arm);
        }
        return bodies;
    }

    static List<BodyHandle> AddLoadedTable(TestWorld world)
    {
        world.AddStatic(new Box(60, 2, 60), new RigidPose(new Vector3(0, -1, 0)));
        var bodies = new List<BodyHandle> { world.AddDynamic(new Box(24, 2, 18), 500, new RigidPose(new Vector3(0, 1, 0))) };
        var box = new Box(.5f, .5f, .5f);
        for (int i = 0; i < 300; ++i)
            bodies.Add(world.AddDynamic(box, 1, new RigidPose(new Vector3((i % 20 - 9.5f) * 1.1f, 2.25f, (i / 20 - 7) * 1.1f))));
        return bodies;
    }

    static (Double3 Linear, Double3 Angular, double Scale) Momentum(TestWorld world, List<BodyHandle> bodies)
    {
        Double3 linear = Double3.Zero, angular = Double3.Zero;
        double scale = 0;
        foreach (var handle in bodies)
        {
            var body = world.Bodies[handle];
            double mass = 1.0 / body.LocalInertia.InverseMass, moment = 1.0 / body.LocalInertia.InverseInertiaTensor.XX;
            Double3 momentum = (Double3)body.Velocity.Linear * mass;
            linear += momentum;
            // Spheres: the moment is the same about all axes.
            angular += Double3.Cross(body.Pose.Position, momentum) + (Double3)body.Velocity.Angular * moment;
            scale += momentum.Length;
        }
        return (linear, angular, scale);
    }

    static double Energy(TestWorld world, List<BodyHandle> bodies)
    {
        double sum = 0;
        foreach (var handle in bodies)
        {
            var body = world.Bodies[handle];
            double mass = 1.0 / body.LocalInertia.InverseMass, moment = 1.0 / body.LocalInertia.InverseInertiaTensor.XX;
            double speed = ((Double3)body.Velocity.Linear).Length, spin = ((Double3)body.Velocity.Angular).Length;
            sum += .5 * (mass * speed * speed + moment * spin * spin);
        }
        return sum;
    }

    static double GreatestError(TestWorld world, List<BodyHandle> bodies)
    {
        double greatest = 0;
        for (int i = 0; i < ArmCount; ++i)
        {
            world.Solver.GetDescription<BallSocket>(world.Bodies[bodies[i + 1]].Constraints[0].ConnectingConstraintHandle, out var joint);
            RigidPose.Transform(joint.LocalOffsetA, world.Bodies[bodies[0]].Pose, out var a);
            RigidPose.Transform(joint.LocalOffsetB, world.Bodies[bodies[i + 1]].Pose, out var b);
            greatest = Math.Max(greatest, (a - b).Length());
        }
        return greatest;
    }
}
