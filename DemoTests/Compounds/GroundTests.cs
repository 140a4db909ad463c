using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using DemoTests.Collidables.Meshes;
using Xunit;

namespace DemoTests.Compounds;

/// <summary>Bodies made of children on ground that is no convex shape.</summary>
public class GroundTests
{
    static void AddGround(CompoundWorld world, int type)
    {
        var shapes = world.Simulation.Shapes;
        // Neither of the two along the axes.
        var turn = Quaternion.CreateFromAxisAngle(Vector3.UnitY, .4f);
        if (type == HalfSpace.Id)
            world.Simulation.Statics.Add(new StaticDescription(new Vector3(3, 0, -70), turn, shapes.Add(new HalfSpace(Vector3.UnitY))));
        else
        {
            var corner = Vector3.Transform(new Vector3(-10, 0, -10), turn);
            world.Simulation.Statics.Add(new StaticDescription(corner, turn, shapes.Add(new HeightField(21, 21, 1, 1, new float[441], world.Pool))));
        }
    }

    static void Rest(CompoundWorld world, BodyHandle handle, float height)
    {
        for (int i = 0; i < 180; ++i)
            world.Step(validate: i % 30 == 0);
        var start = world.Simulation.Bodies[handle].Pose;
        for (int i = 0; i < 240; ++i)
            world.Step();
        var body = world.Simulation.Bodies[handle];
        Assert.InRange(body.Pose.Position.Y, height - 5e-4f, height + 5e-4f);
        Assert.InRange((body.Pose.Position - start.Position).Length(), 0, 5e-4f);
        Assert.InRange(body.Velocity.Linear.Length() + body.Velocity.Angular.Length(), 0, 1e-3f);
        Assert.False(body.Awake, "it does not sleep");
    }

    [Theory]
    [InlineData(HalfSpace.Id, false), InlineData(HalfSpace.Id, true), InlineData(HeightField.Id, false), InlineData(HeightField.Id, true)]
    public void A_compound_rests(int ground, bool isBig)
    {
        using var world = new CompoundWorld();
        AddGround(world, ground);
        // A table on four legs: a plate of .8 kg at 1 m and legs of .036 kg at .45 m.
        var center = (.8f * 1 + 4 * .036f * .45f) / (.8f + 4 * .036f);
        var table = world.AddBody(new RigidPose(new Vector3(.2f, center + .1f, .3f)), default, isBig,
            (new(2, .2f, 2), new RigidPose(new Vector3(0, 1, 0))),
            (new(.2f, .9f, .2f), new RigidPose(new Vector3(-.8f, .45f, -.8f))), (new(.2f, .9f, .2f), new RigidPose(new Vector3(.8f, .45f, -.8f))),
            (new(.2f, .9f, .2f), new RigidPose(new Vector3(-.8f, .45f, .8f))), (new(.2f, .9f, .2f), new RigidPose(new Vector3(.8f, .45f, .8f))));
        world.Simulation.Bodies[table].Activity.SleepThreshold = .01f;
        Rest(world, table, center);
    }

    [Theory, InlineData(HalfSpace.Id), InlineData(HeightField.Id)]
    public void A_mesh_rests(int ground)
    {
        using var world = new CompoundWorld();
        AddGround(world, ground);
        var sample = MeshSample.Torus(.8f, .25f, 16, 8);
        var mesh = new Mesh(sample.Vertices, sample.Indices, Vector3.One, world.Pool);
        var lowest = 0f;
        foreach (var vertex in sample.Vertices)
            lowest = Math.Min(lowest, vertex.Y);
        var body = world.Simulation.Bodies.Add(BodyDescription.CreateDynamic(
            new Vector3(.2f, .1f - lowest, .3f), mesh.ComputeClosedInertia(1), world.Simulation.Shapes.Add(mesh), .01f));
        Rest(world, body, -lowest);
    }
}
