using System;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using DemoTests.Collidables.Meshes;
using DemoTests.CollisionDetection.Children;
using DemoTests.Support;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.CollisionDetection.Seams;

/// <summary>A body that is a mesh slides over triangles and tiles as over one box: neither its own inner edges nor those of the floor are felt.</summary>
public class MeshSlideTests(ITestOutputHelper output)
{
    // m/s.
    const float GreatestUpward = 5e-3f;

    public static TheoryData<string, SeparateFloor> Cases()
    {
        var cases = new TheoryData<string, SeparateFloor>();
        foreach (var mover in (string[])["box", "turned slab", "plate of cells", "torus"])
        {
            foreach (var floor in (SeparateFloor[])[SeparateFloor.Boxes, SeparateFloor.Fields, SeparateFloor.Meshes, SeparateFloor.Junctions])
                cases.Add(mover, floor);
        }
        return cases;
    }

    /// <summary>Without friction nothing changes its speed, and nothing lifts it.</summary>
    [Theory, MemberData(nameof(Cases))]
    public void A_mesh_that_slides_keeps_its_speed(string mover, SeparateFloor floor)
    {
        foreach (var speed in (float[])[1, 5, 20])
        {
            var (along, across, height, up) = Compare(mover, floor, 0, speed);
            Assert.InRange(along, 0, 1e-3f * speed);
            Assert.InRange(across, 0, 1e-3f * speed);
            Assert.InRange(height, -1, 1e-4f);
            // What touches along a line alone sinks and comes back.
            if (mover != "torus")
                Assert.InRange(up, 0, GreatestUpward);
        }
    }

    /// <summary>With friction its bottom is pressed deeper in front than behind, and has contacts all over all the same.</summary>
    [Theory]
    [InlineData("box", SeparateFloor.Fields), InlineData("box", SeparateFloor.Meshes), InlineData("turned slab", SeparateFloor.Boxes)]
    [InlineData("turned slab", SeparateFloor.Meshes), InlineData("turned slab", SeparateFloor.Junctions)]
    [InlineData("plate of cells", SeparateFloor.Fields), InlineData("plate of cells", SeparateFloor.Meshes)]
    [InlineData("plate of cells", SeparateFloor.Junctions)]
    public void Friction_slows_a_mesh_as_on_one_box(string mover, SeparateFloor floor)
    {
        const float Friction = .5f;
        foreach (var speed in (float[])[1, 5, 20])
        {
            var (along, across, height, up) = Compare(mover, floor, Friction, speed);
            Assert.InRange(along, 0, 1e-3f * speed + Friction * GreatestUpward);
            Assert.InRange(across, 0, 5e-3f * speed + Friction * GreatestUpward);
            Assert.InRange(height, -2e-4f, 1e-4f);
            Assert.InRange(up, 0, GreatestUpward);
        }
    }

    // By how much velocities along and across the way differ at most, how much higher it is, and how much faster it rises than on one box.
    (float Along, float Across, float Height, float Up) Compare(string mover, SeparateFloor floor, float friction, float speed)
    {
        using var expected = new ClusterWorld(isCluster: true);
        using var actual = new ClusterWorld(isCluster: true);
        expected.Behaviour.Friction = actual.Behaviour.Friction = friction;
        expected.Simulation.Statics.Add(new StaticDescription(new Vector3(0, -.5f, 0), expected.Simulation.Shapes.Add(new Box(80, 1, 80))));
        SeparateFloors.Add(actual, floor, LevelSeeds.Of(1001));
        var (one, other) = (Add(expected, mover, speed), Add(actual, mover, speed));
        float along = 0, across = 0, height = float.MinValue, up = 0;
        for (int i = 0; i < (int)(Math.Min(15 / speed, 1.5f) * 60); ++i)
        {
            expected.Step(validate: false);
            actual.Step(validate: i % 16 == 0);
            var (a, b) = (expected.Simulation.Bodies[one], actual.Simulation.Bodies[other]);
            along = Math.Max(along, Math.Abs(a.Velocity.Linear.X - b.Velocity.Linear.X));
            across = Math.Max(across, Math.Abs(a.Velocity.Linear.Z - b.Velocity.Linear.Z));
            height = Math.Max(height, b.Pose.Position.Y - a.Pose.Position.Y);
            up = Math.Max(up, b.Velocity.Linear.Y - Math.Max(0, a.Velocity.Linear.Y));
        }
        output.WriteLine($"friction {friction} speed {speed}: along {along}, across {across} m/s, height {height * 1000} mm, up {up * 1000} mm/s");
        return (along, across, height, up);
    }

    static BodyHandle Add(ClusterWorld world, string mover, float speed)
    {
        var sample = mover switch
        {
            "box" => MeshSample.Box(new(.25f)),
            "turned slab" => MeshSample.Box(new(.5f, .15f, .5f)),
            "plate of cells" => MeshSample.Blocks(Cuts(.35f), [-.15f, .15f], Cuts(.25f), (_, _, _) => true),
            _ => MeshSample.Torus(.4f, .15f, 16, 8),
        };
        var mesh = new Mesh(sample.Vertices, sample.Indices, Vector3.One, world.Simulation.BufferPool);
        world.Own(mesh);
        var turn = Quaternion.CreateFromAxisAngle(Vector3.UnitY, mover == "box" ? 0 : .4f);
        // A tenth of a millimetre in the floor, as what rests there is.
        var place = new Vector3(0, -sample.Vertices.Min(vertex => vertex.Y) - 1e-4f, 0);
        return world.Simulation.Bodies.Add(BodyDescription.CreateDynamic(new RigidPose(place, turn), new BodyVelocity(new Vector3(speed, 0, 0)),
            mesh.ComputeClosedInertia(1), world.Simulation.Shapes.Add(mesh), -1f));
    }

    // Borders of four cells.
    static float[] Cuts(float half) => [.. Enumerable.Range(-2, 5).Select(i => half * i / 2)];
}
