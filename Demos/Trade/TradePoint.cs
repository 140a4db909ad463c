using System;
using System.Collections.Generic;
using System.Linq;

namespace Demos.Trade;

/// <summary>A place in the space of dials and what was measured there.</summary>
sealed class TradePoint(string engine, IReadOnlyDictionary<string, string> place)
{
    readonly List<double[]> runs = [];

    public string Engine => engine;

    /// <summary>Value of each dial by its name.</summary>
    public IReadOnlyDictionary<string, string> Place => place;

    /// <summary>How the place is called.</summary>
    public string Label => TradeAxis.LabelOf(place);

    /// <summary>In the scene's unit; not a number when what was to hold has broken. Runs of one setting are alike, so it is the first one's.</summary>
    public double Error { get; private set; } = double.NaN;

    /// <summary>Runs that were measured.</summary>
    public int RunCount => runs.Count;

    /// <summary>
    /// Milliseconds of a step: of each step the middle of the runs, and of these the mean. A step does the same work in each run, so what the machine did
    /// beside it in one of them falls out, while steps that have more to do than others still count for it.
    /// </summary>
    public double Milliseconds { get; private set; } = double.NaN;

    /// <summary>Milliseconds of a step in the quickest run.</summary>
    public double LeastMilliseconds => runs.Count == 0 ? double.NaN : runs.Min(run => run.Average());

    /// <summary>Milliseconds of a step in the slowest run.</summary>
    public double GreatestMilliseconds => runs.Count == 0 ? double.NaN : runs.Max(run => run.Average());

    public void Add(TradeMeasurement measurement)
    {
        if (runs.Count == 0)
            Error = measurement.Error ?? double.NaN;
        runs.Add(measurement.Milliseconds);
        var ofStep = new double[runs.Count];
        double sum = 0;
        for (int step = 0; step < measurement.Milliseconds.Length; ++step)
        {
            for (int run = 0; run < runs.Count; ++run)
                ofStep[run] = runs[run][step];
            Array.Sort(ofStep);
            int middle = ofStep.Length / 2;
            sum += ofStep.Length % 2 == 1 ? ofStep[middle] : (ofStep[middle - 1] + ofStep[middle]) / 2;
        }
        Milliseconds = sum / measurement.Milliseconds.Length;
    }
}
