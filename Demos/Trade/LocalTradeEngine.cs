using System.Collections.Generic;
using System.Linq;
using System.Threading;
using Demos.Engine;

namespace Demos.Trade;

/// <summary>The engine that this program is compiled against.</summary>
sealed class LocalTradeEngine : ITradeEngine
{
    public string Name => EngineDefaults.Name;

    public IReadOnlyDictionary<string, string[]> Values(string scene) => ValuesFor(TradeScene.Find(scene));

    public TradeMeasurement? Measure(string scene, IReadOnlyDictionary<string, string> place, int? steps, CancellationToken stop) =>
        TradeMeasurement.Take(TradeScene.Find(scene), TradeAxis.Settings(place), stop, steps);

    /// <summary>What the engine tries in a scene.</summary>
    public static Dictionary<string, string[]> ValuesFor(TradeScene scene) => TradeAxis.All.ToDictionary(axis => axis.Name, axis => axis.Values(scene));

    public void Dispose()
    {
    }
}
