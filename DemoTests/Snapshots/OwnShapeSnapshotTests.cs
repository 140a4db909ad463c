using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;
using DemoTests.OwnShapes;
using DemoTests.Quality;
using Xunit;

namespace DemoTests.Snapshots;

/// <summary>Worlds of shapes of a game's own go on from a snapshot as the one that was saved, to the bit.</summary>
public class OwnShapeSnapshotTests
{
    static VoxelWorld Create(int threads)
    {
        var world = new VoxelWorld(threads: threads);
        var registry = world.Simulation.NarrowPhase.CollisionTaskRegistry;
        registry.RegisterConvex<Cone, ConeWide, ConeSupport, ConeFeature>();
        registry.RegisterConvex<Ellipsoid, EllipsoidWide, EllipsoidSupport, PointFeature<EllipsoidWide, EllipsoidSupport>>();
        var land = world.Create(16, 6, 16, 1, new Vector3(-8, -4, -8), (x, y, z) => y < 2 + (x / 4 + z / 4) % 3);
        world.AddStatic(land, new RigidPose(new Vector3(.3f, -.2f, .1f), Quaternion.CreateFromYawPitchRoll(.4f, .05f, -.1f)));
        for (int i = 0; i < 32; ++i)
        {
            var pose = new RigidPose(new Vector3(i % 4 * 1.3f - 2, 1 + i * .25f, i / 4 % 4 * 1.2f - 2), Quaternion.CreateFromYawPitchRoll(i, .3f * i, .1f));
            switch (i % 4)
            {
                case 0: world.AddBody(new Cone(.4f, .8f), pose); break;
                case 1: world.AddBody(new Ellipsoid(.3f, .5f, .4f), pose); break;
                case 2: world.AddBody(new Box(.7f, .5f, .6f), pose); break;
                case 3: world.AddBody(world.Create(3, 2, 2, .3f, default, (x, y, z) => x + y + z != 4), pose); break;
            }
        }
        return world;
    }

    static List<ulong> Run(VoxelWorld world)
    {
        List<ulong> hashes = [];
        for (int i = 0; i < 25; ++i)
        {
            world.Step();
            hashes.Add(world.Simulation.StateHash());
        }
        return hashes;
    }

    [Theory, InlineData(1), InlineData(3)]
    public void A_restored_world_goes_on_as_the_saved_one(int threads)
    {
        using var world = Create(threads);
        using var other = Create(4 - threads);
        using var pool = new BufferPool();
        using var snapshot = new SimulationSnapshot(pool);
        var step = 0;
        foreach (var at in new[] { 0, 1, 30, 70, 140 })
        {
            for (; step < at; ++step)
                world.Step();
            world.Simulation.Save(snapshot);
            var expected = Run(world);
            for (int i = 0; i < 5; ++i)
            {
                world.Simulation.Bodies.ActiveSet.MotionStates[i].Velocity.Linear += new Vector3(1, 2, 3);
                world.Step();
            }
            world.Simulation.Restore(snapshot);
            world.Simulation.Validate();
            Assert.Equal(expected, Run(world));
            other.Simulation.Restore(snapshot);
            other.Simulation.Validate();
            Assert.Equal(expected, Run(other));
            world.Simulation.Restore(snapshot);
        }
    }
}
