using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using DemoTests.CollisionDetection.Children;
using DemoTests.Support;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.CollisionDetection.Seams;

/// <summary>Thin things: plates that are touched from both sides, and what is thin itself.</summary>
public class PlateTests(ITestOutputHelper output)
{
    const float Half = .25f;

    static ClusterWorld CreatePlate(Quaternion turn, float size)
    {
        var world = new ClusterWorld(isCluster: true);
        Vector3[] corners = [new(-size, 0, -size), new(size, 0, -size), new(-size, 0, size), new(size, 0, size)];
        var mesh = new Mesh(corners, [0, 1, 2, 1, 3, 2], Vector3.One, world.Simulation.BufferPool) { TwoSided = true };
        world.Own(mesh);
        var plate = world.Simulation.Statics.Add(new StaticDescription(new RigidPose(default, turn), world.Simulation.Shapes.Add(mesh)));
        // The boxes do not meet each other.
        world.Simulation.Layers[plate] = new CollisionLayers(1, 2);
        return world;
    }

    // Boxes that fly at an upright plate from one side, from the place of a step before they touch to that of the next.
    int CountCrossed(float fastest, float slowest, int side, int count)
    {
        var random = new Random(LevelSeeds.Of(2100 + side));
        using var world = CreatePlate(Quaternion.CreateFromAxisAngle(Vector3.UnitZ, MathF.PI / 2), 200);
        List<(BodyHandle Body, float Speed)> bodies = [];
        for (int i = 0; i < count; ++i)
        {
            var turn = Quaternion.Normalize(new(random.NextSingle() - .5f, random.NextSingle() - .5f, random.NextSingle() - .5f, random.NextSingle() - .5f));
            var speed = slowest + (fastest - slowest) * random.NextSingle();
            var place = new Vector3(side * (.5f + speed / 60 * random.NextSingle()), i / 40 * 2, i % 40 * 2 - 40);
            var body = world.AddBody(new Box(2 * Half, 2 * Half, 2 * Half), new RigidPose(place, turn), new BodyVelocity(new Vector3(-side * speed, 5, 0)));
            world.Simulation.Layers[body] = new CollisionLayers(2, 1);
            bodies.Add((body, speed));
        }
        for (int i = 0; i < 45; ++i)
            world.Step(validate: false);
        var crossed = bodies.Where(body => world.Simulation.Bodies[body.Body].Pose.Position.X * side < 0).ToArray();
        output.WriteLine($"{crossed.Length} of {count} have crossed; the slowest at {(crossed.Length == 0 ? 0 : crossed.Min(body => body.Speed))} m/s");
        return crossed.Length;
    }

    [Theory, InlineData(1), InlineData(-1)]
    public void What_flies_at_a_plate_of_two_sides_does_not_cross(int side) => Assert.Equal(0, CountCrossed(50, 0, side, 500));

    /// <summary>A box that lies on a plate, and one that is pressed at it from below, stay there for a minute.</summary>
    [Theory, InlineData(1), InlineData(-1)]
    public void What_rests_on_a_plate_of_two_sides_stays_on_its_side(int side)
    {
        using var world = CreatePlate(side > 0 ? Quaternion.Identity : Quaternion.CreateFromAxisAngle(Vector3.UnitX, MathF.PI), 4);
        var random = new Random(LevelSeeds.Of(2102));
        var bodies = new List<BodyHandle>();
        for (int i = 0; i < 9; ++i)
        {
            var turn = Quaternion.CreateFromAxisAngle(Vector3.UnitY, random.NextSingle());
            bodies.Add(world.AddBody(new Box(2 * Half, 2 * Half, 2 * Half), new RigidPose(new Vector3(i % 3 - 1, Half, i / 3 - 1), turn)));
            world.Simulation.Layers[bodies[i]] = new CollisionLayers(2, 1);
        }
        for (int i = 0; i < 3600; ++i)
        {
            world.Step(validate: false);
            foreach (var body in bodies)
                Assert.InRange(world.Simulation.Bodies[body].Pose.Position.Y, Half - 1e-3f, Half + 1e-4f);
        }
        for (int i = 0; i < bodies.Count; ++i)
            Assert.InRange((world.Simulation.Bodies[bodies[i]].Pose.Position - new Vector3(i % 3 - 1, Half, i / 3 - 1)).Length(), 0, 1e-3f);
    }

