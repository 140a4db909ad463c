using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using DemoTests.Collidables.Meshes;
using Xunit;

namespace DemoTests.CollisionDetection.Children;

/// <summary>What is inside of a solid mesh gets out by the nearest way, and rests on it.</summary>
public class SolidMeshTests
{
    const float Radius = .1f;

    static ClusterWorld Create(in MeshSample sample, bool isSolid, RigidPose pose, out StaticHandle handle)
    {
        var world = new ClusterWorld(isCluster: true);
        var mesh = new Mesh(sample.Vertices, sample.Indices, Vector3.One, world.Simulation.BufferPool) { Solid = isSolid };
        world.Own(mesh);
        handle = world.Simulation.Statics.Add(new StaticDescription(pose, world.Simulation.Shapes.Add(mesh)));
        return world;
    }

    static BodyHandle Add(ClusterWorld world, string shape, Vector3 position)
    {
        var pose = new RigidPose(position);
        switch (shape)
        {
            case "sphere":
                return world.AddBody(new Sphere(Radius), pose);
            case "capsule":
                return world.AddBody(new Capsule(Radius, .1f), pose with { Orientation = Quaternion.CreateFromAxisAngle(Vector3.UnitX, MathF.PI / 2) });
            case "cylinder":
                return world.AddBody(new Cylinder(.15f, 2 * Radius), pose);
            case "box":
                return world.AddBody(new Box(.3f, 2 * Radius, .2f), pose);
            case "hull":
                Span<Vector3> corners = [new(-.15f, -Radius, -.1f), new(.15f, -Radius, -.1f), new(0, -Radius, .15f), new(0, Radius, 0)];
                var hull = new ConvexHull(corners, world.Simulation.BufferPool, out var center);
                world.Own(hull);
                return world.AddBody(hull, pose with { Position = position + center });
            default:
                using (var builder = new CompoundBuilder(world.Simulation.BufferPool, world.Simulation.Shapes, 2))
                {
                    builder.Add(new Box(.2f, 2 * Radius, .2f), new RigidPose(new Vector3(-.2f, 0, 0)), 1);
                    builder.Add(new Box(.2f, 2 * Radius, .2f), new RigidPose(new Vector3(.2f, 0, 0)), 1);
                    builder.BuildDynamicCompound(out var children, out var inertia, out _);
                    if (shape == "compound")
                    {
                        var compound = new Compound(children);
                        world.Own(compound);
                        return world.Simulation.Bodies.Add(BodyDescription.CreateDynamic(pose, inertia, world.Simulation.Shapes.Add(compound), -1f));
                    }
                    var big = new BigCompound(children, world.Simulation.Shapes, world.Simulation.BufferPool);
                    world.Own(big);
                    return world.Simulation.Bodies.Add(BodyDescription.CreateDynamic(pose, inertia, world.Simulation.Shapes.Add(big), -1f));
                }
        }
    }

    // A table of 4 m, 2 m high, on which all stand with their lowest point a tenth of a metre below their middle: but for the hull, a quarter of its height.
    static float HeightAboveTable(string shape) => shape == "hull" ? 2 * Radius / 4 : Radius;

    /// <summary>A body with its origin .3 m below the top of a solid is lifted at the speed of recovery, 2 m/s, and stays on top.</summary>
    [Theory]
    [InlineData("sphere")]
    [InlineData("capsule")]
    [InlineData("cylinder")]
    [InlineData("box")]
    [InlineData("hull")]
    [InlineData("compound")]
    [InlineData("big compound")]
    public void What_is_inside_comes_out_at_the_nearest_face_and_stays(string shape)
    {
        var turn = Quaternion.CreateFromAxisAngle(Vector3.UnitY, .3f);
        using var world = Create(MeshSample.Box(new(2, 1, 2)), isSolid: true, new RigidPose(new Vector3(3, -1, 5), turn), out _);
        var body = Add(world, shape, new Vector3(3.1f, -.3f, 5.2f));
        for (int i = 0; i < 120; ++i)
        {
            world.Step(validate: false);
            ref var velocity = ref world.Simulation.Bodies[body].Velocity;
            Assert.InRange(velocity.Linear.Length(), 0, 2.1f);
        }
        ref var motion = ref world.Simulation.Bodies[body].MotionState;
        Assert.InRange(motion.Pose.Position.Y, HeightAboveTable(shape) - 2e-3f, HeightAboveTable(shape) + 2e-3f);
        Assert.InRange((motion.Pose.Position - new Vector3(3.1f, 0, 5.2f) - new Vector3(0, motion.Pose.Position.Y, 0)).Length(), 0, .02f);
        Assert.InRange(motion.Velocity.Linear.Length(), 0, .02f);
    }

