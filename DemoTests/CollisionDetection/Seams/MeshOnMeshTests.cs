using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using DemoTests.Collidables.Meshes;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.CollisionDetection.Seams;

/// <summary>
/// A body that is a mesh, on a floor of triangles. Neither has any depth: as soon as the bottom of a box has given way by a millimetre it is behind the
/// floor as a whole, and meets it no more.
/// </summary>
public class MeshOnMeshTests
{
    static readonly Vector3 half = new(.5f, .15f, .5f);

    public static TheoryData<string, float, float, bool> Cases()
    {
        var cases = new TheoryData<string, float, float, bool>();
        foreach (var floor in (string[])["one triangle", "cells of a metre", "cells of .23 m", "heights", "box"])
        {
            foreach (var fall in (float[])[0, .01f, .3f])
            {
                cases.Add(floor, fall, .07f, false);
                cases.Add(floor, fall, .93f, true);
            }
        }
        return cases;
    }

    [Theory, MemberData(nameof(Cases))]
    public void A_box_made_of_triangles_comes_to_rest_where_a_box_does(string floor, float fall, float across, bool isSolid)
    {
        using var world = new TestWorld();
        AddFloor(world, floor);
        var box = MeshSample.Box(half);
        var mesh = new Mesh(box.Vertices, box.Indices, Vector3.One, world.Pool) { Solid = isSolid };
        var body = world.Bodies.Add(BodyDescription.CreateDynamic(new RigidPose(new Vector3(across, half.Y + fall, .41f * across)),
            mesh.ComputeClosedInertia(1), world.Simulation.Shapes.Add(mesh), -1));
        List<(float Height, Vector3 Linear, Vector3 Angular)> steps = [];
        for (int i = 0; i < 120; ++i)
        {
            world.Step();
            var place = world.Bodies[body];
            steps.Add((place.Pose.Position.Y, place.Velocity.Linear, place.Velocity.Angular));
        }
        world.Simulation.DisposeHulls();
        // Contacts give way by an eighth of the way of a step, which is 4 cm at the end of a fall of .3 m.
        Assert.All(steps, step => Assert.InRange(step.Height, half.Y - .01f, half.Y + fall + .001f));
        Assert.All(steps[90..], step => Assert.Equal(half.Y, step.Height, .001f));
        Assert.All(steps[90..], step => Assert.InRange(step.Linear.Length() + step.Angular.Length(), 0, .01f));
    }

    static void AddFloor(TestWorld world, string floor)
    {
        switch (floor)
        {
            case "one triangle":
                world.AddStatic(new Triangle(new(-8, 0, -4), new(8, 0, -4), new(0, 0, 8)), RigidPose.Identity);
                break;
            case "heights":
                Add(world, new HeightField(9, 9, 1, 1, new float[81], world.Pool), new Vector3(-4, 0, -4));
                break;
            case "box":
                var box = MeshSample.Box(new(4, .5f, 4));
                Add(world, new Mesh(box.Vertices, box.Indices, Vector3.One, world.Pool), new Vector3(0, -.5f, 0));
                break;
            default:
                var cells = floor == "cells of a metre" ? 8 : 35;
                var flat = MeshSample.Terrain(cells, 0);
                Add(world, new Mesh(flat.Vertices, flat.Indices, new Vector3(8f / cells, 1, 8f / cells), world.Pool), default);
                break;
        }
    }

    static void Add<TShape>(TestWorld world, TShape shape, Vector3 place) where TShape : unmanaged, IDisposableShape =>
        world.Statics.Add(new StaticDescription(new RigidPose(place), world.Simulation.Shapes.Add(shape)));
}
