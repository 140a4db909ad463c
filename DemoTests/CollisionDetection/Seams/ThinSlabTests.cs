using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuUtilities.Memory;
using DemoTests.CollisionDetection.Children;
using DemoTests.Support;
using Xunit;

namespace DemoTests.CollisionDetection.Seams;

/// <summary>What a thin thing comes down on. All but the plate are of cells of 1 m.</summary>
public enum SlabGround
{
    /// <summary>Two triangles of 48 m.</summary>
    Plate,
    /// <summary>A wavy mesh.</summary>
    Waves,
    /// <summary>The same as a height field.</summary>
    Field,
    /// <summary>A flat mesh that is a child of a compound.</summary>
    Compound,
}

/// <summary>Slabs, discs and hulls of 1 mm to 5 cm that come down on surfaces which have a front and no depth: none falls through.</summary>
public class ThinSlabTests
{
    const int Half = 24;
    static readonly float[] Thicknesses = [.001f, .002f, .005f, .01f, .02f, .05f];
    static readonly float[] Speeds = [1, 2, 5, 10, 20];

    static float HeightAt(SlabGround ground, float x, float z) =>
        ground is SlabGround.Waves or SlabGround.Field ? .15f * MathF.Sin(1.3f * x) * MathF.Cos(1.1f * z) : 0;

    static StaticHandle AddGround(ClusterWorld world, SlabGround ground)
    {
        var (shapes, pool) = (world.Simulation.Shapes, world.Simulation.BufferPool);
        var count = 2 * Half + 1;
        if (ground == SlabGround.Field)
        {
            var heights = Enumerable.Range(0, count * count).Select(i => HeightAt(ground, i % count - Half, i / count - Half)).ToArray();
            var field = new HeightField(count, count, 1, 1, heights, pool);
            world.Own(field);
            return Add(world, new StaticDescription(new Vector3(-Half, 0, -Half), shapes.Add(field)));
        }
        var cells = ground == SlabGround.Plate ? 1 : 2 * Half;
        var size = 2f * Half / cells;
        var vertices = Enumerable.Range(0, (cells + 1) * (cells + 1)).Select(i => new Vector3(i % (cells + 1) * size - Half, 0, i / (cells + 1) * size - Half))
            .Select(v => v with { Y = HeightAt(ground, v.X, v.Z) }).ToArray();
        var indices = Enumerable.Range(0, cells * cells).SelectMany(i =>
        {
            var corner = i / cells * (cells + 1) + i % cells;
            return new[] { corner, corner + 1, corner + cells + 1, corner + 1, corner + cells + 2, corner + cells + 1 };
        }).ToArray();
        var mesh = new Mesh(vertices, indices, Vector3.One, pool);
        world.Own(mesh);
        var shape = shapes.Add(mesh);
        if (ground == SlabGround.Compound)
        {
            pool.Take(1, out Buffer<CompoundChild> children);
            children[0] = new(RigidPose.Identity, shape);
            var compound = new BigCompound(children, shapes, pool);
            world.Own(compound);
            shape = shapes.Add(compound);
        }
        return Add(world, new StaticDescription(Vector3.Zero, shape));
    }

    static StaticHandle Add(ClusterWorld world, StaticDescription description)
    {
        var handle = world.Simulation.Statics.Add(description);
        // The slabs do not meet each other.
        world.Simulation.Layers[handle] = new CollisionLayers(1, 2);
        return handle;
    }

    static BodyHandle AddSlab(ClusterWorld world, int kind, float thickness, RigidPose pose, BodyVelocity velocity)
    {
        BodyHandle body;
        if (kind == 0)
            body = world.AddBody(new Box(.6f, thickness, .4f), pose, velocity);
        else if (kind == 1)
            body = world.AddBody(new Cylinder(.25f, thickness), pose, velocity);
        else
        {
            var points = Enumerable.Range(0, 14).Select(i => new Vector3(
                .3f * MathF.Cos(i / 2 * MathF.Tau / 7), thickness * (i % 2 - .5f), .25f * MathF.Sin(i / 2 * MathF.Tau / 7))).ToArray();
            var hull = new ConvexHull(points, world.Simulation.BufferPool, out _);
            world.Own(hull);
            body = world.AddBody(hull, pose, velocity);
        }
        world.Simulation.Layers[body] = new CollisionLayers(2, 1);
        return body;
    }

    public static TheoryData<SlabGround, int, int> Cases
    {
        get
        {
            var data = new TheoryData<SlabGround, int, int>();
            var seeds = Environment.GetEnvironmentVariable("PHYSICS_FULL_TESTS") is null ? 1 : 40;
            foreach (var ground in Enum.GetValues<SlabGround>())
            {
                for (int seed = 0; seed < seeds; ++seed)
                    data.Add(ground, 2800 + seed, seed % 2);
            }
            return data;
        }
    }

