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
        var pairs = List("--pairs", "Pairs such as box-hull14 or hull-hull [default: all].");
        var regimes = List("--regimes", "Of shallow, resting, deep, apart, missed [default: all].");
        var command = new PeerCommand(
            "Compares what a pair of shapes costs with a peer.", "another build of this program", "Runs of each program.", pairs, regimes);
        return command.Run(arguments, (parsed, openPeer, runs, csv) =>
        {
            PairFile file = PairPlan.Create(CommaList.Split(parsed.GetValue(pairs)), CommaList.Split(parsed.GetValue(regimes)), Console.Error);
            if (file.Cases.Count == 0)
                throw new CompareException("there is nothing to measure");
            string path = Path.GetTempFileName();
            try
            {
                file.Write(path);
                List<PairOutcome> outcomes = Measure(path, openPeer(), runs);
                PairReport.Write(Console.Out, outcomes);
                if (csv is not null)
                    PairReport.WriteCsv(csv, outcomes);
            }
            finally
            {
                File.Delete(path);
            }
        });
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

    static Dictionary<PairRow, PairFigures> MeasureOnce(SceneProgram program, string casePath) =>
        program.ReadRows(lanes: null, path => [PairTimesCommand.Word, casePath, path]).ToDictionary(
            cells => new PairRow(cells[0], cells[1], int.Parse(cells[2], CultureInfo.InvariantCulture)),
            cells => new PairFigures(double.Parse(cells[3], CultureInfo.InvariantCulture), double.Parse(cells[4], CultureInfo.InvariantCulture)));

    static Option<string?> List(string name, string description) => new(name) { Description = $"{description} Separated by commas." };
}
