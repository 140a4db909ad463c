using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Text.Json;
using Demos.Terminal;
using Demos.Trade;
using Xunit;

namespace DemoTests.Runner;

public sealed class TradeCommandTests : IDisposable
{
    readonly string folder = Directory.CreateTempSubdirectory("trade").FullName;

    public void Dispose() => Directory.Delete(folder, true);

    [Theory]
    [InlineData("no scene 'hut'", "trade", "hut")]
    [InlineData("--substeps cannot be '0'", "trade", "heavy", "--substeps", "4,0")]
    [InlineData("--substeps cannot be 'four'", "trade", "heavy", "--substeps", "four")]
    [InlineData("--iterations cannot be '-1'", "trade", "heavy", "--iterations", "-1")]
    [InlineData("--relaxations cannot be '9999'", "trade", "heavy", "--relaxations", "9999")]
    [InlineData("--spring cannot be '-30'", "trade", "heavy", "--spring", "-30")]
    [InlineData("--mode cannot be 'upside-down'", "trade", "top", "--mode", "upside-down")]
    [InlineData("--mode is empty", "trade", "top", "--mode", ",")]
    [InlineData("--runs cannot be 0", "trade", "heavy", "--runs", "0")]
    [InlineData("no BepuPhysics.dll", "trade", "heavy", "--peer", "no-such-folder")]
    public void What_cannot_be_is_refused_with_a_message(string message, params string[] arguments)
    {
        (int status, string output, string error) = Run(arguments);

        Assert.Equal(DemosCommand.BadInput, status);
        Assert.Contains(message, error, StringComparison.Ordinal);
        Assert.Empty(output);
    }

    [Fact]
    public void A_small_sweep_ends_with_its_rows_and_errors_that_fall_with_substeps()
    {
        (int status, string output, string error) = Run("trade", "steps", "--substeps", "2,4,8", "--iterations", "1", "--mode", "default",
            "--load-path", "off", "--runs", "1",
            "--output", folder, "--all");

        Assert.Equal(DemosCommand.Finished, status);
        Assert.Contains("steps: 0 of 6 runs", error, StringComparison.Ordinal);
        Assert.Equal(6, output.Split('\n').Count(line => line.StartsWith("tootbird", StringComparison.Ordinal)));
        JsonElement root = JsonDocument.Parse(File.ReadAllBytes(Path.Combine(folder, "steps.json"))).RootElement;
        Assert.Equal(["scene", "summary", "error", "unit", "complete", "points", "ratios"], root.EnumerateObject().Select(member => member.Name));
        Assert.True(root.GetProperty("complete").GetBoolean());
        JsonElement[] points = [.. root.GetProperty("points").EnumerateArray()];
        Assert.Equal(6, points.Length);
        Assert.Equal(["engine", "setting", "dials", "error", "ms", "msMin", "msMax", "runs", "front"],
            points[0].EnumerateObject().Select(member => member.Name));
        Assert.All(points, point => Assert.True(point.GetProperty("ms").GetDouble() > 0));
        // Rigid contacts sink by the square of the substep's length, and by half as much with a relaxation.
        double[] errors = [.. points.OrderBy(point => point.GetProperty("setting").GetString(), StringComparer.Ordinal)
            .Select(point => point.GetProperty("error").GetDouble())];
        Assert.True(errors[0] > 2 * errors[2] && errors[2] > 2 * errors[4], string.Join(", ", errors));
        Assert.True(errors[1] > errors[3] && errors[3] > errors[5], string.Join(", ", errors));
        Assert.Contains("<svg", File.ReadAllText(Path.Combine(folder, "steps.svg")), StringComparison.Ordinal);
        Assert.Contains("| engine | setting |", File.ReadAllText(Path.Combine(folder, "steps.md")), StringComparison.Ordinal);
    }

    [Fact]
    public void A_worker_greets_measures_and_says_what_is_wrong()
    {
        string question = JsonSerializer.Serialize(
            new TradeRequest("heavy", new Dictionary<string, string> { ["substeps"] = "2" }, 3), TradeLineJson.Default.TradeRequest);
        using var output = new StringWriter();

        TradeWorker.Run(new StringReader($"{question}\n{question.Replace("heavy", "hut", StringComparison.Ordinal)}\nnonsense\n"), output, default);

        string[] lines = output.ToString().Split('\n', StringSplitOptions.RemoveEmptyEntries);
        Assert.Equal(4, lines.Length);
        TradeGreeting greeting = JsonSerializer.Deserialize(lines[0], TradeLineJson.Default.TradeGreeting)!;
        Assert.Equal("tootbird", greeting.Engine);
        Assert.Equal(TradeScene.All.Count, greeting.Values.Count);
        TradeAnswer[] answers = [.. lines[1..].Select(line => JsonSerializer.Deserialize(line, TradeLineJson.Default.TradeAnswer)!)];
        Assert.Equal(3, answers[0].Measurement!.Milliseconds.Length);
        Assert.Contains("'hut'", answers[1].Problem, StringComparison.Ordinal);
        Assert.NotNull(answers[2].Problem);
    }

    [Fact]
    public void Every_scene_runs()
    {
        foreach (TradeScene scene in TradeScene.All)
        {
            TradeMeasurement measurement = TradeMeasurement.Take(scene, TradeAxis.Settings(new Dictionary<string, string>()), default, 3)!;
            Assert.Equal(3, measurement.Milliseconds.Length);
        }
    }

    [Fact]
    public void A_plot_shows_what_is_on_it()
    {
        TradeScene scene = TradeScene.Find("heavy");
        var points = new List<TradePoint>();
        foreach ((string substeps, double? error) in new[] { ("1", .5), ("2", (double?).25), ("4", null) })
        {
            points.Add(new TradePoint("<engine>", new Dictionary<string, string> { ["substeps"] = substeps }));
            points[^1].Add(new TradeMeasurement(error, [points.Count]));
        }

        string svg = new TradePlot(scene, [("<engine>", points, TradeFront.Of(points))]).ToSvg();

        var root = System.Xml.Linq.XDocument.Parse(svg).Root!;
        Assert.Equal(2, root.Elements().Count(element => element.Name.LocalName == "circle"));
        Assert.Single(root.Elements(), element => element.Name.LocalName == "polyline");
        string[] texts = [.. root.Elements().Where(element => element.Name.LocalName == "text").Select(element => element.Value)];
        Assert.Contains("s1", texts);
        Assert.Contains("s2", texts);
        Assert.Contains("● <engine>", texts);
    }

    static (int Status, string Output, string Error) Run(params string[] arguments)
    {
        using var output = new StringWriter();
        using var error = new StringWriter();
        int status = DemosCommand.Run(arguments, output, error);
        return (status, output.ToString(), error.ToString());
    }
}
