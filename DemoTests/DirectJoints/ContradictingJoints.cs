using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using DemoTests.Scenes;

namespace DemoTests.DirectJoints;

/// <summary>Structures whose joints cannot all be where they should be, as games make them by mistake, and nets.</summary>
static class ContradictingJoints
{
    /// <summary>Two to four boxes in a row with as many joints as bodies, or more, none of which is where it should be.</summary>
    public static List<BodyHandle> AddKnot(TestWorld world, int seed)
    {
        var random = new Random(seed);
        var count = 2 + random.Next(3);
        var bodies = new List<BodyHandle>();
        for (int i = 0; i < count; ++i)
        {
            var box = new Box(random.Uniform(.1f, .5f), random.Uniform(.1f, .5f), random.Uniform(.1f, .5f));
            bodies.Add(world.AddDynamic(box, MathF.Pow(10, random.Uniform(-1, 1)), new RigidPose(new(.5f * i, 1, 0), TestWorld.Turn(random))));
        }
        var joints = count + random.Next(3);
        for (int i = 0; i < joints; ++i)
        {
            var (a, b) = i < count - 1 ? (i, i + 1) : (random.Next(count), random.Next(count));
            if (a != b)
                AddJoint(world.Solver, random, bodies[a], bodies[b]);
        }
        return bodies;
    }

    static void AddJoint(Solver solver, Random random, BodyHandle a, BodyHandle b)
    {
        switch (random.Next(3))
        {
            case 0:
                solver.Add(a, b, new BallSocket { LocalOffsetA = TestWorld.Scatter(random, .8f), LocalOffsetB = TestWorld.Scatter(random, .8f) });
                break;
            case 1:
                solver.Add(a, b, new Weld { LocalOffset = TestWorld.Scatter(random, 1.2f), LocalOrientation = TestWorld.Turn(random) });
                break;
            default:
                solver.Add(a, b, new Hinge
                {
                    LocalOffsetA = TestWorld.Scatter(random, .8f),
                    LocalOffsetB = TestWorld.Scatter(random, .8f),
                    LocalHingeAxisA = Vector3.Normalize(TestWorld.Scatter(random, 2)),
                    LocalHingeAxisB = Vector3.Normalize(TestWorld.Scatter(random, 2)),
                });
                break;
        }
    }

    static float Uniform(this Random random, float from, float to) => from + random.NextSingle() * (to - from);

    /// <summary>A square net of knots of 1 kg, held at two sides, with a load at its middle.</summary>
    public static void AddNet(TestWorld world, int side, float load)
    {
        const float mesh = .4f;
        var knots = new BodyHandle[side, side];
        bool IsHeld(int x) => x == 0 || x == side - 1;
        for (int x = 0; x < side; ++x)
        {
            for (int z = 0; z < side; ++z)
            {
                var pose = new RigidPose(new(x * mesh, 0, z * mesh));
                var mass = x == side / 2 && z == side / 2 ? load : 1;
                knots[x, z] = IsHeld(x) ? world.AddKinematic(new Sphere(.1f), pose) : world.AddDynamic(new Sphere(.1f), mass, pose);
                if (x > 0)
                    world.Solver.Add(knots[x - 1, z], knots[x, z], Link(new(mesh / 2, 0, 0)));
                if (z > 0 && !IsHeld(x))
                    world.Solver.Add(knots[x, z - 1], knots[x, z], Link(new(0, 0, mesh / 2)));
            }
        }
    }

    static BallSocket Link(Vector3 half) => new() { LocalOffsetA = half, LocalOffsetB = -half };
}
