using System;
using System.Collections.Concurrent;
using Demos.References;

namespace Demos.JointTables;

/// <summary>What a linkage does in truth, by its reference.</summary>
/// <param name="Period">Mean of the first swings, s; not a number where there is none.</param>
/// <param name="Place">Of the point that is looked at, after <see cref="LinkageRun.PlaceTime"/>.</param>
/// <param name="EnergyScale">Greatest kinetic energy in that time, J.</param>
sealed record LinkageTruth(double Period, Double3 Place, double EnergyScale)
{
    const double Step = 1e-3;

    // Long enough for the slowest of the library.
    const double MostTime = 60;

    static readonly ConcurrentDictionary<string, LinkageTruth> known = new();

    /// <summary>Of a linkage of the library; worked out once.</summary>
    public static LinkageTruth Of(Linkage linkage) => known.GetOrAdd(linkage.Name, _ => Integrate(linkage, Step));

    /// <summary>By steps of a duration, in seconds.</summary>
    public static LinkageTruth Integrate(Linkage linkage, double step)
    {
        ConstrainedBodies reference = linkage.CreateReference();
        var clock = new SwingClock();
        var place = Double3.Zero;
        double scale = 0;
        int placeStep = (int)Math.Round(LinkageRun.PlaceTime / step);
        for (int i = 0; i <= MostTime / step; ++i)
        {
            if (i > 0)
                reference.Advance(step, step);
            scale = Math.Max(scale, reference.KineticEnergy);
            Double3 point = reference.Point(linkage.WatchedBody, linkage.WatchedOffset);
            clock.Observe(i * step, Double3.Dot(point, linkage.WatchedAxis) - linkage.WatchedLevel);
            if (i == placeStep)
                place = point;
            if (i >= placeStep && (!linkage.IsPeriodic || !double.IsNaN(clock.Mean(LinkageRun.SwingCount))))
                break;
        }
        return new LinkageTruth(clock.Mean(LinkageRun.SwingCount), place, scale);
    }
}
