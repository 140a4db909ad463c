using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Linq;
using Demos.Terminal;

namespace Benchmarks.Joints;

/// <summary>Writes outcomes as a table for people and as CSV for the Results folder.</summary>
static class JointReport
{
    /// <summary>Writes the table, and for each width the geometric means of its ratios.</summary>
    public static void Write(TextWriter writer, IReadOnlyList<JointOutcome> outcomes)
    {
        Table(outcomes).Write(writer);
        foreach (var group in outcomes.GroupBy(outcome => outcome.Lanes))
        {
            writer.WriteLine(FormattableString.Invariant(
                $"{group.Key} lanes: peer/ours {Mean(group, time => time.WarmStart):0.00} of warm starts with integration, ") + FormattableString.Invariant(
                $"{Mean(group, time => time.Solve):0.00} of iterations, {Mean(group, time => time.Substep):0.00} of substeps, in the geometric mean"));
        }
    }

    /// <summary>Writes all outcomes as a CSV file.</summary>
    public static void WriteCsv(string path, IReadOnlyList<JointOutcome> outcomes) => Table(outcomes).WriteCsv(path);

    static TextTable Table(IReadOnlyList<JointOutcome> outcomes)
    {
        var table = new TextTable("constraint", ">lanes", ">ours warm ns", ">peer warm ns", ">ours solve ns", ">peer solve ns",
            ">warm peer/ours", ">solve peer/ours", ">substep peer/ours");
        foreach (JointOutcome outcome in outcomes)
        {
            table.Add(outcome.Type, outcome.Lanes.ToString(CultureInfo.InvariantCulture),
                Text(outcome.Ours(time => time.WarmStart), "0.0"), Text(outcome.Peer(time => time.WarmStart), "0.0"),
                Text(outcome.Ours(time => time.Solve), "0.0"), Text(outcome.Peer(time => time.Solve), "0.0"),
                Text(outcome.Ratio(time => time.WarmStart), "0.00"), Text(outcome.Ratio(time => time.Solve), "0.00"),
                Text(outcome.Ratio(time => time.Substep), "0.00"));
        }
        return table;
    }

    static double Mean(IEnumerable<JointOutcome> outcomes, Func<JointFigures, double> figure) =>
        Math.Exp(outcomes.Average(outcome => Math.Log(outcome.Ratio(figure))));

    static string Text(double value, string format) => value.ToString(format, CultureInfo.InvariantCulture);
}
