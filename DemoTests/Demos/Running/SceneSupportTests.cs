using System.Text;
using Demos.Running;
using Demos.Scenes;
using Xunit;

namespace DemoTests.Runner;

/// <summary>What the library cannot do yet is refused by name, before anything is simulated.</summary>
public class SceneSupportTests
{
    /// <summary>A body falls on a static of the same shape, and on a box.</summary>
    [Theory]
    [InlineData("box 0.5 0.5 0.5")]
    [InlineData("sphere 0.5")]
    [InlineData("capsule 0.5 0.25")]
    [InlineData("cylinder 0.5 0.5")]
    [InlineData("hull 4 0 0 0 1 0 0 0 1 0 0 0 1")]
    [InlineData("hull 9 -1 -1 -1 1 -1 -1 -1 1 -1 1 1 -1 -1 -1 1 1 -1 1 -1 1 1 1 1 1 0 0 0")]
    [InlineData("mesh 4 4 0 0 0 1 0 0 0 1 0 0 0 1 0 2 1 0 1 3 0 3 2 1 2 3")]
    public void A_shape_that_exists_loads_and_runs(string shape)
    {
        string text = $"scene 1 name n steps 60 friction 0.5 damping 0 sleep 0\nshapes 2\nbox 9 1 9\n{shape}\nbodies 3\n"
            + "0 1 0 0 0 0 0 0 0 1 0 0 -1 0 0 0 0 1 0 0 0 0 0 0 0\n"
            + "0 1 1 0 0 0 0 0 0 1 0 3 0.5 0 0 0 0 1 0 0 0 0 0 0 0\n"
            + "2 1 1 0 0 0 0 0 0 1 2 3.1 2 0.1 0 0 0 1 0 0 0 0 0 0 0\njoints 0\n";
        using var run = new SceneRun(SceneFile.Parse(Encoding.UTF8.GetBytes(text)), new RunSettings { Warmup = 0 });
        RunResult result = run.Run();

        Assert.Equal((60, 1, 2, 0, 0), (result.Steps, result.Bodies, result.Statics, result.Lost, result.NotFinite));
        Assert.True(result.Contacts > 0, "It fell through both.");
    }

    /// <summary>A box lies on a field whose surface is a slope.</summary>
    [Fact]
    public void A_field_is_read_row_by_row()
    {
        // Heights of 0.25 x at samples 2 m apart in x and 3 m in z; the box is turned by atan(0.25).
        string text = "scene 1 name n steps 60 friction 1 damping 0 sleep 0\nshapes 2\nfield 3 2 2 3 0 0.5 1 0 0.5 1\nbox 0.2 0.2 0.2\nbodies 2\n"
            + "0 1 0 0 0 0 0 0 0 1 0 -1 0 -1 0 0 0 1 0 0 0 0 0 0 0\n"
            + "2 1 1 0 0 0 0 0 0 1 1 1 0.71 0.5 0 0 0.1218693 0.9925462 0 0 0 0 0 0 0\njoints 0\n";
        using var run = new SceneRun(SceneFile.Parse(Encoding.UTF8.GetBytes(text)), new RunSettings { Warmup = 0 });
        RunResult result = run.Run();

        Assert.Equal((1, 1, 0, 0), (result.Bodies, result.Statics, result.Lost, result.NotFinite));
        Assert.Equal(4, result.Contacts);
        Assert.InRange(result.KineticEnergy, 0, 1e-4);
    }

    /// <summary>A body of a mesh and a box lies across the edge between a field and a box, which are one static.</summary>
    [Fact]
    public void Meshes_and_fields_are_parts_of_bodies()
    {
        string cube = "mesh 8 12 -1 -1 -1 1 -1 -1 -1 1 -1 1 1 -1 -1 -1 1 1 -1 1 -1 1 1 1 1 1 "
            + "0 2 3 0 3 1 4 5 7 4 7 6 0 1 5 0 5 4 2 6 7 2 7 3 0 4 6 0 6 2 1 3 7 1 7 5";
        string text = "scene 1 name n steps 120 friction 0.5 damping 0 sleep 0\nshapes 4\n"
            + $"box 4 1 4\nfield 3 3 4 4 0 0 0 0 0 0 0 0 0\n{cube}\nbox 1 1 1\nbodies 2\n"
            + "0 2 0 12 -1 4 0 0 0 1 1 0 0 0 0 0 0 1 0 0 0 0 0 0 0 1 0 0 0 0 0 0 0\n"
            + "2 2 2 0 0 0 0 0 0 1 3 2 0 0 0 0 0 1 2 7 1.01 4 0 0 0 1 0 0 0 0 0 0 0\njoints 0\n";
        using var run = new SceneRun(SceneFile.Parse(Encoding.UTF8.GetBytes(text)), new RunSettings { Warmup = 0 });
        RunResult result = run.Run();

        Assert.Equal((1, 1, 0, 0), (result.Bodies, result.Statics, result.Lost, result.NotFinite));
        Assert.True(result.Contacts > 2, "It is not there, or leans.");
        Assert.InRange(result.KineticEnergy, 0, 1e-4);
    }

