using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Xunit;

namespace DemoTests.Scenes;

/// <summary>Steps in which so much changes that many threads take part in all of it, and bodies that touch hundreds of others.</summary>
public class ManyChangesTests
{
    static readonly int[] threadCounts = [2, 3, 5, 8];

    [Fact]
    public void Hundreds_of_contacts_that_come_and_go_do_not_depend_on_threads()
    {
        var expected = Run(1, 50, out int mostChanges);
        // Else nothing is shared, and the test says nothing.
        Assert.True(mostChanges > 300, $"{mostChanges} pairs came or went in a step");
        foreach (int threads in threadCounts)
            Assert.Equal(expected, Run(threads, 50, out _));
    }

    static List<ulong> Run(int threads, int steps, out int mostChanges)
    {
        using var world = new TestWorld(threads: threads);
        world.AddStatic(new Box(60, 1, 60), new RigidPose(new Vector3(0, -.5f, 0)));
        var random = new Random(5);
        for (int i = 0; i < 1000; ++i)
        {
            var pose = new RigidPose(new Vector3(i % 10, 1 + i / 100, i / 10 % 10) * 1.05f, TestWorld.Turn(random));
            world.AddDynamic(new Box(.9f, .7f, .8f), 1, pose, new BodyVelocity(TestWorld.Scatter(random, 12), TestWorld.Scatter(random, 12)));
        }
        var hashes = new List<ulong>();
        mostChanges = 0;
        for (int i = 0; i < steps; ++i)
        {
            int before = world.Simulation.NarrowPhase.PairCount;
            world.Step();
            mostChanges = Math.Max(mostChanges, Math.Abs(world.Simulation.NarrowPhase.PairCount - before));
            hashes.Add(world.Simulation.StateHash());
        }
        world.Simulation.Validate();
        return hashes;
    }

    /// <summary>Where more is new than there is, one thread leaves what constraints hold for later, too; some of what there is changes beside.</summary>
    [Fact]
    public void More_new_contacts_than_there_are_do_not_depend_on_threads()
    {
        var expected = RunCrowdThatComes(1);
        foreach (int threads in threadCounts)
            Assert.Equal(expected, RunCrowdThatComes(threads));
    }

    static List<ulong> RunCrowdThatComes(int threads)
    {
        const int few = 40, many = 400;
        using var world = new TestWorld(threads: threads);
        world.AddStatic(new Box(100, 1, 100), new RigidPose(new Vector3(0, -.5f, 0)));
        var box = new Box(1, 1, 1);
        for (int i = 0; i < few; ++i)
            world.AddDynamic(box, 1 + i, new RigidPose(new Vector3(2 * (i % 20), .5f, -3 * (i / 20))));
        var hashes = world.HashSteps(5);
        Assert.Equal(few, world.Simulation.NarrowPhase.PairCount);
        // Tipped on an edge, which has two contacts, with what the four have carried; every fifth is lifted off.
        for (int i = 0; i < few; ++i)
        {
            var body = world.Bodies[new BodyHandle(i)];
            body.Pose.Orientation = Quaternion.CreateFromAxisAngle(Vector3.UnitX, .3f);
            body.Pose.Position.Y = i % 5 == 0 ? 3 : .62f;
        }
        for (int i = 0; i < many; ++i)
            world.AddDynamic(box, 1, new RigidPose(new Vector3(2 * (i % 20), .5f, 3 + 2 * (i / 20))));
        hashes.AddRange(world.HashSteps(5));
        // Both kinds of changes came in one step, or the test says nothing.
        Assert.Equal(few - few / 5 + many, world.Simulation.NarrowPhase.PairCount);
        world.Simulation.Validate();
        return hashes;
    }

    [Fact]
    public void A_plate_on_hundreds_of_pebbles_does_not_depend_on_threads()
    {
        var expected = RunPlate(1);
        foreach (int threads in threadCounts)
            Assert.Equal(expected, RunPlate(threads));
    }

    static List<ulong> RunPlate(int threads)
    {
        const int width = 20;
        using var world = new TestWorld(threads: threads);
        world.AddStatic(new Box(60, 1, 60), new RigidPose(new Vector3(0, -.5f, 0)));
        for (int i = 0; i < width * width; ++i)
            world.AddDynamic(new Sphere(.25f), 1, new RigidPose(new Vector3(i % width * .55f, .25f, i / width * .55f)));
        world.AddDynamic(new Box(width * .55f, .5f, width * .55f), 100, new RigidPose(new Vector3((width - 1) * .275f, .8f, (width - 1) * .275f)),
            new BodyVelocity(new Vector3(1, 0, 0)));
        var hashes = world.HashSteps(40);
        // The test is about a body that has more contacts than there are batches.
        Assert.True(world.Solver.ActiveSet.Batches.Count > world.Solver.FallbackBatchThreshold);
        return hashes;
    }
}
