using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuUtilities;
using BepuUtilities.Memory;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Robustness;

/// <summary>What a step may take is bounded where very many bodies are in one place, and nothing is left out anywhere else.</summary>
public class CrowdTests
{
    const int CrowdSize = 2500;
    // Bodies meet those that are up to 32 places away in the order of handles.
    const long Kept = CrowdSize * 32 - 32 * 33 / 2;
    const long Skipped = (long)CrowdSize * (CrowdSize - 1) / 2 - Kept;

    [Theory]
    [InlineData("box")]
    [InlineData("sphere")]
    public void Bodies_in_one_place_take_bounded_memory_and_give_the_same_bits_on_any_threads(string shape)
    {
        List<ulong>? expected = null;
        for (int threads = 1; threads < 4; threads += 2)
        {
            using var world = new TestWorld(threads: threads);
            AddCrowd(world, shape);
            List<ulong> hashes = [];
            for (int step = 0; step < 4; ++step)
            {
                world.Step();
                hashes.Add(world.Simulation.StateHash());
                if (step < 2)
                {
                    // Nothing has left the others by then.
                    Assert.Equal(Skipped, world.Simulation.NarrowPhase.SkippedPairCount);
                    Assert.Equal(Kept, world.Simulation.NarrowPhase.PairCount);
                }
                world.Simulation.Validate();
            }
            // All pairs would take 2.3 GB.
            Assert.InRange(world.Pool.GetTotalAllocatedByteCount(), 0ul, 250ul << 20);
            expected ??= hashes;
            Assert.Equal(expected, hashes);
        }
    }

    [Fact]
    public void A_crowd_that_goes_away_leaves_nothing_behind()
    {
        using var world = new TestWorld();
        var crowd = AddCrowd(world, "sphere");
        world.Step(2);
        Assert.Equal(Skipped, world.Simulation.NarrowPhase.SkippedPairCount);
        for (int i = 100; i < CrowdSize; ++i)
            world.Bodies.Remove(crowd[i]);
        world.Step();
        Assert.Equal(0, world.Simulation.NarrowPhase.SkippedPairCount);
        world.Simulation.Validate();
    }

    // The crowd makes the narrow phase begin again, and the impulses of all contacts are forgotten once: a pile hardly notices.
    [Theory, InlineData(1), InlineData(3)]
    public void Bodies_beside_a_crowd_stay_where_they_are(int threads)
    {
        using var world = new TestWorld(threads: threads);
        world.AddStatic(new Box(1000, 2, 1000), new RigidPose(new Vector3(0, -1, 0)));
        List<BodyHandle> pile = [];
        for (int i = 0; i < 60; ++i)
            pile.Add(world.AddDynamic(new Box(1, 1, 1), 1, new RigidPose(new Vector3(200 + i / 3 * 2, .5f + i % 3, 0))));
        world.Step(60);
        AddCrowd(world, "box");
        world.Step(2);
        Assert.Equal(Skipped, world.Simulation.NarrowPhase.SkippedPairCount);
        for (int i = 0; i < pile.Count; ++i)
        {
            var body = world.Bodies[pile[i]];
            Assert.Equal(.5f + i % 3, body.Pose.Position.Y, .005f);
            Assert.InRange(body.Velocity.Linear.Length(), 0, .1f);
        }
    }

    // As many pairs as bodies, all of them of one platform, whatever moves it: nothing is left out.
    [Theory]
    [InlineData(CollidableMobility.Dynamic)]
    [InlineData(CollidableMobility.Kinematic)]
    [InlineData(CollidableMobility.Static)]
    public void Any_number_of_bodies_may_lie_on_one_platform(CollidableMobility mobility)
    {
        using var world = new TestWorld();
        var platform = new Box(400, 2, 400);
        var pose = new RigidPose(new Vector3(0, -1, 0));
        if (mobility == CollidableMobility.Static)
            world.AddStatic(platform, pose);
        else if (mobility == CollidableMobility.Kinematic)
            world.AddKinematic(platform, pose);
        else
            world.AddDynamic(platform, 1e6f, pose);
        const int side = 150;
        for (int i = 0; i < side * side; ++i)
            world.AddDynamic(new Sphere(.5f), 1, new RigidPose(new Vector3(i % side * 2.5f - 187, .5f, i / side * 2.5f - 187)));
        world.Step(2);
        Assert.Equal(side * side, world.Simulation.NarrowPhase.PairCount);
        Assert.Equal(0, world.Simulation.NarrowPhase.SkippedPairCount);
    }

    [Fact]
    public void An_exception_while_pairs_are_left_out_costs_no_memory()
    {
        var fault = new Fault { Change = (ref c, ref _) => c.Count = 7 };
        using var pool = new BufferPool();
        using var dispatcher = new ThreadDispatcher(2);
        var simulation = Simulation.Create(
            pool, new FaultyContacts(fault), new Demos.Accuracy.WorldGravity(new()), new SolveDescription(1, 4));
        var sphere = new Sphere(.5f);
        var shape = simulation.Shapes.Add(sphere);
        for (int i = 0; i < CrowdSize; ++i)
        {
            simulation.Bodies.Add(
                BodyDescription.CreateDynamic(Vector3.Zero, sphere.ComputeInertia(1), shape, new BodyActivityDescription(-1)));
        }
        for (int i = 0; i < 2; ++i)
        {
            fault.Armed = true;
            Assert.Throws<InvalidOperationException>(() => simulation.Timestep(1 / 60f, dispatcher));
            simulation.Validate();
            fault.Armed = false;
            simulation.Timestep(1 / 60f, dispatcher);
            simulation.Validate();
        }
        simulation.Dispose();
        pool.AssertEmpty();
        dispatcher.WorkerPools.AssertEmpty();
    }

    static List<BodyHandle> AddCrowd(TestWorld world, string shape)
    {
        List<BodyHandle> bodies = [];
        for (int i = 0; i < CrowdSize; ++i)
        {
            var pose = new RigidPose(new Vector3(0, 20, 0));
            bodies.Add(shape == "box" ? world.AddDynamic(new Box(1, 1, 1), 1, pose) : world.AddDynamic(new Sphere(.5f), 1, pose));
        }
        return bodies;
    }
}
