using System.Collections.Generic;
using System.Linq;

namespace Benchmarks.Sweeps;

/// <summary>What one run of one program says of a case.</summary>
/// <param name="Name">World, shape and motion.</param>
/// <param name="Time">Nanoseconds of a sweep.</param>
/// <param name="Hits">Part of the sweeps that hit something.</param>
readonly record struct SweepFigures(string Name, double Time, double Hits);

/// <summary>A case with what all runs say of it.</summary>
sealed record SweepOutcome(string Name, List<(SweepFigures Ours, SweepFigures Peer)> Runs)
{
    public double OurTime => Median([.. Runs.Select(run => run.Ours.Time)]);

    public double PeerTime => Median([.. Runs.Select(run => run.Peer.Time)]);

    /// <summary>The peer's time over ours in neighbouring runs, from the least to the greatest.</summary>
    public double[] Ratios => [.. Runs.Select(run => run.Peer.Time / run.Ours.Time).Order()];

    public double Ratio => Median(Ratios);

    static double Median(double[] values) => values.Order().ElementAt(values.Length / 2);
}
