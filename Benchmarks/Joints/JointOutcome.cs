using System;
using System.Collections.Generic;
using System.Linq;
using Benchmarks.Compare;

namespace Benchmarks.Joints;

/// <summary>What both programs measured of a type at a width of vectors, run by run.</summary>
/// <param name="Type">The constraint.</param>
/// <param name="Lanes">Floats of a vector.</param>
/// <param name="Runs">Figures of neighbouring runs.</param>
sealed record JointOutcome(string Type, int Lanes, List<(JointFigures Ours, JointFigures Peer)> Runs)
{
    /// <summary>A figure of ours in the middle run.</summary>
    public double Ours(Func<JointFigures, double> figure) => Median(Runs.Select(run => figure(run.Ours)));

    /// <summary>A figure of the peer in the middle run.</summary>
    public double Peer(Func<JointFigures, double> figure) => Median(Runs.Select(run => figure(run.Peer)));

    /// <summary>How many times as long the peer takes: the middle of the pairs of runs, each of which ran back to back.</summary>
    public double Ratio(Func<JointFigures, double> figure) => Median(Runs.Select(run => figure(run.Peer) / figure(run.Ours)));

    static double Median(IEnumerable<double> numbers) => RunFigures.MedianOf(numbers.Select(number => (double?)number))!.Value;
}

/// <summary>What a run measured of a type, in nanoseconds of a constraint.</summary>
/// <param name="Type">The constraint.</param>
/// <param name="Lanes">Floats of a vector.</param>
/// <param name="Solve">A velocity iteration.</param>
/// <param name="Substep">A substep of one iteration, with its warm start and the integration of the bodies.</param>
readonly record struct JointFigures(string Type, int Lanes, double Solve, double Substep)
{
    /// <summary>The warm start and the integration of the bodies.</summary>
    public double WarmStart => Substep - Solve;
}
