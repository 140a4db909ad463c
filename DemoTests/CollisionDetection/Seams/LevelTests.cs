using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using DemoTests.CollisionDetection.Children;
using DemoTests.Support;
using Xunit;

namespace DemoTests.CollisionDetection.Seams;

/// <summary>What a level is made of.</summary>
public enum LevelGround
{
    /// <summary>A mesh of cells of 1 m.</summary>
    Mesh,
    /// <summary>A height field of cells of 1 m.</summary>
    Field,
    /// <summary>Separate boxes of 1 m.</summary>
    Boxes,
    /// <summary>A compound of boxes of 1 m.</summary>
    Compound,
    /// <summary>One box of 16 m: what the others are compared with.</summary>
    One,
}

/// <summary>Cases that levels of other engines are known to fail in: slopes, thin things, walls beside floors, plates with two sides.</summary>
public class LevelTests
{
    const float Gravity = 10;
    const int Half = 8;

    // A plane through a point, turned at random about its normal and shifted along itself.
    internal static void AddPlane(ClusterWorld world, LevelGround ground, Quaternion turn, Vector3 place, int seed)
    {
        var random = new Random(LevelSeeds.Of(seed));
        turn *= Quaternion.CreateFromAxisAngle(Vector3.UnitY, random.NextSingle() * 6);
        place += Vector3.Transform(new Vector3(random.NextSingle(), 0, random.NextSingle()), turn);
        var (shapes, pool) = (world.Simulation.Shapes, world.Simulation.BufferPool);
        var pose = new RigidPose(place, turn);
        var corner = new RigidPose(place + Vector3.Transform(new Vector3(-Half, 0, -Half), turn), turn);
        switch (ground)
        {
            case LevelGround.Mesh:
                var mesh = CreateGrid(2 * Half, pool);
                world.Own(mesh);
                world.Simulation.Statics.Add(new StaticDescription(corner, shapes.Add(mesh)));
                break;
            case LevelGround.Field:
                var field = new HeightField(2 * Half + 1, 2 * Half + 1, 1, 1, new float[(2 * Half + 1) * (2 * Half + 1)], pool);
                world.Own(field);
                world.Simulation.Statics.Add(new StaticDescription(corner, shapes.Add(field)));
                break;
            case LevelGround.One:
                var one = new RigidPose(place + Vector3.Transform(new Vector3(0, -.5f, 0), turn), turn);
                world.Simulation.Statics.Add(new StaticDescription(one, shapes.Add(new Box(2 * Half, 1, 2 * Half))));
                break;
            default:
                var box = shapes.Add(new Box(1, 1, 1));
                var places = Enumerable.Range(0, 4 * Half * Half).Select(i => new Vector3(i % (2 * Half) - Half + .5f, -.5f, i / (2 * Half) - Half + .5f));
                if (ground == LevelGround.Compound)
                {
                    pool.Take(4 * Half * Half, out BepuUtilities.Memory.Buffer<CompoundChild> children);
                    var count = 0;
                    foreach (var local in places)
                        children[count++] = new(new RigidPose(local), box);
                    var compound = new BigCompound(children, shapes, pool);
                    world.Own(compound);
                    world.Simulation.Statics.Add(new StaticDescription(pose, shapes.Add(compound)));
                    break;
                }
                foreach (var local in places)
                    world.Simulation.Statics.Add(new StaticDescription(new RigidPose(place + Vector3.Transform(local, turn), turn), box));
                break;
        }
    }

    static Mesh CreateGrid(int count, BepuUtilities.Memory.BufferPool pool)
    {
        var (vertices, indices) = (new List<Vector3>(), new List<int>());
        for (int i = 0; i < (count + 1) * (count + 1); ++i)
            vertices.Add(new(i % (count + 1), 0, i / (count + 1)));
        for (int z = 0; z < count; ++z)
        {
            for (int x = 0; x < count; ++x)
            {
                var corner = z * (count + 1) + x;
                indices.AddRange([corner, corner + 1, corner + count + 1, corner + 1, corner + count + 2, corner + count + 1]);
            }
        }
        return new(vertices.ToArray(), indices.ToArray(), Vector3.One, pool);
    }

    static ConvexHull CreateTripod(ClusterWorld world)
    {
        // Three corners below, so three contacts.
        Vector3[] points = [new(.4f, -.1f, 0), new(-.2f, -.1f, .35f), new(-.2f, -.1f, -.35f), new(.1f, .1f, 0), new(-.1f, .1f, .1f), new(-.1f, .1f, -.1f)];
        var hull = new ConvexHull(points, world.Simulation.BufferPool, out _);
        world.Own(hull);
        return hull;
    }

