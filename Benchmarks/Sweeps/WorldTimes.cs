using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using Benchmarks.Compare;

namespace Benchmarks.Sweeps;

/// <summary>
/// Measures questions to a world in this engine and in a peer: bit for bit the same worlds and questions, in processes that take turns. Only
/// the ratio within neighbouring runs is a result.
/// </summary>
/// <param name="subject">What is measured.</param>
/// <param name="word">Word on the command line of both programs; then the file that they write rows to: three names, nanoseconds, answers.</param>
/// <param name="headings">What the three names are.</param>
sealed class WorldTimes(string subject, string word, params string[] headings)
{
    /// <summary>Reads the arguments after the word of the command, measures, and returns the exit status.</summary>
    public int Run(string[] arguments)
    {
        var command = new PeerCommand($"Compares what {subject} costs with a peer.", "another build of this program", "Runs of each program.");
        return command.Run(arguments, (_, openPeer, runs, csv) =>
        {
            List<SweepOutcome> outcomes = Measure(openPeer(), runs);
            var report = new SweepReport(outcomes, headings);
            report.Write(Console.Out);
            if (csv is not null)
                report.WriteCsv(csv);
        });
    }

    List<SweepOutcome> Measure(SceneProgram peer, int runs)
    {
        var ours = new SceneProgram(typeof(WorldTimes).Assembly.Location);
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

    List<SweepFigures> MeasureOnce(SceneProgram program) =>
    [
        .. program.ReadRows(lanes: null, path => [word, path]).Select(cells => new SweepFigures(
            $"{cells[0]}, {cells[1]}, {cells[2]}", Number(cells[3]), Number(cells[4]))),
    ];

    static double Number(string text) => double.Parse(text, CultureInfo.InvariantCulture);
}