    /// <summary>Flat, tilted and on edge, all of them at once; the faster ones touch at any time within a step.</summary>
    // In the last two something fell through while a corner that an impact brings down within the step had no contact.
    [Theory, MemberData(nameof(Cases))]
    [InlineData(SlabGround.Waves, 177800, 0), InlineData(SlabGround.Field, 177800, 0)]
    public void Thin_things_do_not_fall_through(SlabGround ground, int seed, int relaxations)
    {
        using var world = new ClusterWorld(isCluster: true);
        world.Simulation.Solver.RelaxationIterationCount = relaxations;
        var random = new Random(LevelSeeds.Of(seed));
        AddGround(world, ground);
        List<(BodyHandle Body, string Name)> slabs = [];
        for (int i = 0; i < 9 * Thicknesses.Length * Speeds.Length; ++i)
        {
            var (kind, lean) = (i % 3, i / 3 % 3);
            var thickness = Thicknesses[i / 9 % Thicknesses.Length];
            var speed = Speeds[i / 9 / Thicknesses.Length];
            var place = new Vector3((random.NextSingle() - .5f) * 30, .5f + random.NextSingle() * speed / 60, (random.NextSingle() - .5f) * 30);
            var tilt = lean switch { 0 => 0, 1 => random.NextSingle() * 1.2f, _ => MathF.PI / 2 + .05f * (random.NextSingle() - .5f) };
            var turn = Quaternion.CreateFromAxisAngle(Vector3.UnitY, random.NextSingle() * 6) * Quaternion.CreateFromAxisAngle(Vector3.UnitX, tilt);
            var body = AddSlab(world, kind, thickness, new(place, turn), new(new Vector3(0, -speed, 0)));
            slabs.Add((body, $"kind {kind}, tilt {tilt}, {thickness} m, {speed} m/s"));
        }
        for (int i = 0; i < 100; ++i)
            world.Step(validate: false);
        var lost = slabs.Where(slab => world.Simulation.Bodies[slab.Body].Pose.Position is var p && p.Y < HeightAt(ground, p.X, p.Z) - .1f);
        Assert.Empty(lost.Select(slab => slab.Name));
    }

    /// <summary>What lands flat gives way by no more than it does at rest.</summary>
    [Theory, InlineData(2f), InlineData(5f), InlineData(20f)]
    public void A_slab_that_lands_flat_does_not_sink_in(float speed)
    {
        const float thickness = .005f;
        using var world = new ClusterWorld(isCluster: true);
        AddGround(world, SlabGround.Plate);
        var bodies = Enumerable.Range(0, 12).Select(i => AddSlab(world, i % 3, thickness,
            new(new Vector3(i - 6.3f, .1f + i / 12f * speed / 60, 3.2f)), new(new Vector3(0, -speed, 0)))).ToArray();
        for (int i = 0; i < 60; ++i)
        {
            world.Step(validate: false);
            foreach (var body in bodies)
                Assert.InRange(world.Simulation.Bodies[body].Pose.Position.Y, thickness / 2 - 5e-4f, 1);
        }
        // Nor is it thrown back.
        Assert.All(bodies, body => Assert.InRange(world.Simulation.Bodies[body].Pose.Position.Y, 0, thickness / 2 + 1e-3f));
    }

    /// <summary>What was not pressed through a surface is not held by it: a slab that lies on one, with another through it from behind.</summary>
    [Theory, InlineData(0), InlineData(1), InlineData(2)]
    public void A_surface_that_a_slab_was_never_in_front_of_does_not_lift_it(int kind)
    {
        const float thickness = .05f;
        using var world = new ClusterWorld(isCluster: true);
        AddGround(world, SlabGround.Plate);
        var upper = AddGround(world, SlabGround.Plate);
        world.Simulation.Statics[upper].Pose.Position = new Vector3(0, .8f * thickness, 0);
        world.Simulation.Statics[upper].UpdateBounds();
        var body = AddSlab(world, kind, thickness, new(new Vector3(3, thickness / 2, 5)), default);
        // In one mesh, too.
        Vector3[] corners = [.. new[] { 0, .8f * thickness }.SelectMany(y => new Vector3[] { new(30, y, -2), new(34, y, -2), new(30, y, 2), new(34, y, 2) })];
        var mesh = new Mesh(corners, [0, 1, 2, 1, 3, 2, 4, 5, 6, 5, 7, 6], Vector3.One, world.Simulation.BufferPool);
        world.Own(mesh);
        Add(world, new StaticDescription(Vector3.Zero, world.Simulation.Shapes.Add(mesh)));
        var other = AddSlab(world, kind, thickness, new(new Vector3(32, thickness / 2, .3f)), default);
        for (int i = 0; i < 60; ++i)
        {
            world.Step(validate: false);
            Assert.InRange(world.Simulation.Bodies[body].Pose.Position.Y, thickness / 2 - 1e-3f, thickness / 2 + 1e-4f);
            Assert.InRange(world.Simulation.Bodies[other].Pose.Position.Y, thickness / 2 - 1e-3f, thickness / 2 + 1e-4f);
        }
    }

