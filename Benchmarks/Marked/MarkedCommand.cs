using System;
using System.Collections.Generic;
using System.CommandLine;
using System.Diagnostics;
using System.Globalization;
using System.Linq;
using Benchmarks.Compare;
using Demos.Terminal;

namespace Benchmarks.Marked;

/// <summary>Measures what it costs to mark all bodies as continuous: steps of the same world with marks and without take turns.</summary>
static class MarkedCommand
{
    /// <summary>Reads the arguments after the word marked, measures, and returns the exit status.</summary>
    public static int Run(string[] arguments)
    {
        var scenes = new Option<string>("--scenes") { Description = "Among room, posts and heap.", DefaultValueFactory = _ => "room,posts,heap" };
        var counts = new Option<string>("--counts") { Description = "Numbers of balls.", DefaultValueFactory = _ => "1000,5000,10000" };
        var threads = new Option<string>("--threads") { Description = "Numbers of threads.", DefaultValueFactory = _ => "1,2" };
        var skipped = new Option<int>("--skip") { Description = "First steps that are not measured.", DefaultValueFactory = _ => 12 };
        var steps = new Option<int>("--steps") { Description = "Steps that are measured.", DefaultValueFactory = _ => 24 };
        var only = new Option<string?>("--only") { Description = "marked or discrete: the other one is left out, for a profile of this one." };
        var root = new RootCommand("Measures what it costs to mark bodies as continuous.") { scenes, counts, threads, skipped, steps, only };
        root.SetAction(parsed =>
        {
            var table = new TextTable("scene", ">balls", ">threads", ">discrete ms", ">marked ms", ">marked/discrete", "hash of the marked");
            foreach (string scene in CommaList.Split(parsed.GetValue(scenes)))
            {
                foreach (string count in CommaList.Split(parsed.GetValue(counts)))
                {
                    foreach (string thread in CommaList.Split(parsed.GetValue(threads)))
                        table.Add([scene, count, thread, .. Measure(Enum.Parse<MarkedScene>(scene, true), Number(count), Number(thread),
                            parsed.GetValue(skipped), parsed.GetValue(steps), parsed.GetValue(only))]);
                }
            }
            table.Write(Console.Out);
            return 0;
        });
        return root.Parse(arguments).Invoke();
    }

    static string[] Measure(MarkedScene scene, int count, int threads, int skipped, int steps, string? only)
    {
        using var discrete = new MarkedWorld(scene, count, isMarked: false, threads);
        using var marked = new MarkedWorld(scene, count, isMarked: true, threads);
        var times = (Discrete: new List<double>(), Marked: new List<double>());
        for (int i = 0; i < skipped + steps; ++i)
        {
            if (only != "marked")
                times.Discrete.Add(Time(discrete));
            if (only != "discrete")
                times.Marked.Add(Time(marked));
        }
        var (without, with) = (Median(times.Discrete.Skip(skipped)), Median(times.Marked.Skip(skipped)));
        return [Text(without), Text(with), Text(with / without), $"{marked.Simulation.StateHash():x16}"];
    }

    static double Time(MarkedWorld world)
    {
        var start = Stopwatch.GetTimestamp();
        world.Step();
        return Stopwatch.GetElapsedTime(start).TotalMilliseconds;
    }

    static double Median(IEnumerable<double> times)
    {
        double[] sorted = [.. times.Order()];
        return sorted.Length > 0 ? sorted[sorted.Length / 2] : double.NaN;
    }

    static string Text(double value) => value.ToString("0.00", CultureInfo.InvariantCulture);

    static int Number(string text) => int.Parse(text, CultureInfo.InvariantCulture);
}
