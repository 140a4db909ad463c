using System;
using System.Collections.Generic;
using System.CommandLine;
using System.Globalization;
using System.IO;
using Demos.Running;

namespace Benchmarks.Compare;

/// <summary>
/// Runs the same scenes with this engine and a peer, in turn, so that whatever else the machine does falls on both. Only the ratio
/// within a pair of neighbouring runs is a result; milliseconds belong to the machine and the hour.
/// </summary>
static class CompareCommand
{
    /// <summary>Reads the arguments after the word compare, measures, and returns the exit status.</summary>
    public static int Run(string[] arguments)
    {
        var ours = new Option<string?>("--ours")
        {
            Description = "Scene program (.dll) to take for ours [default: Demos as built with this program].",
        };
        var scenes = List("--scenes", "Built-in scenes or scene files.", "pyramids,great-pyramid,cloth-lattice");
        var threads = List("--threads", "Thread counts.", "1,2");
        var settings = List("--settings", "Iterations x substeps.", "1x4,8x1");
        var lanes = List("--lanes", "Floats in a vector: 4, 8, 16; empty for the machine's own.", "");
        var frames = new Option<int?>("--frames") { Description = "Steps of each run [default: as the scene says]." };
        var warmup = new Option<int?>("--warmup") { Description = "First steps that are not measured." };
        var sleep = new Option<bool?>("--sleep") { Description = "Whether bodies may fall asleep [default: as the scene says]." };
        var command = new PeerCommand("Compares this engine with a peer, scene by scene.", "a built scene program", "Pairs of runs of each case.",
            ours, scenes, threads, settings, lanes, frames, warmup, sleep);
        return command.Run(arguments, (parsed, openPeer, runs, csv) =>
        {
            List<CompareCase> cases = Plan(parsed.GetRequiredValue(scenes), parsed.GetRequiredValue(threads),
                parsed.GetRequiredValue(settings), parsed.GetRequiredValue(lanes));
            var ourProgram = new SceneProgram(parsed.GetValue(ours) ?? Path.Combine(AppContext.BaseDirectory, "Demos.dll"));
            List<CompareOutcome> outcomes = Measure(
                cases, ourProgram, openPeer(), runs, parsed.GetValue(frames), parsed.GetValue(warmup), parsed.GetValue(sleep));
            CompareReport.Write(Console.Out, outcomes);
            if (csv is not null)
                CompareReport.WriteCsv(csv, outcomes);
        });
    }

    static List<CompareOutcome> Measure(List<CompareCase> cases, SceneProgram ours, SceneProgram peer, int runs, int? frames, int? warmup,
        bool? sleep)
    {
        var outcomes = new List<CompareOutcome>();
        foreach (CompareCase subject in cases)
        {
            List<string> arguments = subject.Arguments(frames, warmup, sleep);
            var pairs = new List<(RunJson, RunJson)>();
            while (pairs.Count < runs)
            {
                RunJson figures = ours.Run(arguments, subject.Lanes);
                // The runtime takes fewer lanes when the machine has no more; such a row would pass for a measurement of what was asked.
                if (subject.Lanes is int asked && figures.Lanes != asked)
                {
                    CompareReport.WriteSkipped(Console.Error, subject, figures);
                    break;
                }
                pairs.Add((figures, peer.Run(arguments, subject.Lanes)));
            }
            if (pairs.Count < runs)
                continue;
            var outcome = new CompareOutcome(subject, pairs);
            outcomes.Add(outcome);
            Console.Error.WriteLine(FormattableString.Invariant(
                $"{outcome.SceneName} {subject.Settings}, {subject.Threads} threads: peer/ours {outcome.Ratio:0.00}"));
        }
        return outcomes;
    }

    static List<CompareCase> Plan(string scenes, string threads, string settings, string lanes)
    {
        var cases = new List<CompareCase>();
        foreach (string scene in CommaList.Split(scenes))
        {
            foreach (string setting in CommaList.Split(settings))
            {
                string[] parts = setting.Split('x');
                if (parts.Length != 2)
                    throw new CompareException($"'{setting}' in --settings is not ITERATIONSxSUBSTEPS");
                (int iterations, int substeps) = (Number(parts[0], "--settings"), Number(parts[1], "--settings"));
                foreach (string thread in CommaList.Split(threads))
                {
                    int threadCount = Number(thread, "--threads");
                    if (lanes.Length == 0)
                        cases.Add(new CompareCase(scene, iterations, substeps, threadCount, null));
                    foreach (string lane in CommaList.Split(lanes))
                        cases.Add(new CompareCase(scene, iterations, substeps, threadCount, Number(lane, "--lanes")));
                }
            }
        }
        return cases;
    }

    static int Number(string text, string option) =>
        int.TryParse(text, NumberStyles.None, CultureInfo.InvariantCulture, out int value) && value > 0
            ? value
            : throw new CompareException($"'{text}' in {option} is not a whole number above zero");

    static Option<string> List(string name, string description, string defaultValue) =>
        new(name) { Description = $"{description} Separated by commas.", DefaultValueFactory = _ => defaultValue };
}
