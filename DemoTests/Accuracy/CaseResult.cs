using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Accuracy;

/// <summary>
/// What one run of one case measured: written as a row first, judged afterwards, so that a failing case is still in the report.
/// </summary>
sealed class CaseResult(string id, string scene, object settings)
{
    readonly List<(string Quantity, double Value, double Limit, string Unit)> measured = [];

    /// <summary>A measured error: its magnitude must not exceed the limit.</summary>
    public CaseResult Limit(string quantity, double value, double limit, string unit = "")
    {
        measured.Add((quantity, value, limit, unit));
        return this;
    }

    /// <summary>A figure that has no threshold.</summary>
    public CaseResult Note(string quantity, double value, string unit = "") => Limit(quantity, value, double.PositiveInfinity, unit);

    /// <summary>Writes the row; all figures must be finite, and within their limits when they are enforced.</summary>
    public void Finish(ITestOutputHelper output, bool enforce)
    {
        var missed = measured.Where(m => !(Math.Abs(m.Value) <= m.Limit)).ToList();
        string found = string.Join(", ", measured.Select(m => $"{m.Quantity} {Format(m.Value, m.Unit)}"));
        var limited = measured.Where(m => !double.IsInfinity(m.Limit));
        string must = string.Join(", ", limited.Select(m => $"{m.Quantity} {Format(m.Limit, m.Unit)}"));
        string verdict = (missed.Count == 0 ? "met" : "missed") + (enforce ? "" : " (reported)");
        string row = $"| {id} | {scene} | {settings} | {found} | {must} | {verdict} |";
        output.WriteLine(row);
        AccuracyReport.Add(row);
        Assert.All(measured, m => Assert.True(double.IsFinite(m.Value), $"{id} {scene} {settings}: {m.Quantity} is {m.Value}"));
        if (enforce)
            Assert.True(missed.Count == 0, $"{id} {scene} {settings}: " + string.Join("; ", missed.Select(m =>
                $"{m.Quantity} is {Format(m.Value, m.Unit)}, must be within {Format(m.Limit, m.Unit)}")));
    }

    static string Format(double value, string unit) => unit == "%"
        ? string.Create(CultureInfo.InvariantCulture, $"{100 * value:G3} %")
        : string.Create(CultureInfo.InvariantCulture, $"{value:G4} {unit}").TrimEnd();
}
