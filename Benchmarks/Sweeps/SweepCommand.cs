using System;
using System.Collections.Generic;
using System.CommandLine;
using System.Globalization;
using System.IO;
using Benchmarks.Compare;
using Benchmarks.Sweeps.Shared;

namespace Benchmarks.Sweeps;

/// <summary>
/// Measures what sweeping a shape through a world of statics costs in this engine and in a peer: bit for bit the same worlds and sweeps,
/// in processes that take turns. Only the ratio within neighbouring runs is a result.
/// </summary>
static class SweepCommand
{
    /// <summary>Reads the arguments after the word sweeps, measures, and returns the exit status.</summary>
    public static int Run(string[] arguments)
    {
        var peer = new Option<string>("--peer")
        {
            Description = "Folder with the peer's BepuPhysics.dll and BepuUtilities.dll, or another build of this program (.dll).",
            Required = true,
        };
        var runs = new Option<int>("--runs") { Description = "Runs of each program.", DefaultValueFactory = _ => 5 };
        var csv = new Option<string?>("--csv") { Description = "File to write the results to, usually in Benchmarks/Results." };
        var root = new RootCommand("Compares what a sweep costs with a peer.");
        root.Options.Add(peer);
        root.Options.Add(runs);
        root.Options.Add(csv);
        root.SetAction(parsed =>
        {
            try
            {
                int count = parsed.GetValue(runs);
                if (count < 1)
                    throw new CompareException("--runs has to be at least 1");
                List<SweepOutcome> outcomes = Measure(SceneProgram.OpenPeer(parsed.GetRequiredValue(peer)), count);
                SweepReport.Write(Console.Out, outcomes);
                if (parsed.GetValue(csv) is string path)
                    SweepReport.WriteCsv(path, outcomes);
                return 0;
            }
            catch (Exception error) when (error is CompareException or IOException or UnauthorizedAccessException)
            {
                Console.Error.WriteLine($"error: {error.Message}");
                return 1;
            }
        });
        return root.Parse(arguments).Invoke();
    }

    static List<SweepOutcome> Measure(SceneProgram peer, int runs)
    {
        var ours = new SceneProgram(typeof(SweepCommand).Assembly.Location);
        var outcomes = new List<SweepOutcome>();
        for (int run = 0; run < runs; ++run)
        {
            List<SweepFigures> ourFigures = MeasureOnce(ours), peerFigures = MeasureOnce(peer);
            for (int i = 0; i < ourFigures.Count; ++i)
            {
                if (run == 0)
                    outcomes.Add(new SweepOutcome(ourFigures[i].Name, []));
                outcomes[i].Runs.Add((ourFigures[i], peerFigures[i]));
            }
            Console.Error.WriteLine($"run {run + 1} of {runs} done");
        }
        return outcomes;
    }

    static List<SweepFigures> MeasureOnce(SceneProgram program)
    {
        string path = Path.GetTempFileName();
        try
        {
            program.Do(SweepTimesCommand.Word, path);
            var figures = new List<SweepFigures>();
            foreach (string line in File.ReadLines(path))
            {
                string[] parts = line.Split(',');
                figures.Add(new SweepFigures($"{parts[0]}, {parts[1]}, {parts[2]}", double.Parse(parts[3], CultureInfo.InvariantCulture),
                    double.Parse(parts[4], CultureInfo.InvariantCulture)));
            }
            return figures;
        }
        finally
        {
            File.Delete(path);
        }
    }
}
