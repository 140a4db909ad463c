using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuUtilities.Memory;
using DemoTests.Collidables.Meshes;
using DemoTests.Support;
using Xunit;

namespace DemoTests.Compounds;

/// <summary>Bodies on and of compounds whose children are made of children.</summary>
public class NestedMotionTests
{
    public enum Ground
    {
        Mesh,
        Field,
        Compound,
        BigCompound,
    }

    static readonly Quaternion turn = Quaternion.CreateFromAxisAngle(Vector3.UnitY, .3f);

    static TypedIndex Add(CompoundWorld world, bool isBig, params (TypedIndex Shape, RigidPose Pose)[] parts)
    {
        world.Pool.Take(parts.Length, out Buffer<CompoundChild> children);
        for (int i = 0; i < parts.Length; ++i)
            children[i] = new(parts[i].Pose, parts[i].Shape);
        return isBig
            ? world.Simulation.Shapes.Add(new BigCompound(children, world.Simulation.Shapes, world.Pool))
            : world.Simulation.Shapes.Add(new Compound(children));
    }

    // A surface from x = -6 on, at the height of its origin.
    static (TypedIndex Shape, RigidPose Pose) AddFloor(CompoundWorld world, Ground ground)
    {
        var shapes = world.Simulation.Shapes;
        switch (ground)
        {
            case Ground.Mesh:
                var sample = MeshSample.Terrain(12, 0);
                return (shapes.Add(new Mesh(sample.Vertices, sample.Indices, Vector3.One, world.Pool)), new(new Vector3(0, 0, .3f)));
            case Ground.Field:
                return (shapes.Add(new HeightField(13, 13, 1, 1, new float[169], world.Pool)), new(new Vector3(-6, 0, -5.7f)));
            default:
                var box = shapes.Add(new Box(4, 1, 12));
                return (Add(world, ground == Ground.BigCompound, (box, new(new Vector3(-4, -.5f, 0))), (box, new(new Vector3(0, -.5f, 0))),
                    (box, new(new Vector3(4, -.5f, 0)))), RigidPose.Identity);
        }
    }

    /// <summary>Over the edges between the pieces of one child, then onto a box at the same height, and onto another mesh.</summary>
    [Theory]
    [InlineData(Ground.Mesh, false), InlineData(Ground.Mesh, true), InlineData(Ground.Field, false), InlineData(Ground.Field, true)]
    [InlineData(Ground.Compound, true), InlineData(Ground.BigCompound, false)]
    public void A_ball_rolls_from_child_to_child_as_on_one(Ground ground, bool isBig)
    {
        using var world = new CompoundWorld();
        var floor = AddFloor(world, ground);
        var box = world.Simulation.Shapes.Add(new Box(4, 1, 12));
        // The child ends at x = 6; the whole is turned and elsewhere, and so is each part within it.
        var sample = MeshSample.Terrain(4, 0);
        var mesh = world.Simulation.Shapes.Add(new Mesh(sample.Vertices, sample.Indices, new(-1, 1, 3), world.Pool));
        var half = Quaternion.CreateFromAxisAngle(Vector3.UnitY, MathF.PI);
        var whole = Add(world, isBig, floor, (box, new(new Vector3(8, -.5f, 0))), (mesh, new(new Vector3(12, 0, 0), half)));
        world.Simulation.Statics.Add(new StaticDescription(new Vector3(30, 2, -7), turn, whole));
        const float Speed = 5;
        var along = Vector3.Transform(Vector3.UnitX, turn);
        var start = new Vector3(30, 2.5f, -7) + Vector3.Transform(new Vector3(-4.8f, 0, .17f), turn);
        var ball = new Sphere(.5f);
        var spin = Vector3.Cross(Vector3.UnitY, along) * (Speed / .5f);
        var body = world.Simulation.Bodies.Add(BodyDescription.CreateDynamic(
            start, new BodyVelocity(along * Speed, spin), ball.ComputeInertia(1), world.Simulation.Shapes.Add(ball), -1f));
        const int StepCount = 216;
        for (int i = 0; i < StepCount; ++i)
        {
            world.Step();
            // It settles to its place in the contact's springs first.
            if (i < 6)
                continue;
            var velocity = world.Simulation.Bodies[body].Velocity.Linear;
            Assert.InRange(Vector3.Dot(velocity, along), Speed - .002f, Speed + .002f);
            Assert.InRange(velocity.Y, -5e-3f, 5e-3f);
            Assert.InRange(world.Simulation.Bodies[body].Pose.Position.Y, 2.4997f, 2.5003f);
        }
        var way = Vector3.Dot(world.Simulation.Bodies[body].Pose.Position - start, along);
        Assert.Equal(Speed * StepCount / 60, way, .01f);
    }

