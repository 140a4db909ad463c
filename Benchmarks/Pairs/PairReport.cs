using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Text;

namespace Benchmarks.Pairs;

/// <summary>Writes outcomes as a table for people and as CSV for the Results folder.</summary>
static class PairReport
{
    /// <summary>Writes the table, and for each fill the geometric mean of its ratios.</summary>
    public static void Write(TextWriter writer, IReadOnlyList<PairOutcome> outcomes)
    {
        writer.WriteLine(
            $"{"pair",-18}{"regime",-10}{"fill",5}{"ours ns",10}{"peer ns",10}{"peer/ours",11}  {"spread",-12}{"contacts",13}{"step ns",10}");
        foreach (PairOutcome outcome in outcomes)
        {
            PairRow row = outcome.Case;
            (PairFigures ours, PairFigures peer) = outcome.Runs[0];
            string spread = FormattableString.Invariant($"{outcome.LeastRatio:0.00}..{outcome.GreatestRatio:0.00}");
            string contacts = FormattableString.Invariant($"{ours.Contacts:0.00} : {peer.Contacts:0.00}");
            writer.Write($"{row.Pair,-18}{row.Regime,-10}{row.Fill,5}");
            writer.Write(FormattableString.Invariant($"{outcome.OurTime,10:0.0}{outcome.PeerTime,10:0.0}{outcome.Ratio,11:0.00}  "));
            writer.WriteLine(FormattableString.Invariant($"{spread,-12}{contacts,13}{outcome.StepTime,10:0.0}").TrimEnd());
        }
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
        var text = new StringBuilder("pair,regime,fill,runs,oursNs,peerNs,ratio,ratioMin,ratioMax,oursContacts,peerContacts,oursStepNs\n");
        foreach (PairOutcome outcome in outcomes)
        {
            PairRow row = outcome.Case;
            (PairFigures ours, PairFigures peer) = outcome.Runs[0];
            text.Append(FormattableString.Invariant($"{row.Pair},{row.Regime},{row.Fill},{outcome.Runs.Count},"));
            text.Append(FormattableString.Invariant($"{outcome.OurTime:0.00},{outcome.PeerTime:0.00},"));
            text.Append(FormattableString.Invariant($"{outcome.Ratio:0.000},{outcome.LeastRatio:0.000},{outcome.GreatestRatio:0.000},"));
            text.Append(FormattableString.Invariant($"{ours.Contacts:0.000},{peer.Contacts:0.000},{outcome.StepTime:0.00}\n"));
        }
        if (Path.GetDirectoryName(Path.GetFullPath(path)) is string folder)
            Directory.CreateDirectory(folder);
        File.WriteAllText(path, text.ToString());
    }
}
