using System;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuUtilities.Memory;
using DemoTests.Collidables.Meshes;
using Xunit;
using static DemoTests.Quality.DocSamples;

namespace DemoTests.OwnShapes;

/// <summary>Bodies on voxels, and bodies made of them, move by the same bits as with compounds of the same cubes.</summary>
public class VoxelMotionTests
{
    // Hills of steps; nothing turned, and turned.
    static void AddLand(VoxelWorld world, Quaternion turn)
    {
        var land = world.Create(16, 6, 16, 1, new Vector3(-8, -4, -8), (x, y, z) => y < 2 + (x / 4 + z / 4) % 3);
        world.AddStatic(land, new RigidPose(new Vector3(.3f, -.2f, .1f), turn));
    }

    static void AddBodies(VoxelWorld world, bool withVoxels)
    {
        var shapes = world.Simulation.Shapes;
        var points = Enumerable.Range(0, 12).Select(i => new Vector3(MathF.Cos(i) * .4f, MathF.Sin(2 * i) * .3f, MathF.Sin(i) * .4f)).ToArray();
        var hull = new ConvexHull(points, world.Pool, out _);
        var hullName = world.Own(shapes.Add(hull));
        var sample = MeshSample.Box(new(.3f, .25f, .4f));
        var mesh = world.Own(shapes.Add(new Mesh(sample.Vertices, sample.Indices, Vector3.One, world.Pool)));
        world.Pool.Take(2, out Buffer<CompoundChild> pair);
        pair[0] = new(new RigidPose(new Vector3(-.3f, 0, 0)), shapes.Add(new Sphere(.25f)));
        pair[1] = new(new RigidPose(new Vector3(.3f, 0, 0)), shapes.Add(new Box(.4f, .5f, .6f)));
        var compound = world.Own(shapes.Add(new Compound(pair)));
        var inertia = new Box(.8f, .6f, .6f).ComputeInertia(1);
        for (int i = 0; i < 32; ++i)
        {
            var pose = new RigidPose(new Vector3(i % 4 * 1.3f - 2, 1 + i * .35f, i / 4 % 4 * 1.2f - 2), Quaternion.CreateFromYawPitchRoll(i, .3f * i, .1f));
            switch (i % 8)
            {
                case 0: world.AddBody(new Sphere(.4f), pose); break;
                case 1: world.AddBody(new Capsule(.25f, .5f), pose); break;
                case 2: world.AddBody(new Box(.7f, .5f, .6f), pose); break;
                case 3: world.AddBody(new Cylinder(.3f, .5f), pose); break;
                case 4: world.Simulation.Bodies.Add(BodyDescription.CreateDynamic(pose, inertia, hullName, -1f)); break;
                case 5: world.Simulation.Bodies.Add(BodyDescription.CreateDynamic(pose, inertia, mesh, -1f)); break;
                case 6: world.Simulation.Bodies.Add(BodyDescription.CreateDynamic(pose, inertia, compound, -1f)); break;
                case 7 when withVoxels: world.AddBody(world.Create(3, 2, 2, .3f, default, (x, y, z) => x + y + z != 4), pose); break;
            }
        }
    }

    static VoxelWorld Create(bool isOfCubes, bool isTurned, bool withVoxels, int threads = 1)
    {
        var world = new VoxelWorld(isOfCubes, threads);
        AddLand(world, isTurned ? Quaternion.CreateFromYawPitchRoll(.4f, .05f, -.1f) : Quaternion.Identity);
        AddBodies(world, withVoxels);
        return world;
    }

    /// <summary>As long as nothing lies still: what rests is remembered by the size of what it rests on, and that of voxels is not measured child by child.
    /// </summary>
    [Theory, InlineData(false), InlineData(true)]
    public void What_falls_on_them_moves_as_on_a_compound_of_cubes(bool isTurned)
    {
        using var expected = Create(true, isTurned, withVoxels: false);
        using var actual = Create(false, isTurned, withVoxels: false);
        for (int i = 0; i < 60; ++i)
        {
            expected.Step();
            actual.Step(validate: i % 10 == 0);
            Assert.Equal(expected.State(), actual.State());
        }
    }

    [Theory, InlineData(false), InlineData(true)]
    public void Any_number_of_threads_gives_the_same_bits_and_nothing_falls_through(bool isTurned)
    {
        var worlds = Enumerable.Range(1, 3).Select(threads => Create(false, isTurned, withVoxels: true, threads)).ToArray();
        for (int i = 0; i < 240; ++i)
        {
            foreach (var world in worlds)
                world.Step(validate: i % 60 == 0);
            Assert.Equal(worlds[0].State(), worlds[1].State());
            Assert.Equal(worlds[0].State(), worlds[2].State());
        }
        ref var set = ref worlds[0].Simulation.Bodies.ActiveSet;
        for (int i = 0; i < set.Count; ++i)
        {
            var position = set.MotionStates[i].Pose.Position;
            Assert.True(position.Y > -3 || MathF.Abs(position.X) > 7 || MathF.Abs(position.Z) > 7, $"body {i} is at {position}");
        }
        foreach (var world in worlds)
            world.Dispose();
    }

    [Fact]
    public void A_step_takes_nothing_from_the_garbage_collector()
    {
        using var world = Create(false, true, withVoxels: true);
        for (int i = 0; i < 120; ++i)
            world.Step();
        var before = GC.GetAllocatedBytesForCurrentThread();
        for (int i = 0; i < 60; ++i)
            world.Step();
        Assert.Equal(0, GC.GetAllocatedBytesForCurrentThread() - before);
    }

