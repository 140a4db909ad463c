using System;
using System.Collections.Generic;
using System.CommandLine;
using System.Globalization;
using System.Linq;
using Benchmarks.Compare;
using Demos.JointTables;
using Demos.Terminal;

namespace Benchmarks.Joints;

/// <summary>
/// Measures what a constraint costs in this engine and in a peer, type by type and at several widths of vectors, in processes that take turns. Only the
/// ratio within neighbouring runs is a result.
/// </summary>
static class JointCommand
{
    /// <summary>Reads the arguments after the word joints, measures, and returns the exit status.</summary>
    public static int Run(string[] arguments)
    {
        var types = new Option<string?>("--types") { Description = "Types such as BallSocket, separated by commas [default: all that both have]." };
        var lanes = new Option<string>("--lanes")
        {
            Description = "Floats in a vector, separated by commas; a width that the machine does not have is left out.",
            DefaultValueFactory = _ => "4,8,16",
        };
        var command = new PeerCommand(
            "Compares what constraints cost with a peer.", "a built scene program", "Pairs of runs.", types, lanes);
        return command.Run(arguments, (parsed, openPeer, runs, csv) =>
        {
            int[] widths = [.. CommaList.Split(parsed.GetRequiredValue(lanes)).Select(Width)];
            var ours = new SceneProgram(typeof(DemosCommand).Assembly.Location);
            List<JointOutcome> outcomes = Measure(ours, openPeer(), CommaList.Split(parsed.GetValue(types)), widths, runs);
            JointReport.Write(Console.Out, outcomes);
            if (csv is not null)
                JointReport.WriteCsv(csv, outcomes);
        });
    }

    static List<JointOutcome> Measure(SceneProgram ours, SceneProgram theirs, string[] types, int[] widths, int runs)
    {
        var outcomes = new Dictionary<(string, int), JointOutcome>();
        foreach (int width in widths)
        {
            for (int run = 0; run < runs; ++run)
            {
                foreach ((JointFigures own, JointFigures other) in MeasureOnce(ours, types, width).Zip(MeasureOnce(theirs, types, width)))
                {
                    // The runtime takes fewer lanes when the machine has no more; such a row would pass for a measurement of what was asked.
                    if (own.Lanes != width || other.Lanes != width)
                        continue;
                    if (!outcomes.TryGetValue((own.Type, width), out JointOutcome? outcome))
                        outcomes.Add((own.Type, width), outcome = new JointOutcome(own.Type, width, []));
                    outcome.Runs.Add((own, other));
                }
                Console.Error.WriteLine(FormattableString.Invariant($"{width} lanes: run {run + 1} of {runs} done"));
            }
        }
        return [.. outcomes.Values];
    }

    static List<JointFigures> MeasureOnce(SceneProgram program, string[] types, int width) =>
    [
        .. program.ReadRows(width, path => [JointTimesCommand.Word, path, .. types]).Select(cells => new JointFigures(
            cells[0], int.Parse(cells[1], CultureInfo.InvariantCulture), Number(cells[2]), Number(cells[3]))),
    ];

    static double Number(string text) => double.Parse(text, CultureInfo.InvariantCulture);

    static int Width(string text) => int.TryParse(text, CultureInfo.InvariantCulture, out int width) && width is 4 or 8 or 16
        ? int.Parse(text, CultureInfo.InvariantCulture)
        : throw new CompareException($"--lanes cannot be '{text}'");
}
