using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Linq;
using Demos.Running;
using Demos.Terminal;

namespace Benchmarks.Compare;

/// <summary>Writes outcomes as tables for people and as CSV for the Results folder.</summary>
static class CompareReport
{
    /// <summary>Writes what was measured, where the time goes, and what it bought.</summary>
    public static void Write(TextWriter writer, IReadOnlyList<CompareOutcome> outcomes)
    {
        if (outcomes.Count == 0)
            return;
        var table = new TextTable("scene", ">settings", ">threads", ">lanes", ">ours ms", ">peer ms", ">peer/ours", "spread", ">penetration mm",
            ">joint rms mm", ">moved");
        foreach (CompareOutcome outcome in outcomes)
        {
            (RunJson a, RunJson b) = (outcome.FirstOfOurs, outcome.FirstOfPeer);
            table.Add([.. Head(outcome), Text(outcome.OurMedian, "0.000"), Text(outcome.PeerMedian, "0.000"), Text(outcome.Ratio, "0.00"),
                FormattableString.Invariant($"{outcome.LeastRatio:0.00}..{outcome.GreatestRatio:0.00}"),
                Both(1000 * a.MaxPenetration, 1000 * b.MaxPenetration, "0.00"), Both(1000 * a.RmsJointError, 1000 * b.RmsJointError, "0.00"),
                $"{a.Moved} : {b.Moved}"]);
        }
        table.Write(writer, "times of a step, and what they bought, ours : peer");
        writer.WriteLine();
        WriteStages(writer, outcomes);
        foreach (CompareOutcome outcome in outcomes.Where(outcome => !outcome.IsRepeatable))
            writer.WriteLine($"{string.Join(' ', Head(outcome))}: ours ended in different states from the same start");
    }

    /// <summary>Writes that a case was left out because the machine does not have the lanes that it asks for.</summary>
    public static void WriteSkipped(TextWriter writer, CompareCase subject, RunJson figures) => writer.WriteLine(
        $"{figures.Scene} {subject.Settings} {subject.Threads} {subject.Lanes}: left out, this machine has {figures.Lanes} lanes");

    /// <summary>Writes all outcomes as a CSV file.</summary>
    public static void WriteCsv(string path, IReadOnlyList<CompareOutcome> outcomes)
    {
        string[] stages = [.. RunFigures.StageNames.SelectMany(stage => new[] { $"ours_{stage}", $"peer_{stage}" })];
        var table = new TextTable(["scene", "settings", "threads", "lanes", "runs", "ours", "oursMs", "peer", "peerMs", "ratio", "ratioMin", "ratioMax",
            "oursPenetration", "peerPenetration", "oursJointRms", "peerJointRms", "oursMoved", "peerMoved", .. stages]);
        foreach (CompareOutcome outcome in outcomes)
        {
            (RunJson a, RunJson b) = (outcome.FirstOfOurs, outcome.FirstOfPeer);
            List<string> cells = [.. Head(outcome), Whole(outcome.RunCount), a.Engine, Cell(outcome.OurMedian, "0.0000"), b.Engine,
                Cell(outcome.PeerMedian, "0.0000"), Cell(outcome.Ratio, "0.000"), Cell(outcome.LeastRatio, "0.000"), Cell(outcome.GreatestRatio, "0.000"),
                Cell(a.MaxPenetration, "G6"), Cell(b.MaxPenetration, "G6"), Cell(a.RmsJointError, "G6"), Cell(b.RmsJointError, "G6"),
                Whole(a.Moved), Whole(b.Moved)];
            for (int i = 0; i < RunFigures.StageNames.Length; ++i)
            {
                (double? ours, double? peer) = outcome.Stage(i);
                cells.AddRange([Cell(ours, "0.0000"), Cell(peer, "0.0000")]);
            }
            table.Add([.. cells]);
        }
        table.WriteCsv(path);
    }

    static void WriteStages(TextWriter writer, IReadOnlyList<CompareOutcome> outcomes)
    {
        int[] told = [.. Enumerable.Range(0, RunFigures.StageNames.Length).Where(stage => outcomes.Any(outcome => outcome.Stage(stage) != (null, null)))];
        var table = new TextTable(["scene", ">settings", ">threads", ">lanes", .. told.Select(stage => $">{RunFigures.StageNames[stage]}")]);
        foreach (CompareOutcome outcome in outcomes)
        {
            table.Add([.. Head(outcome), .. told.Select(stage =>
            {
                (double? ours, double? peer) = outcome.Stage(stage);
                return Both(ours, peer, "0.000");
            })]);
        }
        table.Write(writer, "milliseconds of the stages, ours : peer");
    }

    static string[] Head(CompareOutcome outcome) => [outcome.SceneName, outcome.Case.Settings, Whole(outcome.Case.Threads), Whole(outcome.Lanes)];

    static string Both(double? ours, double? peer, string format) => $"{Text(ours, format)} : {Text(peer, format)}";

    static string Text(double? value, string format) => value is double known ? Cell(known, format) : "-";

    static string Cell(double? value, string format) => value?.ToString(format, CultureInfo.InvariantCulture) ?? "";

    static string Whole(int value) => value.ToString(CultureInfo.InvariantCulture);
}