    /// <summary>Eight cubes are one cube: on the ground, on a plane, on a mesh, on voxels.</summary>
    [Theory, InlineData("box"), InlineData("plane"), InlineData("mesh"), InlineData("voxels")]
    public void A_cube_of_cubes_rests_at_the_height_of_one(string ground)
    {
        using var world = new VoxelWorld();
        var sample = MeshSample.Terrain(8, 0);
        var shape = ground switch
        {
            "box" => world.Shapes.Add(new Box(20, 2, 20)),
            "plane" => world.Shapes.Add(new HalfSpace(Vector3.UnitY)),
            "mesh" => world.Own(world.Shapes.Add(new Mesh(sample.Vertices, sample.Indices, Vector3.One, world.Pool))),
            _ => world.Add(world.Create(10, 2, 10, 1, new Vector3(-5, -2, -5), (_, _, _) => true)),
        };
        world.Simulation.Statics.Add(new StaticDescription(new Vector3(.1f, ground == "box" ? -1 : 0, .2f), shape));
        var body = world.AddBody(world.Create(2, 2, 2, .5f, default, (_, _, _) => true), new RigidPose(new Vector3(0, .6f, 0)));
        for (int i = 0; i < 180; ++i)
            world.Step(validate: i % 60 == 0);
        var reference = world.Simulation.Bodies[body];
        Assert.Equal(.5f, reference.Pose.Position.Y, 5e-4f);
        Assert.InRange(reference.Velocity.Linear.Length() + reference.Velocity.Angular.Length(), 0, 1e-3f);
        Assert.InRange(Vector3.Transform(Vector3.UnitY, reference.Pose.Orientation).Y, 1 - 1e-6f, 1);
    }

    /// <summary>Over the seams of voxels; not turned, so that the seams of both are along each other, and turned.</summary>
    [Theory, InlineData(0), InlineData(.3f)]
    public void Voxels_that_slide_on_voxels_keep_their_speed(float turn)
    {
        using var world = new VoxelWorld();
        world.AddStatic(world.Create(30, 1, 30, 1, new Vector3(-15, -1, -15), (_, _, _) => true), RigidPose.Identity);
        var way = Vector3.Transform(Vector3.UnitX, Quaternion.CreateFromAxisAngle(Vector3.UnitY, turn));
        var body = world.AddBody(world.Create(3, 1, 2, .5f, default, (_, _, _) => true),
            new RigidPose(new Vector3(0, .25f, 0) - way * 5, Quaternion.CreateFromAxisAngle(Vector3.UnitY, turn)), new BodyVelocity(way * 5));
        var reference = world.Simulation.Bodies[body];
        var box = world.AddBody(new Box(1.5f, .5f, 1), new RigidPose(new Vector3(0, .25f, 8)), new BodyVelocity(Vector3.UnitX * 5));
        for (int i = 0; i < 60; ++i)
        {
            world.Step();
            var expected = world.Simulation.Bodies[box];
            // The box is on voxels too, and has no seams of its own.
            Assert.Equal(expected.Velocity.Linear.X, Vector3.Dot(reference.Velocity.Linear, way), .05f);
            Assert.Equal(expected.Velocity.Linear.Y, reference.Velocity.Linear.Y, .005f);
            Assert.Equal(expected.Pose.Position.Y, reference.Pose.Position.Y, 3e-4f);
        }
    }

    [Fact]
    public void Inertia_of_a_cube_of_cubes_is_that_of_one()
    {
        using var world = new VoxelWorld();
        var voxels = world.Create(2, 2, 2, .5f, new Vector3(3, 4, 5), (_, _, _) => true);
        var actual = HomogeneousCompound.ComputeInertia<Voxels, Box, BoxWide>(voxels, .25f, world.Pool, out var center);
        var expected = new Box(1, 1, 1).ComputeInertia(2);
        Assert.Equal(0, (center - new Vector3(3.5f, 4.5f, 5.5f)).Length(), 1e-6f);
        Assert.Equal(expected.InverseMass, actual.InverseMass, 1e-7f);
        Assert.Equal(expected.InverseInertiaTensor.XX, actual.InverseInertiaTensor.XX, 1e-5f);
        Assert.Equal(expected.InverseInertiaTensor.ZZ, actual.InverseInertiaTensor.ZZ, 1e-5f);
        Assert.Equal(0, actual.InverseInertiaTensor.YX, 1e-5f);
        // An L of three cubes: by hand, in doubles. Cubes of 1 m and 1 kg at (0, 0), (1, 0) and (0, 1).
        var angle = world.Create(2, 2, 1, 1, default, (x, y, _) => x + y < 2);
        var inertia = HomogeneousCompound.ComputeInertia<Voxels, Box, BoxWide>(angle, 1, world.Pool, out var middle);
        Assert.Equal(0, (middle - new Vector3(2.5f / 3, 2.5f / 3, .5f)).Length(), 1e-6f);
        // Of each .5 around its own centre of 1/6; the places around the middle: squares of 2/3, product of -1/3.
        const double Along = .5 + 2.0 / 3, Product = 1.0 / 3;
        Assert.Equal(Along / (Along * Along - Product * Product), inertia.InverseInertiaTensor.XX, 1e-5);
        Assert.Equal(1 / (.5 + 4.0 / 3), inertia.InverseInertiaTensor.ZZ, 1e-5);
        voxels.Dispose(world.Pool);
        angle.Dispose(world.Pool);
    }
}