    /// <summary>Below the angle of friction a thing stays where it is, above it slides as a point does; whatever the ground is made of.</summary>
    [Theory]
    [InlineData(LevelGround.Mesh, true), InlineData(LevelGround.Field, true), InlineData(LevelGround.Boxes, true), InlineData(LevelGround.Compound, true)]
    [InlineData(LevelGround.Mesh, false), InlineData(LevelGround.Field, false), InlineData(LevelGround.Boxes, false), InlineData(LevelGround.Compound, false)]
    public void Slopes_hold_and_let_go_as_one_plane_does(LevelGround ground, bool isBox)
    {
        for (int seed = 2001; seed <= 2004; ++seed)
        {
            var part = seed < 2003 ? .98f : 1.02f;
            using var world = new ClusterWorld(isCluster: true);
            var angle = MathF.Atan(part * world.Behaviour.Friction);
            var turn = Quaternion.CreateFromAxisAngle(Vector3.UnitZ, -angle);
            AddPlane(world, ground, turn, default, seed);
            BodyHandle body;
            if (isBox)
                body = world.AddBody(new Box(.6f, .1f, .6f), new RigidPose(Vector3.Transform(new Vector3(0, .0499f, 0), turn), turn));
            else
            {
                var hull = CreateTripod(world);
                hull.ComputeBounds(Quaternion.Identity, out var min, out _);
                body = world.AddBody(hull, new RigidPose(Vector3.Transform(new Vector3(0, -min.Y - 1e-4f, 0), turn), turn));
            }
            var start = world.Simulation.Bodies[body].Pose.Position;
            for (int i = 0; i < 180; ++i)
                world.Step(validate: i % 60 == 0);
            var way = (world.Simulation.Bodies[body].Pose.Position - start).Length();
            var acceleration = Gravity * (MathF.Sin(angle) - world.Behaviour.Friction * MathF.Cos(angle));
            // Two percent of the coefficient is the whole of the acceleration above; a tenth of it is well within them.
            var expected = Math.Max(0, .5f * acceleration * 9);
            Assert.InRange(way, .9f * expected - 1e-3f, 1.1f * expected + 1e-3f);
        }
    }

    /// <summary>A slab of 2 cm on four triangles lies there, and so does a thin plate of triangles; neither falls through.</summary>
    [Theory, InlineData(0f), InlineData(2f)]
    public void A_thin_slab_rests_on_large_triangles(float speed)
    {
        using var world = new ClusterWorld(isCluster: true);
        world.Behaviour.Friction = .5f;
        Vector3[] corners = [new(-10, 0, -10), new(10, 0, -10), new(-10, 0, 10), new(10, 0, 10)];
        var mesh = new Mesh(corners, [0, 1, 2, 1, 3, 2], Vector3.One, world.Simulation.BufferPool);
        world.Own(mesh);
        world.Simulation.Statics.Add(new StaticDescription(Vector3.Zero, world.Simulation.Shapes.Add(mesh)));
        var slab = world.AddBody(new Box(4, .02f, 4), new RigidPose(new Vector3(.3f, .05f, .4f)), new BodyVelocity(new Vector3(speed, -speed, 0)));
        for (int i = 0; i < 240; ++i)
        {
            world.Step(validate: false);
            if (i > 120)
                Assert.InRange(world.Simulation.Bodies[slab].Pose.Position.Y, .01f - 1e-3f, .01f + 1e-3f);
        }
        // Corners that are close to each other on two triangles open and close by a micrometre, so that one step of several has a few mm/s.
        var fastest = 0f;
        var height = world.Simulation.Bodies[slab].Pose.Position.Y;
        for (int i = 0; i < 12; ++i)
        {
            world.Step(validate: false);
            fastest = Math.Max(fastest, world.Simulation.Bodies[slab].Velocity.Linear.Length());
        }
        Assert.InRange(fastest, 0, 5e-3f);
        Assert.InRange(world.Simulation.Bodies[slab].Pose.Position.Y, height - 2e-5f, height + 2e-5f);
    }

    /// <summary>A rod across the cells of a grid comes to rest, and has no more than eight contacts.</summary>
    [Theory, InlineData(LevelGround.Mesh), InlineData(LevelGround.Field), InlineData(LevelGround.Boxes), InlineData(LevelGround.Compound)]
    public void A_rod_across_many_children_rests(LevelGround ground)
    {
        using var world = new ClusterWorld(isCluster: true);
        AddPlane(world, ground, Quaternion.Identity, default, 2005);
        var rod = world.AddBody(new Box(5, .1f, .1f), new RigidPose(new Vector3(0, .2f, 0), Quaternion.CreateFromAxisAngle(Vector3.UnitZ, .02f)));
        for (int i = 0; i < 180; ++i)
            world.Step(validate: i % 30 == 0);
        var body = world.Simulation.Bodies[rod];
        var energy = .5f * (body.Velocity.Linear.LengthSquared() + body.Velocity.Angular.LengthSquared() * 25 / 12);
        Assert.InRange(energy, 0, 1e-6f);
        Assert.InRange(body.Pose.Position.Y, .049f, .0501f);
    }

    /// <summary>A plate with two sides is not passed, from either side, at any of these speeds, and what has come to it stays on its side.</summary>
    [Theory, InlineData(1), InlineData(-1)]
    public void What_comes_to_a_plate_of_two_sides_stays_on_its_side(int side)
    {
        var random = new Random(LevelSeeds.Of(2008 + side));
        for (int i = 0; i < 40; ++i)
        {
            using var world = new ClusterWorld(isCluster: true);
            Vector3[] corners = [new(0, -9, -9), new(0, -9, 9), new(0, 9, -9), new(0, 9, 9)];
            var mesh = new Mesh(corners, [0, 1, 2, 1, 3, 2], Vector3.One, world.Simulation.BufferPool) { TwoSided = true };
            world.Own(mesh);
            world.Simulation.Statics.Add(new StaticDescription(Vector3.Zero, world.Simulation.Shapes.Add(mesh)));
            var turn = Quaternion.Normalize(new(random.NextSingle() - .5f, random.NextSingle() - .5f, random.NextSingle() - .5f, random.NextSingle() - .5f));
            var speed = 10 * random.NextSingle();
            var body = world.AddBody(new Box(.5f, .5f, .5f), new RigidPose(new Vector3(side * 1.1f, 2, 0), turn),
                new BodyVelocity(new Vector3(-side * speed, 5, 0)));
            for (int step = 0; step < 60; ++step)
            {
                world.Step(validate: false);
                Assert.InRange(world.Simulation.Bodies[body].Pose.Position.X * side, .2f, 20);
            }
        }
    }
}
