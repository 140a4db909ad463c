using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
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
        var command = new PeerCommand("Compares what a sweep costs with a peer.", "another build of this program", "Runs of each program.");
        return command.Run(arguments, (_, openPeer, runs, csv) =>
        {
            List<SweepOutcome> outcomes = Measure(openPeer(), runs);
            SweepReport.Write(Console.Out, outcomes);
            if (csv is not null)
                SweepReport.WriteCsv(csv, outcomes);
        });
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

    static List<SweepFigures> MeasureOnce(SceneProgram program) =>
    [
        .. program.ReadRows(lanes: null, path => [SweepTimesCommand.Word, path]).Select(cells => new SweepFigures(
            $"{cells[0]}, {cells[1]}, {cells[2]}", Number(cells[3]), Number(cells[4]))),
    ];

    static double Number(string text) => double.Parse(text, CultureInfo.InvariantCulture);
}
