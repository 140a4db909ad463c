using System;
using System.IO;
using System.Text.Json;
using Demos.Scenes;
using Demos.Terminal;
using Xunit;

namespace DemoTests.Runner;

/// <summary>What the exit status says, and where the words go.</summary>
public sealed class DemosCommandTests : IDisposable
{
    const string Falling = """
        scene 1 name falling steps 20 friction 0.5 damping 0 sleep 0
        shapes 2
        box 5 1 5
        box 0.5 0.5 0.5
        bodies 2
        0 1 0 0 0 0 0 0 0 1 0 0 -1 0 0 0 0 1 0 0 0 0 0 0 0
        2 1 1 0 0 0 0 0 0 1 1 0 0.5 0 0 0 0 1 0 0 0 0 0 0 0
        joints 0

        """;

    readonly string folder = Directory.CreateTempSubdirectory("scenes").FullName;

    public void Dispose() => Directory.Delete(folder, true);

    [Fact]
    public void A_run_that_ends_well_writes_its_figures()
    {
        string json = Path.Combine(folder, "run.json");

        (int status, string output, _) = Run("run", File("falling.scene", Falling), "--json", json, "--hash-every", "5", "--warmup", "2");

        Assert.Equal(DemosCommand.Finished, status);
        JsonElement root = JsonDocument.Parse(System.IO.File.ReadAllBytes(json)).RootElement;
        Assert.Equal("falling", root.GetProperty("scene").GetString());
        Assert.Equal(20, root.GetProperty("steps").GetInt32());
        Assert.Equal(1, root.GetProperty("bodies").GetInt32());
        Assert.Equal(1, root.GetProperty("statics").GetInt32());
        Assert.Equal(4, root.GetProperty("hashes").GetArrayLength());
        Assert.Equal(root.GetProperty("hash").GetString(), root.GetProperty("hashes")[3][1].GetString());
        Assert.Contains(root.GetProperty("hash").GetString()!, output, StringComparison.Ordinal);
        Assert.DoesNotContain('\u001b', output);
    }

    [Fact]
    public void Bad_input_is_told_on_standard_error_and_leaves_no_json()
    {
        string json = Path.Combine(folder, "run.json");
        string scene = File("bad.scene", Falling.Replace("box 5 1 5", "box 5 x 5", StringComparison.Ordinal));

        (int status, string output, string error) = Run("run", scene, "--json", json);

        Assert.Equal(DemosCommand.BadInput, status);
        Assert.Empty(output);
        Assert.Contains("line 3: ", error, StringComparison.Ordinal);
        Assert.Contains("'x'", error, StringComparison.Ordinal);
        Assert.False(System.IO.File.Exists(json));
    }

    [Theory]
    [InlineData("run", "no-such-scene")]
    [InlineData("run", "no-such-file.scene")]
    [InlineData("run", "newton", "--steps", "0")]
    [InlineData("run", "newton", "--steps", "x")]
    [InlineData("run", "newton", "--dt", "nan")]
    [InlineData("run", "newton", "--dt", "0")]
    [InlineData("run", "newton", "--substeps", "0")]
    [InlineData("run", "newton", "--iterations", "-1")]
    [InlineData("run", "newton", "--threads", "0")]
    [InlineData("run", "newton", "--threads", "100000")]
    [InlineData("run", "newton", "--steps", "5", "--warmup", "5")]
    [InlineData("run", "newton", "--frequency", "-1")]
    [InlineData("run", "newton", "--damping-ratio", "1")]
    [InlineData("run", "newton", "--unknown")]
    [InlineData("run")]
    [InlineData("walk")]
    [InlineData("run", "newton", "--json", "no-such-folder/run.json")]
    public void Arguments_that_cannot_be_are_bad_input(params string[] arguments)
    {
        (int status, _, string error) = Run(arguments);

        Assert.Equal(DemosCommand.BadInput, status);
        Assert.NotEmpty(error);
    }

    [Fact]
    public void A_body_that_falls_for_ever_is_lost()
    {
        string json = Path.Combine(folder, "run.json");
        string scene = File("lost.scene", Falling.Replace("1 0 0.5 0 0 0 0 1", "1 9 -49 0 0 0 0 1", StringComparison.Ordinal));

        (int status, _, _) = Run("run", scene, "--steps", "40", "--json", json);

        Assert.Equal(DemosCommand.Unsound, status);
        Assert.Equal(1, JsonDocument.Parse(System.IO.File.ReadAllBytes(json)).RootElement.GetProperty("lost").GetInt32());
    }

    [Fact]
    public void The_list_names_all_scenes()
    {
        (int status, string output, _) = Run("list");

        Assert.Equal(DemosCommand.Finished, status);
        Assert.All(SceneLibrary.Scenes, scene => Assert.Contains(scene.Name, output, StringComparison.Ordinal));
    }

    string File(string name, string content)
    {
        string path = Path.Combine(folder, name);
        System.IO.File.WriteAllText(path, content);
        return path;
    }

    static (int Status, string Output, string Error) Run(params string[] arguments)
    {
        using var output = new StringWriter();
        using var error = new StringWriter();
        int status = DemosCommand.Run(arguments, output, error);
        return (status, output.ToString(), error.ToString());
    }
}
