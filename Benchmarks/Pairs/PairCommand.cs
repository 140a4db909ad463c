using System;
using System.Collections.Generic;
using System.CommandLine;
using System.Globalization;
using System.IO;
using System.Linq;
using Benchmarks.Compare;
using Benchmarks.Pairs.Shared;

namespace Benchmarks.Pairs;

/// <summary>
/// Measures what one pair of shapes costs in this engine and in a peer: bit for bit the same shapes and poses, through the collision
/// batcher that both have, in processes that take turns. Only the ratio within neighbouring runs is a result.
/// </summary>
static class PairCommand
{
    /// <summary>Reads the arguments after the word pairs, measures, and returns the exit status.</summary>
    public static int Run(string[] arguments)
    {
        var peer = new Option<string>("--peer")
        {
            Description = "Folder with the peer's BepuPhysics.dll and BepuUtilities.dll, or another build of this program (.dll).",
            Required = true,
        };
        var pairs = List("--pairs", "Pairs such as box-hull14 or hull-hull [default: all].");
        var regimes = List("--regimes", "Of shallow, resting, deep, apart, missed [default: all].");
        var runs = new Option<int>("--runs") { Description = "Runs of each program.", DefaultValueFactory = _ => 5 };
        var csv = new Option<string?>("--csv") { Description = "File to write the results to, usually in Benchmarks/Results." };
        var root = new RootCommand("Compares what a pair of shapes costs with a peer.");
        Option[] options = [peer, pairs, regimes, runs, csv];
        foreach (Option option in options)
            root.Options.Add(option);
        root.SetAction(parsed =>
        {
            string path = Path.GetTempFileName();
            try
            {
                int count = parsed.GetValue(runs);
                if (count < 1)
                    throw new CompareException("--runs has to be at least 1");
                PairFile file = PairPlan.Create(CommaList.Split(parsed.GetValue(pairs)), CommaList.Split(parsed.GetValue(regimes)), Console.Error);
                if (file.Cases.Count == 0)
                    throw new CompareException("there is nothing to measure");
                file.Write(path);
                List<PairOutcome> outcomes = Measure(path, SceneProgram.OpenPeer(parsed.GetRequiredValue(peer)), count);
                PairReport.Write(Console.Out, outcomes);
                if (parsed.GetValue(csv) is string csvPath)
                    PairReport.WriteCsv(csvPath, outcomes);
                return 0;
            }
            catch (Exception error) when (error is CompareException or IOException or UnauthorizedAccessException)
            {
                Console.Error.WriteLine($"error: {error.Message}");
                return 1;
            }
            finally
            {
                File.Delete(path);
            }
        });
        return root.Parse(arguments).Invoke();
    }

    static List<PairOutcome> Measure(string casePath, SceneProgram peer, int runs)
    {
        var ours = new SceneProgram(typeof(PairCommand).Assembly.Location);
        var outcomes = new Dictionary<PairRow, PairOutcome>();
        for (int run = 0; run < runs; ++run)
        {
            Dictionary<PairRow, PairFigures> ourFigures = MeasureOnce(ours, casePath), peerFigures = MeasureOnce(peer, casePath);
            foreach ((PairRow row, PairFigures figures) in ourFigures)
            {
                if (row.Fill == PairTimesCommand.InStep)
                    continue;
                if (!outcomes.TryGetValue(row, out PairOutcome? outcome))
                    outcomes.Add(row, outcome = new PairOutcome(row, [], []));
                outcome.Runs.Add((figures, peerFigures[row]));
            }
            foreach ((PairRow row, PairFigures figures) in ourFigures)
            {
                // Beside the row of whole batches, which is the last of its case.
                if (row.Fill == PairTimesCommand.InStep)
                    outcomes.Values.Last(outcome => outcome.Case.Pair == row.Pair && outcome.Case.Regime == row.Regime).InStep.Add(figures.Time);
            }
            Console.Error.WriteLine($"run {run + 1} of {runs} done");
        }
        return [.. outcomes.Values];
    }

    static Dictionary<PairRow, PairFigures> MeasureOnce(SceneProgram program, string casePath)
    {
        string path = Path.GetTempFileName();
        try
        {
            program.Do(PairTimesCommand.Word, casePath, path);
            var figures = new Dictionary<PairRow, PairFigures>();
            foreach (string line in File.ReadLines(path))
            {
                string[] parts = line.Split(',');
                figures.Add(new PairRow(parts[0], parts[1], int.Parse(parts[2], CultureInfo.InvariantCulture)),
                    new PairFigures(double.Parse(parts[3], CultureInfo.InvariantCulture), double.Parse(parts[4], CultureInfo.InvariantCulture)));
            }
            return figures;
        }
        finally
        {
            File.Delete(path);
        }
    }

    static Option<string?> List(string name, string description) => new(name) { Description = $"{description} Separated by commas." };
}
