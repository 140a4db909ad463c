using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Linq;
using Demos.Terminal;

namespace Benchmarks.Pairs;

/// <summary>Writes outcomes as a table for people and as CSV for the Results folder.</summary>
static class PairReport
{
    /// <summary>Writes the table, and for each fill the geometric mean of its ratios.</summary>
    public static void Write(TextWriter writer, IReadOnlyList<PairOutcome> outcomes)
    {
        var table = new TextTable("pair", "regime", ">fill", ">ours ns", ">peer ns", ">peer/ours", "spread", ">contacts", ">step ns");
        foreach (PairOutcome outcome in outcomes)
        {
            PairRow row = outcome.Case;
            (PairFigures ours, PairFigures peer) = outcome.Runs[0];
            table.Add(row.Pair, row.Regime, Whole(row.Fill), Text(outcome.OurTime, "0.0"), Text(outcome.PeerTime, "0.0"), Text(outcome.Ratio, "0.00"),
                $"{Text(outcome.LeastRatio, "0.00")}..{Text(outcome.GreatestRatio, "0.00")}", $"{Text(ours.Contacts, "0.00")} : {Text(peer.Contacts, "0.00")}",
                Text(outcome.StepTime, "0.0"));
        }
        table.Write(writer);
        foreach (var group in outcomes.GroupBy(outcome => outcome.Case.Fill))
        {
            double mean = Math.Exp(group.Average(outcome => Math.Log(outcome.Ratio)));
            int slower = group.Count(outcome => outcome.Ratio < 1);
            writer.WriteLine(FormattableString.Invariant(
                $"fill {group.Key}: peer/ours {mean:0.00} in the geometric mean, below 1 in {slower} of {group.Count()} rows"));
        }
        double inStep = Math.Exp(outcomes.Where(outcome => outcome.StepTime > 0).Average(outcome => Math.Log(outcome.PeerTime / outcome.StepTime!.Value)));
        writer.WriteLine(FormattableString.Invariant($"in a step: peer/ours {inStep:0.00} in the geometric mean of full batches"));
    }

    /// <summary>Writes all outcomes as a CSV file.</summary>
    public static void WriteCsv(string path, IReadOnlyList<PairOutcome> outcomes)
    {
        var table = new TextTable(
            "pair", "regime", "fill", "runs", "oursNs", "peerNs", "ratio", "ratioMin", "ratioMax", "oursContacts", "peerContacts", "oursStepNs");
        foreach (PairOutcome outcome in outcomes)
        {
            PairRow row = outcome.Case;
            (PairFigures ours, PairFigures peer) = outcome.Runs[0];
            table.Add(row.Pair, row.Regime, Whole(row.Fill), Whole(outcome.Runs.Count), Text(outcome.OurTime, "0.00"), Text(outcome.PeerTime, "0.00"),
                Text(outcome.Ratio, "0.000"), Text(outcome.LeastRatio, "0.000"), Text(outcome.GreatestRatio, "0.000"), Text(ours.Contacts, "0.000"),
                Text(peer.Contacts, "0.000"), Text(outcome.StepTime, "0.00"));
        }
        table.WriteCsv(path);
    }

    static string Text(double? value, string format) => value?.ToString(format, CultureInfo.InvariantCulture) ?? "";

    static string Whole(int value) => value.ToString(CultureInfo.InvariantCulture);
}
