using System;

namespace Demos.Accuracy;

/// <summary>Keeps the extremes of what is observed from step to step.</summary>
static class Tally
{
    /// <summary>The error of larger magnitude, with its sign. Not-a-number is the worst and stays.</summary>
    public static double Worst(double soFar, double observed) =>
        double.IsNaN(soFar) || Math.Abs(observed) <= Math.Abs(soFar) ? soFar : observed;

    /// <summary>The larger value. Not-a-number is the worst and stays.</summary>
    public static double Most(double soFar, double observed) => double.IsNaN(soFar) || observed <= soFar ? soFar : observed;
}