    [Theory, InlineData(Ground.Mesh), InlineData(Ground.Field), InlineData(Ground.Compound)]
    public void A_box_rests_on_a_child_for_ten_seconds(Ground ground)
    {
        using var world = new CompoundWorld();
        var whole = Add(world, isBig: false, AddFloor(world, ground), (world.Simulation.Shapes.Add(new Box(1, 1, 1)), new(new Vector3(0, 5, 30))));
        world.Simulation.Statics.Add(new StaticDescription(new Vector3(3, -1, 2), turn, whole));
        var box = new Box(1.2f, .8f, 1.7f);
        var body = world.Simulation.Bodies.Add(BodyDescription.CreateDynamic(
            new Vector3(3.3f, -.6f, 2.2f), box.ComputeInertia(3), world.Simulation.Shapes.Add(box), -1f));
        for (int i = 0; i < 600; ++i)
            world.Step(validate: i % 150 == 0);
        var reference = world.Simulation.Bodies[body];
        Assert.InRange((reference.Pose.Position - new Vector3(3.3f, -.6f, 2.2f)).Length(), 0, 5e-4f);
        Assert.InRange(reference.Velocity.Linear.Length() + reference.Velocity.Angular.Length(), 0, 1e-3f);
    }

    /// <summary>What a static is made of may be said in one way or another: each body moves by the same bits.</summary>
    [Theory, InlineData(Ground.Mesh), InlineData(Ground.Field), InlineData(Ground.Compound), InlineData(Ground.BigCompound)]
    public void One_child_is_as_good_as_the_shape_itself(Ground ground)
    {
        var states = new List<int[]>();
        foreach (var isNested in (bool[])[false, true])
        {
            using var world = new CompoundWorld();
            var (floor, pose) = AddFloor(world, ground);
            var shape = isNested ? Add(world, ground == Ground.Mesh, (floor, RigidPose.Identity)) : floor;
            world.Simulation.Statics.Add(new StaticDescription(pose, shape));
            AddBodies(world);
            for (int i = 0; i < 60; ++i)
                world.Step();
            states.Add(world.State());
        }
        Assert.Equal(states[0], states[1]);
    }

    // Convex ones, compounds, and compounds with a mesh in them; they fall in a heap.
    static void AddBodies(CompoundWorld world)
    {
        var shapes = world.Simulation.Shapes;
        var sample = MeshSample.Box(new(.25f, .35f, .3f));
        var mesh = shapes.Add(new Mesh(sample.Vertices, sample.Indices, Vector3.One, world.Pool));
        var sphere = shapes.Add(new Sphere(.3f));
        var both = Add(world, isBig: false, (mesh, new(new Vector3(-.3f, 0, 0), turn)), (sphere, new(new Vector3(.3f, 0, 0))));
        var inertia = new Box(1, .6f, .6f).ComputeInertia(1);
        for (int i = 0; i < 12; ++i)
        {
            var pose = new RigidPose(new Vector3(i % 3 * .7f, .5f + i * .35f, i % 2 * .4f), Quaternion.CreateFromYawPitchRoll(i, .3f * i, .1f));
            world.Simulation.Bodies.Add(BodyDescription.CreateDynamic(pose, inertia, i % 3 == 0 ? both : i % 3 == 1 ? sphere : mesh, -1f));
        }
    }

    [Fact]
    public void A_step_takes_nothing_from_the_garbage_collector()
    {
        using var world = new CompoundWorld();
        var floor = AddFloor(world, Ground.Field);
        world.Simulation.Statics.Add(new StaticDescription(RigidPose.Identity, Add(world, isBig: false, floor, AddFloor(world, Ground.Compound))));
        AddBodies(world);
        for (int i = 0; i < 40; ++i)
            world.Step();
        Assert.Equal(0, Garbage.Of(() => world.Step()));
    }

