using System.Collections.Generic;
using System.Globalization;
using System.IO;
using Demos.Terminal;

namespace Benchmarks.Sweeps;

/// <summary>Writes outcomes as a table for people and as CSV for the Results folder.</summary>
/// <param name="outcomes">What came of it.</param>
/// <param name="headings">What the three names of an outcome are.</param>
sealed class SweepReport(IReadOnlyList<SweepOutcome> outcomes, string[] headings)
{
    public void Write(TextWriter writer) => Table().Write(writer);

    public void WriteCsv(string path) => Table().WriteCsv(path);

    TextTable Table()
    {
        var table = new TextTable([.. headings, ">ours thousands/s", ">peer thousands/s", ">peer/ours", ">least", ">greatest", ">ours hit", ">peer hit"]);
        foreach (SweepOutcome outcome in outcomes)
        {
            double[] ratios = outcome.Ratios;
            (SweepFigures ours, SweepFigures peer) = outcome.Runs[0];
            string[] name = outcome.Name.Split(", ");
            table.Add(name[0], name[1], name[2], Text(1e6 / outcome.OurTime, "0"), Text(1e6 / outcome.PeerTime, "0"), Text(outcome.Ratio, "0.00"),
                Text(ratios[0], "0.00"), Text(ratios[^1], "0.00"), Text(ours.Hits, "0.000"), Text(peer.Hits, "0.000"));
        }
        return table;
    }

    // A peer that cannot be asked has no time.
    static string Text(double value, string format) => double.IsNaN(value) ? "-" : value.ToString(format, CultureInfo.InvariantCulture);
}
