using System.Collections.Generic;

namespace Demos.JointTables;

/// <summary>Times at which something that swings goes through zero upwards.</summary>
sealed class SwingClock
{
    readonly List<double> crossings = [];
    double lastTime, lastValue = double.NaN;

    /// <summary>Mean duration of the first swings; not a number before there are so many.</summary>
    public double Mean(int count) => crossings.Count > count ? (crossings[count] - crossings[0]) / count : double.NaN;

    /// <summary>Mean duration of all swings; not a number before the first has ended.</summary>
    public double Mean() => crossings.Count > 1 ? Mean(crossings.Count - 1) : double.NaN;

    public void Observe(double time, double value)
    {
        // It is fastest there, so between two looks the crossing is linear to third order.
        if (lastValue < 0 && value >= 0)
            crossings.Add(lastTime + (time - lastTime) * lastValue / (lastValue - value));
        (lastTime, lastValue) = (time, value);
    }
}
