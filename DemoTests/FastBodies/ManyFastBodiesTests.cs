using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.FastBodies;

/// <summary>Hundreds of marked bodies that hit walls and each other: their ways are swept by all threads, and no bit depends on how many there are.</summary>
public class ManyFastBodiesTests
{
    const int Count = 120;

    [Fact]
    public void HundredsOfMarkedBodiesDoNotDependOnThreads()
    {
        var expected = Run(1);
        foreach (int threads in (int[])[2, 3, 5, 8])
            Assert.Equal(expected, Run(threads));
    }

    static List<ulong> Run(int threads)
    {
        using var world = new TestWorld(threads: threads);
        world.AddStatic(new Box(40, 1, 40), new RigidPose(new Vector3(0, -.5f, 0)));
        world.AddStatic(new Box(1, 20, 40), new RigidPose(new Vector3(10, 10, 0)));
        var ball = new Sphere(.1f);
        var box = new Box(.2f, .1f, .3f);
        var shapes = (world.Simulation.Shapes.Add(ball), world.Simulation.Shapes.Add(box));
        var random = new Random(5);
        float Any() => random.NextSingle() * 2 - 1;
        for (int i = 0; i < Count; ++i)
        {
            var isBall = i % 2 == 0;
            var pose = new RigidPose(new Vector3(Any() * 6, 4 + Any() * 3, Any() * 6));
            var velocity = new BodyVelocity(new Vector3(100 + Any() * 50, -100 + Any() * 50, Any() * 50), new Vector3(Any(), Any(), Any()) * 20);
            world.Bodies.Add(BodyDescription.CreateDynamic(pose, velocity, isBall ? ball.ComputeInertia(1) : box.ComputeInertia(1),
                new CollidableDescription(isBall ? shapes.Item1 : shapes.Item2, ContinuousDetection.Continuous()), -1));
        }
        var hashes = new List<ulong>();
        for (int i = 0; i < 12; ++i)
        {
            world.Step();
            hashes.Add(world.Simulation.StateHash());
        }
        return hashes;
    }
}
