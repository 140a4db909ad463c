using System;
using System.Collections.Generic;
using Demos.References;

namespace DemoTests.Support;

/// <summary>Least values of a function of a direction along an arc of a great circle.</summary>
static class ConvexArc
{
    const double CoarseStep = 0.1;
    const double FineStep = 0.005;
    // Of golden sections: 0.005 shrinks to 2e-10, where values change by less than the rounding of a double.
    const int SectionCount = 36;

    /// <summary>Finds the minima that can be below a limit.</summary>
    /// <param name="start">First direction.</param>
    /// <param name="across">Unit direction of travel at the start.</param>
    /// <param name="angle">Length of the arc, radians.</param>
    /// <param name="slope">Bound on how fast the function changes with the angle: intervals are left out by it, so none is lost.</param>
    /// <param name="limit">Values above it do not matter; lowered to a tolerance above what is found.</param>
    /// <param name="tolerance">How far above the least value minima matter.</param>
    /// <param name="value">The function.</param>
    /// <param name="found">Receives the directions of the minima.</param>
    public static void Minimise(Double3 start, Double3 across, double angle, double slope, ref double limit, double tolerance,
        Func<Double3, double> value, List<Double3> found)
    {
        var count = Math.Max(1, (int)Math.Ceiling(angle / CoarseStep));
        var last = value(start);
        for (int i = 0; i < count; ++i)
        {
            double from = angle * i / count, to = angle * (i + 1) / count;
            var next = value(At(start, across, to));
            Search(start, across, from, to, last, next, slope, ref limit, tolerance, value, found);
            last = next;
        }
    }

    static void Search(Double3 start, Double3 across, double from, double to, double valueFrom, double valueTo, double slope,
        ref double limit, double tolerance, Func<Double3, double> value, List<Double3> found)
    {
        if ((valueFrom + valueTo - slope * (to - from)) * 0.5 > limit)
            return;
        if (to - from > FineStep)
        {
            var middle = 0.5 * (from + to);
            var between = value(At(start, across, middle));
            Search(start, across, from, middle, valueFrom, between, slope, ref limit, tolerance, value, found);
            Search(start, across, middle, to, between, valueTo, slope, ref limit, tolerance, value, found);
            return;
        }
        // Only where the function falls from both ends; where it is level, as around shapes on one axis, there is nothing to look for.
        const double Nudge = 1e-7;
        if (value(At(start, across, from + Nudge)) >= valueFrom || value(At(start, across, to - Nudge)) >= valueTo)
        {
            if (Math.Min(valueFrom, valueTo) <= limit)
            {
                limit = Math.Min(limit, Math.Min(valueFrom, valueTo) + tolerance);
                found.Add(At(start, across, valueFrom <= valueTo ? from : to));
            }
            return;
        }
        const double Golden = 0.6180339887498949;
        double low = from, high = to;
        var a = high - Golden * (high - low);
        var b = low + Golden * (high - low);
        double valueA = value(At(start, across, a)), valueB = value(At(start, across, b));
        for (int i = 0; i < SectionCount; ++i)
        {
            if (valueA <= valueB)
            {
                (high, b, valueB) = (b, a, valueA);
                a = high - Golden * (high - low);
                valueA = value(At(start, across, a));
            }
            else
            {
                (low, a, valueA) = (a, b, valueB);
                b = low + Golden * (high - low);
                valueB = value(At(start, across, b));
            }
        }
        limit = Math.Min(limit, Math.Min(valueA, valueB) + tolerance);
        found.Add(At(start, across, valueA <= valueB ? a : b));
    }

    static Double3 At(Double3 start, Double3 across, double angle) => start * Math.Cos(angle) + across * Math.Sin(angle);
}
