using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace DemoTests.Accuracy;

/// <summary>Chains and balls that bounce about in a room without gravity.</summary>
static class JointedImpactCrowd
{
    const float BoxSize = .3f;
    const float Distance = .45f;
    const float RoomSize = 6;

    public static JointedImpactWorld Create(int seed, float restitution, float friction)
    {
        var random = new Random(seed);
        // Sweeps would lose energy, and hide what is gained.
        var description = SolveDescription.Default;
        description.DirectJoints = DirectJointsMode.Always;
        var world = new JointedImpactWorld(restitution, 1 / 60f, friction, description: description);
        var (statics, shapes) = (world.Simulation.Statics, world.Simulation.Shapes);
        foreach (float side in new[] { -1f, 1f })
        {
            float place = side * (RoomSize + 1) / 2;
            statics.Add(new StaticDescription(new Vector3(place, 0, 0), shapes.Add(new Box(1, 20, 20))));
            statics.Add(new StaticDescription(new Vector3(0, place, 0), shapes.Add(new Box(20, 1, 20))));
            statics.Add(new StaticDescription(new Vector3(0, 0, place), shapes.Add(new Box(20, 20, 1))));
        }
        for (int i = 0; i < 4; ++i)
            AddChain(world, random, new Vector3(i % 2 * 2 - 1, i / 2 * 2 - 1, 0) * 1.3f, isAnchored: i == 0);
        for (int i = 0; i < 4; ++i)
        {
            world.Add(
                new Sphere(.2f), MathF.Pow(10, 2 * random.NextSingle() - 1), new RigidPose(new Vector3(i - 1.5f, 0, 1.5f)), Direction(random) * 5);
        }
        return world;
    }

    static void AddChain(JointedImpactWorld world, Random random, Vector3 center, bool isAnchored)
    {
        int count = 2 + random.Next(4), first = world.Count;
        var velocity = isAnchored ? default : Direction(random) * (3 * random.NextSingle());
        for (int i = 0; i < count; ++i)
        {
            var place = center + new Vector3((i - count / 2f) * Distance, 0, 0);
            int link = world.Add(new Box(BoxSize, BoxSize, BoxSize), .5f + 4 * random.NextSingle(), new RigidPose(place), velocity);
            if (i == 0)
                continue;
            var point = place - new Vector3(Distance / 2, 0, 0);
            switch (random.Next(3))
            {
                case 0:
                    world.Socket(link - 1, link, point);
                    break;
                case 1:
                    world.Hinge(link - 1, link, point, Direction(random));
                    break;
                default:
                    world.Weld(link - 1, link);
                    break;
            }
        }
        if (!isAnchored)
            return;
        var end = world[first].Pose.Position - new Vector3(Distance / 2, 0, 0);
        world.Socket(world.AddAnchor(end), first, end);
    }

    static Vector3 Direction(Random random) => QuaternionEx.Transform(
        Vector3.UnitX,
        Quaternion.Normalize(new(random.NextSingle() - .5f, random.NextSingle() - .5f, random.NextSingle() - .5f, random.NextSingle() - .5f)));
}