    [Fact]
    public void Of_a_skin_that_is_not_solid_it_stays_inside()
    {
        using var world = Create(MeshSample.Box(new(2, 1, 2)), isSolid: false, new RigidPose(new Vector3(0, -1, 0)), out _);
        var body = Add(world, "sphere", new Vector3(0, -.3f, 0));
        for (int i = 0; i < 120; ++i)
            world.Step(validate: false);
        Assert.InRange(world.Simulation.Bodies[body].Pose.Position.Y, -100, -3f);
    }

    static ClusterWorld CreateRing() => Create(MeshSample.Torus(1, .4f, 40, 24), isSolid: true, new RigidPose(default(Vector3)), out _);

    [Fact]
    public void What_is_in_the_hole_of_a_ring_is_outside()
    {
        using var world = CreateRing();
        var free = Add(world, "sphere", default);
        var beside = Add(world, "sphere", new Vector3(5, 0, 0));
        for (int i = 0; i < 30; ++i)
            world.Step(validate: false);
        Assert.InRange(world.Simulation.Bodies[free].Pose.Position.Y, -1.5f, -1f);
        Assert.Equal(world.Simulation.Bodies[beside].Pose.Position.Y, world.Simulation.Bodies[free].Pose.Position.Y);
    }

    /// <summary>A ball in the tube of a ring leaves it to the side that is nearest, at the speed of recovery.</summary>
    [Theory, InlineData(.8f, -1), InlineData(1.2f, 1)]
    public void What_is_in_the_tube_of_a_ring_leaves_it_to_the_nearest_side(float place, int side)
    {
        using var world = CreateRing();
        var body = Add(world, "sphere", new Vector3(place, 0, 0));
        const int steps = 20;
        for (int i = 0; i < steps; ++i)
            world.Step(validate: false);
        // The tube reaches from .6 to 1.4 m.
        var way = (world.Simulation.Bodies[body].Pose.Position.X - place) * side;
        Assert.InRange(way, .2f + Radius - .02f, 2.1f * steps / 60);
    }

    /// <summary>A solid body that was put over a static ball gets off it.</summary>
    [Fact]
    public void A_body_that_is_solid_is_pushed_off_what_is_inside_of_it()
    {
        using var world = new ClusterWorld(isCluster: true);
        var sample = MeshSample.Box(new(.5f, .5f, .5f));
        var mesh = new Mesh(sample.Vertices, sample.Indices, Vector3.One, world.Simulation.BufferPool) { Solid = true };
        world.Own(mesh);
        world.Simulation.Statics.Add(new StaticDescription(default(Vector3), world.Simulation.Shapes.Add(new Sphere(Radius))));
        var body = world.Simulation.Bodies.Add(BodyDescription.CreateDynamic(
            new RigidPose(new Vector3(.2f, 0, .05f)), mesh.ComputeClosedInertia(1), world.Simulation.Shapes.Add(mesh), -1f));
        const int steps = 20;
        for (int i = 0; i < steps; ++i)
            world.Step(validate: false);
        // Out by its nearest face, that to -X, at the speed of recovery.
        Assert.InRange(world.Simulation.Bodies[body].Pose.Position.X, .5f + Radius - .01f, .2f + 2.01f * steps / 60);
    }
}
