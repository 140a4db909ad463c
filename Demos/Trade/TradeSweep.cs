using System;
using System.Collections.Generic;
using System.Linq;
using System.Threading;
using Demos.Scenes;

namespace Demos.Trade;

/// <summary>
/// Measures a scene at all places of the space of dials with all engines, in turn: A B C, A B C, so that whatever else the machine does falls on all.
/// </summary>
sealed class TradeSweep
{
    readonly TradeScene scene;
    readonly List<(ITradeEngine Engine, TradePoint Point)> points = [];

    /// <param name="scene">What is measured.</param>
    /// <param name="engines">Who is measured.</param>
    /// <param name="asked">Values of dials to try instead of those that an engine tries by itself.</param>
    /// <exception cref="SceneException">A dial has no such value.</exception>
    public TradeSweep(TradeScene scene, IReadOnlyList<ITradeEngine> engines, IReadOnlyDictionary<string, string[]> asked)
    {
        this.scene = scene;
        var ofEngines = engines.Select(engine => Places(engine, asked).Select(place => (engine, new TradePoint(engine.Name, place))).ToList()).ToList();
        // The engines take turns as well as the settings.
        for (int i = 0; i < ofEngines.Max(list => list.Count); ++i)
            points.AddRange(ofEngines.Where(list => i < list.Count).Select(list => list[i]));
    }

    /// <summary>All points, measured or not yet.</summary>
    public IEnumerable<TradePoint> Points => points.Select(entry => entry.Point);

    /// <summary>Measures so many runs of each point; ends early, with what there is, when it is stopped.</summary>
    /// <param name="runs">Runs of each point.</param>
    /// <param name="progress">Told before each run how many are done and which comes.</param>
    /// <param name="stop">Asked before each run and within it.</param>
    public void Run(int runs, Action<int, int, TradePoint>? progress, CancellationToken stop)
    {
        const int warmUpSteps = 4;
        // Whatever a scene needs is compiled before anything is timed: the extremes of the dials use all of it.
        foreach ((ITradeEngine engine, TradePoint point) in points.Where((_, i) => i < 2 || i >= points.Count - 2))
            engine.Measure(scene.Name, point.Place, warmUpSteps, stop);
        for (int run = 0; run < runs; ++run)
        {
            for (int i = 0; i < points.Count; ++i)
            {
                (ITradeEngine engine, TradePoint point) = points[i];
                progress?.Invoke(run * points.Count + i, runs * points.Count, point);
                if (stop.IsCancellationRequested || engine.Measure(scene.Name, point.Place, null, stop) is not TradeMeasurement measurement)
                    return;
                point.Add(measurement);
            }
        }
    }

    List<Dictionary<string, string>> Places(ITradeEngine engine, IReadOnlyDictionary<string, string[]> asked)
    {
        IReadOnlyDictionary<string, string[]> ownValues = engine.Values(scene.Name);
        List<Dictionary<string, string>> places = [[]];
        foreach (TradeAxis axis in TradeAxis.All)
        {
            string[] own = ownValues[axis.Name];
            string[] values = asked.TryGetValue(axis.Name, out string[]? chosen) ? chosen : own;
            // An engine that has only one value of a dial has no such dial.
            if (own is ["0"] or [TradeAxis.Swept])
                values = own;
            places = [.. places.SelectMany(place => values.Select(value => new Dictionary<string, string>(place) { [axis.Name] = value }))];
        }
        foreach (Dictionary<string, string> place in places)
            TradeAxis.Settings(place);
        return places;
    }
}
