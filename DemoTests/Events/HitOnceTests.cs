using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Events;

/// <summary>
/// A fall is told of as one hit, with all that it pushed, wherever in a step surfaces meet: what a soft contact has left of the approach when the step ends is
/// no second hit.
/// </summary>
public class HitOnceTests(ITestOutputHelper output)
{
    [Theory]
    [InlineData(Falling.Ball)]
    [InlineData(Falling.FlatBox)]
    [InlineData(Falling.BoxOnEdge)]
    [InlineData(Falling.BallOnMesh)]
    public void A_fall_is_one_hit_with_the_whole_change_of_momentum(Falling falling)
    {
        int later = 0;
        var worst = (Momentum: 0.0, Speed: 0.0);
        for (int seed = 0; seed < 40; ++seed)
        {
            var random = new Random(seed);
            var dt = 1f / random.Next(30, 241);
            using var world = new FallingWorld(falling, .3f + 4 * random.NextSingle());
            // Newton: what pushed is what changed the momentum, less gravity.
            float pushed = 0;
            bool hasBegun = false;
            ContactEvent? hit = null;
            for (float time = 0; hit is null && time < 2; time += dt)
            {
                var before = world.Velocity;
                world.Simulation.Timestep(dt);
                pushed += FallingWorld.Mass * (world.Velocity - before + FallingWorld.Gravity * dt);
                later += hasBegun ? 1 : 0;
                hasBegun |= world.Simulation.Events.Began.Length > 0;
                hit = OnlyHit(world);
            }
            Assert.NotNull(hit);
            var told = hit.Value;
            worst.Momentum = Math.Max(worst.Momentum, Math.Abs(told.Impulse / pushed - 1));
            // What leaves again has been pushed by more; a twentieth may be left, and an edge turns as it is hit.
            Assert.InRange(told.Impulse, .9f * FallingWorld.Mass * told.ApproachSpeed, 1.2f * FallingWorld.Mass * told.ApproachSpeed);
            Assert.Equal(1, told.Normal.Y, 1e-3);
            // The rebound is slower than a hit, so nothing follows.
            for (int i = 0; i < 3; ++i)
            {
                world.Simulation.Timestep(dt);
                Assert.Null(OnlyHit(world));
            }
        }
        output.WriteLine($"wrong by {worst.Momentum:e1} of the momentum, told a step later {later} times of 40");
        Assert.InRange(worst.Momentum, 0, 2e-3);
        // The case is there: some meet so late in a step that it ends before their hit.
        Assert.InRange(later, 4, 36);
    }

    [Fact]
    public void What_meets_in_the_air_is_one_hit()
    {
        for (int seed = 0; seed < 40; ++seed)
        {
            var random = new Random(seed);
            using var pool = new BufferPool();
            using var simulation = Simulation.Create(
                pool, new DefaultNarrowPhaseCallbacks(), new DefaultPoseIntegratorCallbacks(default), SolveDescription.Default);
            var masses = new Vector2(1 + 9 * random.NextSingle(), 1 + 9 * random.NextSingle());
            var speed = 2 + 8 * random.NextSingle();
            var shape = new Sphere(.5f);
            var a = simulation.Bodies.Add(BodyDescription.CreateConvexDynamic(
                new Vector3(-1 - random.NextSingle(), 0, 0), new BodyVelocity(new Vector3(speed, 0, 0)), masses.X, simulation.Shapes, shape));
            simulation.Bodies.Add(BodyDescription.CreateConvexDynamic(default(Vector3), masses.Y, simulation.Shapes, shape));
            simulation.Events.Listen(a, EventMask.Hit);
            var impulses = new List<float>();
            for (int i = 0; i < 120; ++i)
            {
                simulation.Timestep(1 / 60f);
                foreach (ref readonly var hit in simulation.Events.Hits)
                    impulses.Add(hit.Impulse);
            }
            // Their common speed takes the reduced mass times the speed of approach.
            var reduced = masses.X * masses.Y / (masses.X + masses.Y);
            Assert.Single(impulses);
            Assert.InRange(impulses[0], .95f * reduced * speed, 1.2f * reduced * speed);
        }
    }

    [Fact]
    public void Who_is_removed_in_the_midst_of_a_hit_has_hit()
    {
        using var world = InTheMidstOfAHit(out var dt);
        world.Simulation.Bodies.Remove(world.Body);
        world.Simulation.Timestep(dt);
        var hit = OnlyHit(world);
        Assert.NotNull(hit);
        Assert.Equal(world.Body, hit.Value.Pair.A.BodyHandle);
        Assert.InRange(hit.Value.Impulse, 1e-3f, float.MaxValue);
        Assert.Equal(0, world.Simulation.Events.Contacts(hit.Value).Length);
        Assert.Equal(1, world.Simulation.Events.Ended.Length);
        world.Simulation.Timestep(dt);
        Assert.Null(OnlyHit(world));
    }

    [Fact]
    public void Who_is_listened_to_no_more_is_not_told_of()
    {
        using var world = InTheMidstOfAHit(out var dt);
        world.Simulation.Events.Listen(world.Body, EventMask.Begin);
        for (int i = 0; i < 3; ++i)
        {
            world.Simulation.Timestep(dt);
            Assert.Null(OnlyHit(world));
        }
    }

    [Fact]
    public void Who_is_put_to_sleep_in_the_midst_of_a_hit_has_hit()
    {
        using var world = InTheMidstOfAHit(out var dt);
        var body = world.Simulation.Bodies[world.Body];
        body.Awake = false;
        world.Simulation.Timestep(dt);
        Assert.NotNull(OnlyHit(world));
        world.Simulation.Timestep(dt);
        Assert.Null(OnlyHit(world));
    }

    [Fact]
    public void A_world_that_is_restored_in_the_midst_of_a_hit_tells_the_same()
    {
        using var world = InTheMidstOfAHit(out var dt);
        using var snapshot = new SimulationSnapshot(world.Simulation.BufferPool);
        world.Simulation.Save(snapshot);
        world.Simulation.Timestep(dt);
        var told = OnlyHit(world);
        Assert.NotNull(told);
        world.Simulation.Timestep(dt);
        world.Simulation.Restore(snapshot);
        world.Simulation.Timestep(dt);
        var again = OnlyHit(world);
        Assert.NotNull(again);
        Assert.Equal(told.Value.Impulse, again.Value.Impulse);
        Assert.Equal(told.Value.ApproachSpeed, again.Value.ApproachSpeed);
        Assert.Equal(told.Value.Position, again.Value.Position);
    }

    // A step in which a ball begins to touch, and is not told of as a hit yet.
    static FallingWorld InTheMidstOfAHit(out float dt)
    {
        dt = 1 / 60f;
        for (int i = 0; i < 100; ++i)
        {
            var world = new FallingWorld(Falling.Ball, 2 + .01f * i);
            while (world.Simulation.Events.Began.Length == 0)
                world.Simulation.Timestep(dt);
            if (world.Simulation.Events.Hits.Length == 0)
                return world;
            world.Dispose();
        }
        throw new InvalidOperationException("All hits of a hundred falls were told of in the step in which they began.");
    }

    static ContactEvent? OnlyHit(FallingWorld world)
    {
        var hits = world.Simulation.Events.Hits;
        Assert.InRange(hits.Length, 0, 1);
        return hits.Length == 0 ? null : hits[0];
    }
}
