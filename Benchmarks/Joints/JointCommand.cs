using System;
using System.Collections.Generic;
using System.CommandLine;
using System.Globalization;
using System.IO;
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
        var peer = new Option<string>("--peer")
        {
            Description = "Folder with the peer's BepuPhysics.dll and BepuUtilities.dll, or a built scene program (.dll).",
            Required = true,
        };
        var types = new Option<string?>("--types") { Description = "Types such as BallSocket, separated by commas [default: all that both have]." };
        var lanes = new Option<string>("--lanes")
        {
            Description = "Floats in a vector, separated by commas; a width that the machine does not have is left out.",
            DefaultValueFactory = _ => "4,8,16",
        };
        var runs = new Option<int>("--runs") { Description = "Pairs of runs.", DefaultValueFactory = _ => 5 };
        var csv = new Option<string?>("--csv") { Description = "File to write the results to, usually in Benchmarks/Results." };
        var root = new RootCommand("Compares what constraints cost with a peer.");
        Option[] options = [peer, types, lanes, runs, csv];
        foreach (Option option in options)
            root.Options.Add(option);
        root.SetAction(parsed =>
        {
            try
            {
                int count = parsed.GetValue(runs);
                if (count < 1)
                    throw new CompareException("--runs has to be at least 1");
                int[] widths = [.. CommaList.Split(parsed.GetRequiredValue(lanes)).Select(Width)];
                var ours = new SceneProgram(typeof(DemosCommand).Assembly.Location);
                SceneProgram theirs = SceneProgram.OpenPeer(parsed.GetRequiredValue(peer));
                List<JointOutcome> outcomes = Measure(ours, theirs, CommaList.Split(parsed.GetValue(types)), widths, count);
                JointReport.Write(Console.Out, outcomes);
                if (parsed.GetValue(csv) is string path)
                    JointReport.WriteCsv(path, outcomes);
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

    static List<JointFigures> MeasureOnce(SceneProgram program, string[] types, int width)
    {
        string path = Path.GetTempFileName();
        try
        {
            program.Do(width, [JointTimesCommand.Word, path, .. types]);
            return [.. File.ReadLines(path).Select(line => line.Split(',')).Select(parts =>
                new JointFigures(parts[0], int.Parse(parts[1], CultureInfo.InvariantCulture), Number(parts[2]), Number(parts[3])))];
        }
        finally
        {
            File.Delete(path);
        }
    }

    static double Number(string text) => double.Parse(text, CultureInfo.InvariantCulture);

    static int Width(string text) => int.TryParse(text, CultureInfo.InvariantCulture, out int width) && width is 4 or 8 or 16
        ? int.Parse(text, CultureInfo.InvariantCulture)
        : throw new CompareException($"--lanes cannot be '{text}'");
}