    /// <summary>A slab of 2 cm lies on a plate of ten triangles, a strip of five cells that is as wide as itself.</summary>
    [Theory, InlineData(0f, .02f), InlineData(2f, .02f), InlineData(0f, .005f), InlineData(2f, .005f)]
    public void A_slab_rests_on_a_plate_of_ten_triangles(float speed, float thickness)
    {
        using var world = new ClusterWorld(isCluster: true);
        world.Behaviour.Friction = .5f;
        var vertices = Enumerable.Range(0, 12).Select(i => new Vector3(i / 2 - 2.5f, 0, i % 2 * 2 - 1)).ToArray();
        var indices = Enumerable.Range(0, 5).SelectMany(i => new[] { 2 * i, 2 * i + 2, 2 * i + 1, 2 * i + 1, 2 * i + 2, 2 * i + 3 }).ToArray();
        var mesh = new Mesh(vertices, indices, Vector3.One, world.Simulation.BufferPool);
        world.Own(mesh);
        world.Simulation.Statics.Add(new StaticDescription(Vector3.Zero, world.Simulation.Shapes.Add(mesh)));
        var slab = world.AddBody(new Box(3, thickness, 2), new RigidPose(new Vector3(.3f, .05f, .1f)), new BodyVelocity(new Vector3(0, -speed, 0)));
        for (int i = 0; i < 240; ++i)
        {
            world.Step(validate: false);
            if (i > 120)
                Assert.InRange(world.Simulation.Bodies[slab].Pose.Position.Y, thickness / 2 - 1e-3f, thickness / 2 + 1e-3f);
        }
        Assert.InRange(world.Simulation.Bodies[slab].Velocity.Linear.Length(), 0, 2e-3f);
    }

    public static TheoryData<LevelGround, float> Hammers
    {
        get
        {
            var data = new TheoryData<LevelGround, float>();
            foreach (var ground in new[] { LevelGround.Mesh, LevelGround.Field, LevelGround.Boxes, LevelGround.Compound })
            {
                data.Add(ground, 0);
                data.Add(ground, 4);
            }
            return data;
        }
    }

    /// <summary>A hammer with a handle of 3.2 cm lies on its head and the end of its handle.</summary>
    [Theory, MemberData(nameof(Hammers))]
    public void A_thin_hammer_does_not_fall_through(LevelGround ground, float speed)
    {
        const float handle = .032f, head = .1f;
        using var world = new ClusterWorld(isCluster: true);
        LevelTests.AddPlane(world, ground, Quaternion.Identity, default, 2103);
        using var builder = new CompoundBuilder(world.Simulation.BufferPool, world.Simulation.Shapes, 2);
        builder.Add(new Box(.5f, handle, handle), new RigidPose(default(Vector3)), .2f);
        builder.Add(new Box(head, head, .16f), new RigidPose(new Vector3(.25f, 0, 0)), .8f);
        builder.BuildDynamicCompound(out var children, out var inertia, out var center);
        var compound = new Compound(children);
        world.Own(compound);
        var pose = new RigidPose(new Vector3(0, .06f, 0), Quaternion.CreateFromAxisAngle(Vector3.UnitY, .6f));
        var body = world.Simulation.Bodies.Add(BodyDescription.CreateDynamic(
            pose, new BodyVelocity(new Vector3(0, -speed, 0)), inertia, world.Simulation.Shapes.Add(compound), -1f));
        for (int i = 0; i < 240; ++i)
            world.Step(validate: false);
        var moved = world.Simulation.Bodies[body];
        var (position, orientation) = (moved.Pose.Position, moved.Pose.Orientation);
        var lowest = float.MaxValue;
        foreach (var (size, place) in new[] { (new Vector3(.5f, handle, handle), default(Vector3)), (new(head, head, .16f), new Vector3(.25f, 0, 0)) })
        {
            for (int i = 0; i < 8; ++i)
            {
                var corner = place - center + size / 2 * new Vector3((i & 1) * 2 - 1, (i & 2) - 1, (i & 4) / 2 - 1);
                lowest = Math.Min(lowest, (position + Vector3.Transform(corner, orientation)).Y);
            }
        }
        output.WriteLine($"{position} {orientation} lowest {lowest} speed {moved.Velocity.Linear.Length()}");
        Assert.InRange(lowest, -1e-3f, 1e-4f);
        Assert.InRange(moved.Velocity.Linear.Length() + moved.Velocity.Angular.Length() * .25f, 0, 2e-3f);
        Assert.InRange(position.Y, .04f, .055f);
    }
}
