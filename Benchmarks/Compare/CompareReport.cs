using System;
using System.Collections.Generic;
using System.IO;
using System.Text;

namespace Benchmarks.Compare;

/// <summary>Writes outcomes as text for people and as CSV for the Results folder.</summary>
static class CompareReport
{
    /// <summary>Writes the head of the table.</summary>
    public static void WriteHead(TextWriter writer) => writer.WriteLine(
        $"{"scene",-16}{"settings",9}{"threads",8}{"lanes",6}{"ours ms",10}{"peer ms",10}{"peer/ours",11}  spread");

    /// <summary>Writes one outcome: a row, its stages, and what the time bought.</summary>
    public static void Write(TextWriter writer, CompareOutcome outcome)
    {
        writer.Write($"{outcome.SceneName,-16}{outcome.Case.Settings,9}{outcome.Case.Threads,8}{outcome.Lanes,6}");
        writer.Write(FormattableString.Invariant($"{outcome.OurMedian,10:0.000}{outcome.PeerMedian,10:0.000}"));
        writer.WriteLine(FormattableString.Invariant($"{outcome.Ratio,11:0.00}  {outcome.LeastRatio:0.00}..{outcome.GreatestRatio:0.00}"));
        var stages = new StringBuilder();
        for (int i = 0; i < RunFigures.StageNames.Length; ++i)
        {
            (double? ours, double? peer) = outcome.Stage(i);
            if (ours is not null || peer is not null)
                stages.Append(FormattableString.Invariant($"  {RunFigures.StageNames[i]} {Text(ours, "0.000")} : {Text(peer, "0.000")}"));
        }
        if (stages.Length > 0)
            writer.WriteLine($"  stages, ours : peer{stages}");
        RunFigures a = outcome.FirstOfOurs, b = outcome.FirstOfPeer;
        writer.Write($"  quality, ours : peer  penetration mm {Millimetres(a.MaximumPenetration)} : {Millimetres(b.MaximumPenetration)}");
        writer.Write($"  joint rms mm {Millimetres(a.RmsJointError)} : {Millimetres(b.RmsJointError)}");
        writer.WriteLine($"  moved {a.Moved} : {b.Moved}");
        if (!outcome.IsRepeatable)
            writer.WriteLine("  ours ended in different states from the same start");
    }

    /// <summary>Writes that a case was left out because the machine does not have the lanes that it asks for.</summary>
    public static void WriteSkipped(TextWriter writer, CompareCase subject, RunFigures figures) => writer.WriteLine(
        $"{figures.Scene,-16}{subject.Settings,9}{subject.Threads,8}{subject.Lanes,6}  left out: this machine has {figures.Lanes} lanes");

    /// <summary>Writes all outcomes as a CSV file.</summary>
    public static void WriteCsv(string path, IReadOnlyList<CompareOutcome> outcomes)
    {
        var text = new StringBuilder("scene,settings,threads,lanes,runs,ours,oursMs,peer,peerMs,ratio,ratioMin,ratioMax,");
        text.Append("oursPenetration,peerPenetration,oursJointRms,peerJointRms,oursMoved,peerMoved");
        foreach (string stage in RunFigures.StageNames)
            text.Append(FormattableString.Invariant($",ours_{stage},peer_{stage}"));
        text.Append('\n');
        foreach (CompareOutcome outcome in outcomes)
            AppendRow(text, outcome);
        if (Path.GetDirectoryName(Path.GetFullPath(path)) is string folder)
            Directory.CreateDirectory(folder);
        File.WriteAllText(path, text.ToString());
    }

    static void AppendRow(StringBuilder text, CompareOutcome outcome)
    {
        RunFigures a = outcome.FirstOfOurs, b = outcome.FirstOfPeer;
        text.Append(FormattableString.Invariant(
            $"{Quote(outcome.SceneName)},{outcome.Case.Settings},{outcome.Case.Threads},{outcome.Lanes},{outcome.RunCount},"));
        text.Append(FormattableString.Invariant($"{a.Engine},{outcome.OurMedian:0.0000},{b.Engine},{outcome.PeerMedian:0.0000},"));
        text.Append(FormattableString.Invariant($"{outcome.Ratio:0.000},{outcome.LeastRatio:0.000},{outcome.GreatestRatio:0.000},"));
        text.Append(FormattableString.Invariant($"{a.MaximumPenetration:G6},{b.MaximumPenetration:G6},"));
        text.Append(FormattableString.Invariant($"{a.RmsJointError:G6},{b.RmsJointError:G6},{a.Moved},{b.Moved}"));
        for (int i = 0; i < RunFigures.StageNames.Length; ++i)
        {
            (double? ours, double? peer) = outcome.Stage(i);
            text.Append(FormattableString.Invariant($",{ours:0.0000},{peer:0.0000}"));
        }
        text.Append('\n');
    }

    static string Quote(string value) =>
        value.AsSpan().IndexOfAny(',', '"') < 0 ? value : $"\"{value.Replace("\"", "\"\"", StringComparison.Ordinal)}\"";

    static string Millimetres(double? metres) => Text(1000 * metres, "0.00");

    static string Text(double? value, string format) =>
        value is double known ? known.ToString(format, System.Globalization.CultureInfo.InvariantCulture) : "-";
}