    [Fact]
    public void A_field_among_parts_has_no_mass()
    {
        var error = Assert.Throws<SceneException>(() => Build("field 2 2 1 1 0 0 0 0",
            "2 2 0 0 0 0 0 0 0 1 1 1 0 0 0 0 0 1 1 0 0 0 0 0 0 1 0 0 0 0 0 0 0"));

        Assert.Equal("field", error.Token);
    }

    [Theory]
    [InlineData("field 1 2 1 1 0 0", "1")]
    [InlineData("field 2 2 1 0 0 0 0 0", "0")]
    [InlineData("field 2 2 1 1 0 0 0 x", "x")]
    public void A_field_that_is_wrong_is_refused_with_its_line(string shape, string token)
    {
        var error = Assert.Throws<SceneException>(() => Build(shape, "0 1 1 0 0 0 0 0 0 1 0 0 0 0 0 0 0 1 0 0 0 0 0 0 0"));

        Assert.Equal((4, token), (error.Line, error.Token));
    }

    [Fact]
    public void A_field_has_no_mass()
    {
        var error = Assert.Throws<SceneException>(() => Build("field 2 2 1 1 0 0 0 0", "2 1 1 0 0 0 0 0 0 1 1 0 0 0 0 0 0 1 0 0 0 0 0 0 0"));

        Assert.Equal((6, "field"), (error.Line, error.Token));
    }

    [Theory]
    [InlineData("hull 4 0 0 0 1 0 0 0 1 0 1 1 0")]
    [InlineData("hull 5 0 0 0 1 1 1 2 2 2 3 3 3 4 4 4")]
    public void A_hull_without_volume_is_refused_with_its_line(string shape)
    {
        var error = Assert.Throws<SceneException>(() => Build(shape, "2 1 1 0 0 0 0 0 0 1 1 0 0 0 0 0 0 1 0 0 0 0 0 0 0"));

        Assert.Equal((4, "hull"), (error.Line, error.Token));
    }

    [Fact]
    public void A_mesh_without_a_surface_is_refused_with_its_line()
    {
        var error = Assert.Throws<SceneException>(() => Build("mesh 3 1 0 0 0 1 0 0 2 0 0 0 1 2", "0 1 1 0 0 0 0 0 0 1 0 0 0 0 0 0 0 1 0 0 0 0 0 0 0"));

        Assert.Equal((4, "mesh"), (error.Line, error.Token));
    }

    [Theory]
    [InlineData("2 2 0 0 0 0 0 0 0 1 0 0 1 0 0 0 0 1 1 0 0 -1 0 0 0 1 0 0 0 0 0 0 0")]
    [InlineData("0 1 0 0 1 0 0 0 0 1 0 0 -1 0 0 0 0 1 0 0 0 0 0 0 0")]
    public void A_body_of_displaced_shapes_runs(string body)
    {
        string text = $"scene 1 name n steps 1 friction 0.5 damping 0 sleep 0\nshapes 2\nbox 1 1 1\nsphere 1\nbodies 1\n{body}\njoints 0\n";
        using var run = new SceneRun(SceneFile.Parse(Encoding.UTF8.GetBytes(text)), new RunSettings { Warmup = 0 });
        RunResult result = run.Run();

        Assert.Equal((1, 0, 0), (result.Bodies + result.Statics, result.Lost, result.NotFinite));
    }

    [Theory]
    [InlineData("2 1 0 0 0 0 0 0 0 1 1e-45 0 0 0 0 0 0 1 0 0 0 0 0 0 0")]
    [InlineData("2 1 0 0 0 0 0 0 0 1 1e-39 0 0 0 0 0 0 1 0 0 0 0 0 0 0")]
    public void A_mass_without_inverse_is_refused_with_its_line(string body)
    {
        Assert.Equal(6, Assert.Throws<SceneException>(() => Build("sphere 1", body)).Line);
    }

    static void Build(string shape, string body)
    {
        string text = $"scene 1 name n steps 1 friction 0.5 damping 0 sleep 0\nshapes 2\nbox 1 1 1\n{shape}\nbodies 1\n{body}\njoints 0\n";
        using var run = new SceneRun(SceneFile.Parse(Encoding.UTF8.GetBytes(text)), new RunSettings());
    }
}