    [Fact]
    public void Threads_change_no_bit()
    {
        var states = new List<int[]>();
        foreach (var threads in (int[])[1, 3])
        {
            using var world = new CompoundWorld(threads);
            var floor = AddFloor(world, Ground.Field);
            world.Simulation.Statics.Add(new StaticDescription(RigidPose.Identity, Add(world, isBig: true, floor, AddFloor(world, Ground.Compound))));
            AddBodies(world);
            for (int i = 0; i < 60; ++i)
                world.Step(validate: i % 20 == 0);
            states.Add(world.State());
        }
        Assert.Equal(states[0], states[1]);
    }

    /// <summary>A box that is a mesh beside a box is a box: it tumbles as one, and comes to rest on its face.</summary>
    [Theory, InlineData(false), InlineData(true)]
    public void A_body_of_a_closed_mesh_and_a_box_falls_and_rests(bool isBig)
    {
        using var world = new CompoundWorld();
        world.AddStatic(isBig: false, (new(20, 1, 20), new RigidPose(new Vector3(0, -.5f, 0))));
        var sample = MeshSample.Box(new(.5f, .3f, .4f)).Moved(new(.2f, .1f, 0));
        var shapes = world.Simulation.Shapes;
        var mesh = shapes.Add(new Mesh(sample.Vertices, sample.Indices, Vector3.One, world.Pool));
        var shape = Add(world, isBig, (mesh, new(new Vector3(-.7f, -.1f, 0))), (shapes.Add(new Box(1, .6f, .8f)), new(new Vector3(.5f, 0, 0))));
        var inertia = isBig
            ? shapes.GetShape<BigCompound>(shape.Index).ComputeInertia([2f, 2], shapes, out _)
            : shapes.GetShape<Compound>(shape.Index).ComputeInertia([2f, 2], shapes, out _);
        var lean = Quaternion.CreateFromAxisAngle(Vector3.UnitZ, .2f);
        var body = world.Simulation.Bodies.Add(BodyDescription.CreateDynamic(new RigidPose(new Vector3(0, 1.2f, 0), lean), inertia, shape, -1f));
        for (int i = 0; i < 240; ++i)
            world.Step(validate: i % 60 == 0);
        var reference = world.Simulation.Bodies[body];
        Assert.InRange(reference.Pose.Position.Y, .2995f, .3005f);
        Assert.InRange(Vector3.Transform(Vector3.UnitY, reference.Pose.Orientation).Y, .99999f, 1.00001f);
        Assert.InRange(reference.Velocity.Linear.Length() + reference.Velocity.Angular.Length(), 0, 1e-3f);
    }

    /// <summary>A child may be taken away between steps: numbers follow, and what lay on it falls.</summary>
    [Theory, InlineData(false), InlineData(true)]
    public void Children_may_go_while_bodies_lie_on_them(bool isBig)
    {
        using var world = new CompoundWorld();
        var floor = AddFloor(world, Ground.Mesh);
        var box = world.Simulation.Shapes.Add(new Box(2, 1, 2));
        var shape = Add(world, isBig, (box, new(new Vector3(20, 2, 0))), floor, (box, new(new Vector3(0, 2, 0))));
        world.Simulation.Statics.Add(new StaticDescription(RigidPose.Identity, shape));
        var ball = new Sphere(.5f);
        var name = world.Simulation.Shapes.Add(ball);
        var upper = world.Simulation.Bodies.Add(BodyDescription.CreateDynamic(new Vector3(0, 3, 0), ball.ComputeInertia(1), name, -1f));
        var lower = world.Simulation.Bodies.Add(BodyDescription.CreateDynamic(new Vector3(4.2f, .5f, 1.3f), ball.ComputeInertia(1), name, -1f));
        for (int i = 0; i < 20; ++i)
            world.Step();
        Assert.Equal(3, world.Simulation.Bodies[upper].Pose.Position.Y, 1e-3f);
        if (isBig)
            world.Simulation.Shapes.GetShape<BigCompound>(shape.Index).RemoveAt(2, world.Pool);
        else
            world.Simulation.Shapes.GetShape<Compound>(shape.Index).RemoveAt(2, world.Pool);
        for (int i = 0; i < 120; ++i)
            world.Step(validate: i < 5);
        Assert.Equal(.5f, world.Simulation.Bodies[upper].Pose.Position.Y, 1e-3f);
        Assert.Equal(.5f, world.Simulation.Bodies[lower].Pose.Position.Y, 1e-3f);
        Assert.InRange((world.Simulation.Bodies[lower].Pose.Position - new Vector3(4.2f, .5f, 1.3f)).Length(), 0, 1e-3f);
    }
}
