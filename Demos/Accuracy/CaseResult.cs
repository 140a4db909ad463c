using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;

namespace Demos.Accuracy;

/// <summary>A figure of a case; its magnitude must not exceed the limit, which is infinite where there is none.</summary>
readonly record struct CaseFigure(string Quantity, double Value, double Limit, string Unit)
{
    public bool HasLimit => !double.IsInfinity(Limit);

    public bool IsMet => Math.Abs(Value) <= Limit;

    public string ValueText => $"{Quantity} {Format(Value)}";

    public string LimitText => $"{Quantity} {Format(Limit)}";

    /// <summary>A value in the unit of the figure, four digits, three of a percentage.</summary>
    public string Format(double value) => Unit == "%"
        ? string.Create(CultureInfo.InvariantCulture, $"{100 * value:G3} %")
        : string.Create(CultureInfo.InvariantCulture, $"{value:G4} {Unit}").TrimEnd();
}

/// <summary>What one run of one case measured: measured first, judged afterwards, so that a failing case is still in the report.</summary>
sealed class CaseResult(string id, string scene, object settings)
{
    readonly List<CaseFigure> figures = [];

    public string Id => id;

    public string Scene => scene;

    public string Settings => settings.ToString()!;

    public IReadOnlyList<CaseFigure> Figures => figures;

    public bool IsMet => figures.TrueForAll(figure => figure.IsMet);

    /// <summary>All figures, as a cell of a table.</summary>
    public string Found => string.Join(", ", figures.Select(figure => figure.ValueText));

    /// <summary>All limits, as a cell of a table.</summary>
    public string Must => string.Join(", ", figures.Where(figure => figure.HasLimit).Select(figure => figure.LimitText));

    /// <summary>A measured error: its magnitude must not exceed the limit.</summary>
    public CaseResult Limit(string quantity, double value, double limit, string unit = "")
    {
        figures.Add(new(quantity, value, limit, unit));
        return this;
    }

    /// <summary>A figure that has no threshold.</summary>
    public CaseResult Note(string quantity, double value, string unit = "") => Limit(quantity, value, double.PositiveInfinity, unit);

    /// <summary>Why its limits are known not to be met; null where they must be.</summary>
    public string? KnownMiss { get; init; } = KnownMisses.Reason(id, scene, settings.ToString()!);

    /// <summary>Met, or missed and why.</summary>
    public string Verdict => IsMet ? "met" : KnownMiss is null ? "**missed**" : $"missed: {KnownMiss}";

    /// <summary>A row of the page.</summary>
    public string Row => $"| {id} | {scene} | {settings} | {Found} | {Must} | {Verdict} |";

    /// <summary>
    /// What is wrong, or null: a figure that is not finite always is, one beyond its limit where that is not known; and a known miss that is none.
    /// </summary>
    public string? Failure
    {
        get
        {
            if (IsMet && KnownMiss is not null)
                return $"{id}, {scene}, {settings}: is met, and can be taken off the known misses";
            var wrong = figures.Where(figure => !double.IsFinite(figure.Value) || (KnownMiss is null && !figure.IsMet)).ToList();
            return wrong.Count == 0 ? null : $"{id}, {scene}, {settings}: " + string.Join("; ", wrong.Select(figure =>
                $"{figure.Quantity} is {figure.Format(figure.Value)}, must be within {figure.Format(figure.Limit)}"));
        }
    }
}
