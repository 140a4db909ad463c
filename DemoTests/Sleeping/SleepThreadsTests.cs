using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Sleeping;

/// <summary>Hundreds of bodies that fall asleep in one step, and wake again, on many threads as on one.</summary>
public class SleepThreadsTests
{
    const int StackCount = 150;

    [Fact]
    public void Hundreds_that_fall_asleep_at_once_do_not_depend_on_threads()
    {
        var expected = Run(1, out int mostAsleep);
        // Else nothing is shared, and the test says nothing.
        Assert.True(mostAsleep > 200, $"{mostAsleep} bodies fell asleep in a step");
        foreach (int threads in (int[])[2, 3, 5, 8])
            Assert.Equal(expected, Run(threads, out _));
    }

    static List<ulong> Run(int threads, out int mostAsleep)
    {
        using var world = new TestWorld(threads: threads);
        world.AddStatic(new Box(100, 1, 100), new RigidPose(new Vector3(0, -.5f, 0)));
        var cube = new Box(1, 1, 1);
        var shape = world.Simulation.Shapes.Add(cube);
        var handles = new List<BodyHandle>();
        for (int i = 0; i < StackCount; ++i)
        {
            for (int height = 0; height < 2; ++height)
            {
                var pose = new RigidPose(new Vector3(2 * (i % 15), .5f + height, 2 * (i / 15)));
                handles.Add(world.Bodies.Add(BodyDescription.CreateDynamic(pose, cube.ComputeInertia(1), shape, new BodyActivityDescription(.01f, 8))));
            }
        }
        // On top of a stack: it sleeps when that does.
        world.Bodies.Add(BodyDescription.CreateKinematic(new RigidPose(new Vector3(0, 2.5f, 0)), shape, new BodyActivityDescription(.01f, 8)));
        var hashes = new List<ulong>();
        mostAsleep = 0;
        for (int i = 0; i < 80; ++i)
        {
            // Every third stack is lifted a little, and falls asleep anew, beside others that still sleep.
            if (i == 40)
                Wake(world, handles);
            int before = world.Bodies.Asleep.Count;
            world.Step();
            mostAsleep = Math.Max(mostAsleep, world.Bodies.Asleep.Count - before);
            world.Simulation.Validate();
            hashes.Add(world.Simulation.StateHash());
            hashes.Add((ulong)world.Bodies.Asleep.Count);
        }
        return hashes;
    }

    static void Wake(TestWorld world, List<BodyHandle> handles)
    {
        for (int j = 1; j < handles.Count; j += 6)
        {
            var body = world.Bodies[handles[j]];
            body.Awake = true;
            body.Velocity.Linear.Y = .5f;
        }
    }
}
