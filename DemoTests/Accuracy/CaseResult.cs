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
        output.WriteLine(Row(enforce));
        AccuracyReport.Add(Row(enforce));
        string? failure = Failure(enforce);
        Assert.True(failure is null, failure);
    }

    public string Row(bool enforce)
    {
        string found = string.Join(", ", measured.Select(m => $"{m.Quantity} {Format(m.Value, m.Unit)}"));
        var limited = measured.Where(m => !double.IsInfinity(m.Limit));
        string must = string.Join(", ", limited.Select(m => $"{m.Quantity} {Format(m.Limit, m.Unit)}"));
        string verdict = (measured.All(IsMet) ? "met" : "missed") + (enforce ? "" : " (reported)");
        return $"| {id} | {scene} | {settings} | {found} | {must} | {verdict} |";
    }

    /// <summary>What is wrong, or null.</summary>
    public string? Failure(bool enforce)
    {
        var wrong = measured.Where(m => !double.IsFinite(m.Value) || (enforce && !IsMet(m))).ToList();
        return wrong.Count == 0 ? null : $"{id}, {scene}, {settings}: " + string.Join("; ", wrong.Select(m =>
            $"{m.Quantity} is {Format(m.Value, m.Unit)}, must be within {Format(m.Limit, m.Unit)}"));
    }

    static bool IsMet((string Quantity, double Value, double Limit, string Unit) m) => Math.Abs(m.Value) <= m.Limit;

    static string Format(double value, string unit) => unit == "%"
        ? string.Create(CultureInfo.InvariantCulture, $"{100 * value:G3} %")
        : string.Create(CultureInfo.InvariantCulture, $"{value:G4} {unit}").TrimEnd();
}