    /// <summary>What a game has put behind a surface that it lay on stays there, and falls.</summary>
    [Theory, InlineData(SlabGround.Waves), InlineData(SlabGround.Field)]
    public void What_a_game_puts_behind_a_surface_falls(SlabGround ground)
    {
        using var world = new ClusterWorld(isCluster: true);
        AddGround(world, ground);
        var bodies = Enumerable.Range(0, 9).Select(i => AddSlab(world, i % 3, .01f, new(new Vector3(i * 2 - 9, .2f, 3.2f)), default)).ToArray();
        for (int i = 0; i < 60; ++i)
            world.Step(validate: false);
        var places = new Vector3[bodies.Length];
        for (int i = 0; i < bodies.Length; ++i)
        {
            var body = world.Simulation.Bodies[bodies[i]];
            places[i] = body.Pose.Position - new Vector3(0, .08f, 0);
            body.Pose.Position = places[i];
            body.Velocity = default;
            body.Awake = true;
            body.UpdateBounds();
        }
        const int steps = 12;
        for (int i = 0; i < steps; ++i)
            world.Step(validate: false);
        // By steps of a quarter.
        var way = 9.81f * (4 * steps) * (4 * steps + 1) / 2 / (240f * 240f);
        for (int i = 0; i < bodies.Length; ++i)
            Assert.InRange(world.Simulation.Bodies[bodies[i]].Pose.Position.Y, places[i].Y - way - 2e-3f, places[i].Y - way + 2e-3f);
    }

    /// <summary>Balls and capsules that are thrown hard.</summary>
    [Theory, InlineData(SlabGround.Plate), InlineData(SlabGround.Waves), InlineData(SlabGround.Field)]
    public void Small_balls_do_not_fall_through(SlabGround ground)
    {
        using var world = new ClusterWorld(isCluster: true);
        var random = new Random(LevelSeeds.Of(2851));
        AddGround(world, ground);
        List<BodyHandle> bodies = [];
        for (int i = 0; i < 160; ++i)
        {
            var radius = Thicknesses[i % Thicknesses.Length];
            var speed = Speeds[i / Thicknesses.Length % Speeds.Length];
            var pose = new RigidPose(new Vector3((random.NextSingle() - .5f) * 30, .3f + random.NextSingle() * speed / 60, (random.NextSingle() - .5f) * 30));
            var velocity = new BodyVelocity(new Vector3(1, -speed, 0));
            bodies.Add(i % 2 == 0 ? world.AddBody(new Sphere(radius), pose, velocity) : world.AddBody(new Capsule(radius, .1f), pose, velocity));
            world.Simulation.Layers[bodies[i]] = new CollisionLayers(2, 1);
        }
        for (int i = 0; i < 60; ++i)
            world.Step(validate: false);
        Assert.DoesNotContain(bodies, body => world.Simulation.Bodies[body].Pose.Position is var p && p.Y < HeightAt(ground, p.X, p.Z) - .1f);
    }

    /// <summary>The same bits on any number of threads.</summary>
    [Fact]
    public void Threads_change_nothing()
    {
        int[] Run(int threads)
        {
            using var world = new ClusterWorld(isCluster: true, threads);
            var random = new Random(LevelSeeds.Of(2850));
            AddGround(world, SlabGround.Waves);
            for (int i = 0; i < 90; ++i)
            {
                var place = new Vector3((random.NextSingle() - .5f) * 20, .4f + random.NextSingle(), (random.NextSingle() - .5f) * 20);
                var turn = Quaternion.Normalize(new(random.NextSingle() - .5f, random.NextSingle() - .5f, random.NextSingle() - .5f, 1));
                AddSlab(world, i % 3, Thicknesses[i % Thicknesses.Length], new(place, turn), new(new Vector3(1, -12, 0)));
            }
            for (int i = 0; i < 60; ++i)
                world.Step(validate: i % 10 == 0);
            return world.State();
        }
        Assert.Equal(Run(1), Run(3));
    }
}
