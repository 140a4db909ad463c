using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Constraints;
using BepuUtilities.Memory;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Sleeping;

/// <summary>What is joined and stands on edges comes to rest.</summary>
public class StandingOnEdgesTests
{
    // Keels of which two stand, welded to each other: nothing of that may move. An end of a keel looks more nearly down than its sides do, but holds only one
    // end of the edge. Shown the ends alone, 25 of 40 such pairs rocked for ever from one end of an edge to the other.
    [Fact]
    public void Keels_that_are_welded_fall_asleep()
    {
        var stirring = new List<int>();
        for (int seed = 0; seed < 30; ++seed)
        {
            if (!FallsAsleep(seed, 10))
                stirring.Add(seed);
        }
        Assert.True(stirring.Count <= 1, $"{stirring.Count} of 30 stir: {string.Join(", ", stirring)}");
    }

    static bool FallsAsleep(int seed, float seconds)
    {
        using var pool = new BufferPool();
        using var world = new TestWorld(material: new PairMaterialProperties(1, 2, default));
        world.AddStatic(new Box(20, 2, 20), new Vector3(0, -1, 0));
        var random = new Random(seed);
        var a = AddKeel(world, pool, new Vector3(0, .32f, -.5f), Uneven(random), random);
        var b = AddKeel(world, pool, new Vector3(0, .32f, .5f), Uneven(random) + random.Next(2) * MathF.PI / 2, random);
        var (poseA, poseB) = (world.Bodies[a].Pose, world.Bodies[b].Pose);
        var back = Quaternion.Conjugate(poseA.Orientation);
        world.Solver.Add(a, b, new Weld
        {
            LocalOffset = Vector3.Transform(poseB.Position - poseA.Position, back),
            LocalOrientation = Quaternion.Concatenate(poseB.Orientation, back),
        });
        for (int i = 0; i < seconds / TestWorld.Dt && world.Bodies.ActiveSet.Count > 0; ++i)
            world.Step();
        return world.Bodies.ActiveSet.Count == 0;
    }

    static BodyHandle AddKeel(TestWorld world, BufferPool pool, Vector3 place, float yaw, Random random)
    {
        Vector3[] points =
        [
            new(-.3f, -.3f, 0), new(.3f, -.3f, 0), new(-.9f, .3f, -.2f), new(-.9f, .3f, .2f), new(.9f, .3f, -.2f), new(.9f, .3f, .2f),
        ];
        for (int i = 2; i < points.Length; ++i)
            points[i] += new Vector3(Uneven(random), Uneven(random), Uneven(random));
        var hull = new ConvexHull(points, pool, out var center);
        var turn = Quaternion.CreateFromAxisAngle(Vector3.UnitY, yaw);
        return world.Bodies.Add(BodyDescription.CreateDynamic(new RigidPose(place + Vector3.Transform(center, turn), turn),
            hull.ComputeInertia(1 + 3 * random.NextSingle()), world.Simulation.Shapes.Add(hull), .01f));
    }

    static float Uneven(Random random) => (random.NextSingle() - .5f) * .1f;
}
