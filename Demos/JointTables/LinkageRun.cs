using BepuPhysics;
using Demos.Accuracy;
using Demos.References;

namespace Demos.JointTables;

/// <summary>A linkage over a minute, beside its reference.</summary>
/// <param name="PeriodError">Of the mean of the first swings, as a part of it; zero where there is none.</param>
/// <param name="PlaceError">Of the point that is looked at, after <see cref="PlaceTime"/>, m.</param>
/// <param name="EnergyGain">The most that it was above its energy at the start, as a part of what it has above its lowest.</param>
/// <param name="EnergyLeft">What it has gained or lost at the end, as the same part.</param>
/// <param name="Gap">Greatest separation of a joint, m.</param>
sealed record LinkageRun(double PeriodError, double PlaceError, double EnergyGain, double EnergyLeft, double Gap)
{
    /// <summary>Seconds after which the place is compared.</summary>
    public const double PlaceTime = 2;

    public const int SwingCount = 10;

    /// <summary>Seconds of a run.</summary>
    public const double Duration = 60;

    /// <summary>Simulates it.</summary>
    public static LinkageRun Measure(Linkage linkage, AccuracySettings settings)
    {
        LinkageTruth truth = LinkageTruth.Of(linkage);
        using var world = new AccuracyWorld(settings with { Contacts = ContactScope.None });
        var gaps = new JointGaps(world);
        BodyHandle[] handles = linkage.AddTo(world, gaps);
        var period = new SwingClock();
        double start = linkage.Energy(world, handles), gain = 0, left = 0, placeError = double.NaN;
        Double3 Place() => world.Point(handles[linkage.WatchedBody], linkage.WatchedOffset);
        void Look() => period.Observe(world.Time, Double3.Dot(Place(), linkage.WatchedAxis) - linkage.WatchedLevel);
        Look();
        world.Run(Duration, () =>
        {
            gaps.Observe();
            left = (linkage.Energy(world, handles) - start) / truth.EnergyScale;
            gain = Tally.Most(gain, left);
            Look();
            if (double.IsNaN(placeError) && world.Time >= PlaceTime - settings.Dt / 2)
                placeError = (Place() - truth.Place).Length;
        });
        return new LinkageRun(linkage.IsPeriodic ? period.Mean(SwingCount) / truth.Period - 1 : 0, placeError, gain, left, gaps.Worst);
    }
}
