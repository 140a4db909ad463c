using System;
using System.Collections.Generic;
using System.CommandLine;
using System.Diagnostics;
using System.Globalization;
using System.IO;
using System.Linq;
using Demos.Scenes;
using Demos.Scenes.BuiltIn;
using Demos.Terminal;

namespace Demos.Stages;

/// <summary>The command that shows what of a scene's steps runs on one thread only, and what more threads can make of the rest.</summary>
static class StageCommand
{
    const int DefaultSkipped = 30;

    public static Command Create(Func<ParseResult, Func<int>, int> guard)
    {
        var scene = new Argument<string>("scene") { Description = "Name of a scene, or a file.", DefaultValueFactory = _ => SceneLibrary.DefaultScene };
        var steps = new Option<int?>("--steps") { Description = "Steps to run; the scene's without." };
        var warmup = new Option<int?>("--warmup") { Description = "First steps that are not measured [default: 30, at most half of the steps]." };
        var seed = new Option<int>("--seed") { Description = "Seed of scenes by lot.", DefaultValueFactory = _ => 1 };
        var replace = new Option<int?>("--replace")
        {
            Description = "Bodies that are removed in each step, in turn, and added where they began [default: 10 for 'rain', else 0].",
        };
        var repeat = new Option<int>("--repeat")
        {
            Description = "Runs, of which each stage of each step takes the least time: for machines that do other things too.",
            DefaultValueFactory = _ => 1,
        };
        var command = new Command("stages", "Shows what of a scene's steps can be shared among threads.") { scene, steps, warmup, seed, replace, repeat };
        command.SetAction(parsed => guard(parsed, () =>
        {
            SceneDescription description = SceneLibrary.Load(parsed.GetValue(scene)!, parsed.GetValue(seed));
            int count = parsed.GetValue(steps) ?? description.Steps;
            int skipped = parsed.GetValue(warmup) ?? Math.Min(DefaultSkipped, count / 2);
            if (skipped < 0 || count <= skipped)
                throw new SceneException($"a warm-up of {skipped} steps leaves none of {count} to measure");
            int replaced = parsed.GetValue(replace) ?? (description.Name == Rain.Scene.Name ? Rain.DropsPerStep : 0);
            using var run = new StageRun(description, replaced);
            run.Step(count, skipped);
            for (int i = 1; i < parsed.GetValue(repeat); ++i)
            {
                using var again = new StageRun(description, replaced);
                again.Step(count, skipped);
                run.Times.TakeLeast(again.Times);
            }
            Report(parsed.InvocationConfiguration.Output, run);
            return 0;
        }));
        return command;
    }

    static void Report(TextWriter output, StageRun run)
    {
        var table = new TextTable("stage", ">ms", ">serial", ">of it lone", ">serial %", ">of step %", ">stages", ">x 2", ">x 4", ">x 8", ">x 16");
        var all = new StageShare("step");
        StageShare[] shares = run.Shares;
        foreach (StageShare share in shares)
            all.Add(share);
        int steps = run.Times.Milliseconds.Count;
        foreach (StageShare share in shares.Append(all))
        {
            List<string> cells =
            [
                share.Name, Milliseconds(share.Total, steps), Milliseconds(share.Serial, steps), Milliseconds(share.Lone, steps),
                Percent(share.Serial, share.Total), Percent(share.Serial, all.Total), Text((double)share.StageCount / steps, "0.#"),
            ];
            for (int i = 0; i < StageShare.ThreadCounts.Length; ++i)
                cells.Add(Text(share.SpeedUp(i), "0.00"));
            table.Add(cells.ToArray());
        }
        table.Write(output);
        double[] sorted = [.. run.Times.Milliseconds.Order()];
        output.WriteLine(FormattableString.Invariant(
            $"steps: mean {sorted.Average():0.000} ms, p99 {sorted[(int)Math.Ceiling(.99 * steps) - 1]:0.000} ms, worst {sorted[^1]:0.000} ms"));
        output.WriteLine($"hash {run.Hash():x16}");
    }

    static string Milliseconds(double ticks, int steps) => Text(ticks * 1000 / Stopwatch.Frequency / steps, "0.000");

    static string Percent(double part, double whole) => whole > 0 ? Text(100 * part / whole, "0.0") : "";

    static string Text(double value, string format) => value.ToString(format, CultureInfo.InvariantCulture);
}
