using System.Collections.Generic;
using System.Linq;
using Demos.Running;

namespace Benchmarks.Compare;

/// <summary>Both programs' figures of one case, run by run.</summary>
sealed class CompareOutcome(CompareCase subject, List<(RunJson Ours, RunJson Peer)> runs)
{
    public CompareCase Case => subject;

    public string SceneName => runs[0].Ours.Scene;

    public int Lanes => runs[0].Ours.Lanes;

    public int RunCount => runs.Count;

    public RunJson FirstOfOurs => runs[0].Ours;

    public RunJson FirstOfPeer => runs[0].Peer;

    /// <summary>Milliseconds per step: the middle run's median.</summary>
    public double OurMedian => RunFigures.MedianOf(runs.Select(run => run.Ours.Ms.Median))!.Value;

    /// <summary>Milliseconds per step: the middle run's median.</summary>
    public double PeerMedian => RunFigures.MedianOf(runs.Select(run => run.Peer.Ms.Median))!.Value;

    /// <summary>How many times as long the peer takes: the middle of the pairs, each of which ran back to back.</summary>
    public double Ratio => RunFigures.MedianOf(Ratios.Select(ratio => (double?)ratio))!.Value;

    public double LeastRatio => Ratios.Min();

    public double GreatestRatio => Ratios.Max();

    /// <summary>Whether all our runs ended in the same state.</summary>
    public bool IsRepeatable => runs.TrueForAll(run => run.Ours.Hash == runs[0].Ours.Hash);

    IEnumerable<double> Ratios => runs.Select(run => run.Peer.Ms.Median!.Value / run.Ours.Ms.Median!.Value);

    /// <summary>Milliseconds of a stage in the middle run of ours and of the peer.</summary>
    public (double? Ours, double? Peer) Stage(int index) => (
        RunFigures.MedianOf(runs.Select(run => RunFigures.Stage(run.Ours, index))),
        RunFigures.MedianOf(runs.Select(run => RunFigures.Stage(run.Peer, index))));
}
