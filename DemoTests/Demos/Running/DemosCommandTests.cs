using System;
using System.Diagnostics;
using System.Globalization;
using System.IO;
using System.Linq;
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

    [Fact]
    public void A_batch_runs_line_by_line_and_ends_with_the_greatest_status()
    {
        using var output = new StringWriter { NewLine = "\n" };

        int status = BatchCommand.Run(new StringReader("2 steps\n\n1 step\n"), output, line =>
        {
            output.WriteLine($"ran {line}");
            return line[0] - '0';
        });

        Assert.Equal(2, status);
        Assert.Equal("ran 2 steps\nexit status 2\nran 1 step\nexit status 1\n", output.ToString());
        Assert.Equal(DemosCommand.Finished, BatchCommand.Run(TextReader.Null, output, _ => DemosCommand.BadInput));
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
    [InlineData("run", "newton", "--json", "")]
    [InlineData("run", "newton", "--json", " ")]
    [InlineData("run", "newton", "--json", ".")]
    [InlineData("run", "newton", "--json", "a\0b")]
    [InlineData("run", "newton", "--dt", "1e30")]
    [InlineData("run", "newton", "--dt", "")]
    [InlineData("run", "newton", "--dt", "-1")]
    [InlineData("run", "newton", "--dt", "infinity")]
    [InlineData("run", "newton", "--substeps", "2147483647")]
    [InlineData("run", "newton", "--iterations", "2147483647")]
    [InlineData("run", "newton", "--relaxations", "2147483647")]
    [InlineData("run", "newton", "--substeps", "100000", "--iterations", "100000")]
    [InlineData("run", "newton", "--substeps", "99999999999")]
    [InlineData("run", "newton", "--relaxations", "-1")]
    [InlineData("run", "newton", "--hash-every", "-1")]
    [InlineData("run", "newton", "--warmup", "-1")]
    [InlineData("run", "newton", "--frequency", "1e38")]
    [InlineData("run", "newton", "--frequency", "30", "--damping-ratio", "1e38")]
    [InlineData("run", "newton", "--frequency", "30", "--damping-ratio", "nan")]
    [InlineData("run", "")]
    [InlineData("run", " ")]
    [InlineData("run", "/")]
    public void Arguments_that_cannot_be_are_bad_input(params string[] arguments)
    {
        (int status, _, string error) = Run(arguments);

        Assert.Equal(DemosCommand.BadInput, status);
        Assert.NotEmpty(error);
    }

    [Fact]
    public void The_row_of_a_level_has_times_and_rays_that_hit()
    {
        (int status, string output, _) = Run("levels", "--row", "--repetitions", "1");

        Assert.Equal(DemosCommand.Finished, status);
        double[] figures = [.. output.Split(';').Skip(1).Select(cell => double.Parse(cell, CultureInfo.InvariantCulture))];
        Assert.Equal(4, figures.Length);
        Assert.All(figures[..3], time => Assert.InRange(time, double.Epsilon, double.MaxValue));
        // Hills that reach as far as the rays do: most come down within them.
        Assert.InRange(figures[3], .8, 1);
        Assert.Equal(DemosCommand.BadInput, Run("levels", "--repetitions", "0").Status);
    }

    [Fact]
    public void A_file_that_was_there_is_kept_until_there_are_figures()
    {
        string json = File("old.json", "old");

        Assert.Equal(DemosCommand.BadInput, Run("run", "newton", "--steps", "-1", "--json", json).Status);
        Assert.Equal("old", System.IO.File.ReadAllText(json));
        Assert.Equal(DemosCommand.BadInput, Run("run", "newton", "--json", json, "--json", "").Status);
        Assert.Equal("old", System.IO.File.ReadAllText(json));
    }

    [Fact]
    public void A_signal_ends_a_run_with_its_figures_so_far()
    {
        if (OperatingSystem.IsWindows())
            return;
        string scene = File("falling.scene", Falling);
        const int steps = int.MaxValue;
        string json = Path.Combine(folder, "run.json");
        using Process process = Start("run", scene, "--steps", steps.ToString(CultureInfo.InvariantCulture), "--json", json);
        // Long enough that it runs, on a busy machine too: a signal that comes before there is a run ends the process as ever.
        Assert.False(process.WaitForExit(TimeSpan.FromSeconds(5)));

        // The signal for ending: what Ctrl-C sends is ignored by processes that a shell started in the background.
        using Process kill = Process.Start("kill", ["-s", "TERM", process.Id.ToString(CultureInfo.InvariantCulture)]);
        bool ended = process.WaitForExit(TimeSpan.FromSeconds(60));
        if (!ended)
            process.Kill();

        Assert.True(ended);
        Assert.Equal(DemosCommand.Stopped, process.ExitCode);
        JsonElement root = JsonDocument.Parse(System.IO.File.ReadAllBytes(json)).RootElement;
        int done = root.GetProperty("steps").GetInt32();
        Assert.InRange(done, 1, steps - 1);
        Assert.Equal(steps, root.GetProperty("stepsAsked").GetInt32());
        Assert.True(root.GetProperty("ms").GetProperty("mean").GetDouble() > 0);
        Assert.Contains($"{done} of 16.667 ms, stopped before {steps}", process.StandardOutput.ReadToEnd(), StringComparison.Ordinal);
    }

    [Fact]
    public void A_body_that_falls_for_ever_is_lost()
    {
        string json = Path.Combine(folder, "run.json");
        string scene = File("lost.scene", Falling.Replace("1 0 0.5 0 0 0 0 1", "1 9 -49 0 0 0 0 1", StringComparison.Ordinal));

        (int status, string output, _) = Run("run", scene, "--steps", "40", "--json", json);

        Assert.Equal(DemosCommand.Unsound, status);
        Assert.Contains("2: what fell below y = -50 is lost", output, StringComparison.Ordinal);
        Assert.Equal(1, JsonDocument.Parse(System.IO.File.ReadAllBytes(json)).RootElement.GetProperty("lost").GetInt32());
    }

    [Fact]
    public void The_list_names_all_scenes()
    {
        (int status, string output, _) = Run("list");

        Assert.Equal(DemosCommand.Finished, status);
        Assert.All(SceneLibrary.Scenes, scene => Assert.Contains(scene.Name, output, StringComparison.Ordinal));
    }

    static Process Start(params string[] arguments)
    {
        var start = new ProcessStartInfo("dotnet") { RedirectStandardOutput = true };
        start.ArgumentList.Add(typeof(DemosCommand).Assembly.Location);
        foreach (string argument in arguments)
            start.ArgumentList.Add(argument);
        return Process.Start(start)!;
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
