using System.Collections.Generic;
using System.Linq;
using Benchmarks.Compare;

namespace Benchmarks.Pairs;

/// <summary>What both programs measured of one case at one number of pairs per flush, run by run.</summary>
/// <param name="Case">What was measured.</param>
/// <param name="Runs">Figures of neighbouring runs.</param>
/// <param name="InStep">Nanoseconds per pair in a step of ours, for full batches; otherwise empty.</param>
sealed record PairOutcome(PairRow Case, List<(PairFigures Ours, PairFigures Peer)> Runs, List<double> InStep)
{
    /// <summary>Nanoseconds per pair: the middle run's.</summary>
    public double OurTime => Median(Runs.Select(run => run.Ours.Time))!.Value;

    /// <summary>Nanoseconds per pair: the middle run's.</summary>
    public double PeerTime => Median(Runs.Select(run => run.Peer.Time))!.Value;

    /// <summary>Nanoseconds per pair: the middle run's; null but for full batches.</summary>
    public double? StepTime => Median(InStep);

    /// <summary>How many times as long the peer takes: the middle of the pairs of runs, each of which ran back to back.</summary>
    public double Ratio => Median(Ratios)!.Value;

    public double LeastRatio => Ratios.Min();

    public double GreatestRatio => Ratios.Max();

    IEnumerable<double> Ratios => Runs.Select(run => run.Peer.Time / run.Ours.Time);

    static double? Median(IEnumerable<double> numbers) => RunFigures.MedianOf(numbers.Select(number => (double?)number));
}

/// <summary>A row of the table.</summary>
/// <param name="Pair">Kinds of shapes.</param>
/// <param name="Regime">How they are placed.</param>
/// <param name="Fill">Pairs that are tested at a time.</param>
readonly record struct PairRow(string Pair, string Regime, int Fill);

/// <summary>What a run measured of a row.</summary>
/// <param name="Time">Nanoseconds per pair.</param>
/// <param name="Contacts">Contacts per pair.</param>
readonly record struct PairFigures(double Time, double Contacts);
