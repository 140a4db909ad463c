using System;

namespace Demos.Towers.Trials;

/// <summary>Something that must slip or tip over, at a moment that is known.</summary>
/// <param name="name">Word by which it is chosen.</param>
/// <param name="summary">What it is, in a line.</param>
/// <param name="unit">Of the figure.</param>
/// <param name="truth">The figure for rigid bodies.</param>
/// <param name="measure">Finds the figure at a setting.</param>
sealed class Trial(string name, string summary, string unit, double truth, Func<TowerSettings, double> measure)
{
    public string Name { get; } = name;

    public string Summary { get; } = summary;

    public string Unit { get; } = unit;

    /// <summary>The figure for rigid bodies.</summary>
    public double Truth { get; } = truth;

    /// <summary>Finds the figure at a setting.</summary>
    public double Measure(TowerSettings settings) => measure(settings);
}
