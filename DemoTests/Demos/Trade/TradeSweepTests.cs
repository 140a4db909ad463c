using System.Collections.Generic;
using System.Linq;
using System.Threading;
using Demos.Trade;
using Xunit;

namespace DemoTests.Runner;

public sealed class TradeSweepTests
{
    readonly List<string> asked = [];

    [Fact]
    public void Engines_and_settings_take_turns()
    {
        var sweep = new TradeSweep(TradeScene.Find("heavy"), [new FakeEngine("a", this), new FakeEngine("b", this)], Two());

        sweep.Run(2, null, default);

        string[] round = ["a s1", "b s1", "a s2", "b s2"];
        Assert.Equal([.. round, .. round], asked.TakeLast(8));
        Assert.All(sweep.Points, point => Assert.Equal(2, point.RunCount));
    }

    [Fact]
    public void A_sweep_that_is_stopped_keeps_what_it_has()
    {
        using var source = new CancellationTokenSource();
        var scene = TradeScene.Find("heavy");
        var sweep = new TradeSweep(scene, [new FakeEngine("a", this), new FakeEngine("b", this)], Two());

        sweep.Run(5, (done, _, _) =>
        {
            if (done == 3)
                source.Cancel();
        }, source.Token);

        Assert.Equal([1, 1, 1, 0], sweep.Points.Select(point => point.RunCount));
        var report = new TradeReport(scene, sweep.Points, isComplete: false);
        Assert.Contains("\"complete\": false", report.ToJson(), System.StringComparison.Ordinal);
        Assert.NotNull(report.Verdict());
        Assert.StartsWith("<svg", report.Plot(), System.StringComparison.Ordinal);
    }

    static Dictionary<string, string[]> Two() => new() { ["substeps"] = ["1", "2"] };

    /// <summary>Takes no time and is as wrong as its substeps are long.</summary>
    sealed class FakeEngine(string name, TradeSweepTests test) : ITradeEngine
    {
        public string Name => name;

        public IReadOnlyDictionary<string, string[]> Values(string scene) => new Dictionary<string, string[]>
        {
            ["mode"] = ["default"],
            ["spring"] = ["default"],
            ["load-path"] = ["off"],
            ["joints"] = ["swept"],
            ["relaxations"] = ["0"],
            ["iterations"] = ["1"],
            ["substeps"] = ["1", "2", "4"],
        };

        public TradeMeasurement? Measure(string scene, IReadOnlyDictionary<string, string> place, int? steps, CancellationToken stop)
        {
            test.asked.Add($"{name} s{place["substeps"]}");
            double substeps = double.Parse(place["substeps"], System.Globalization.CultureInfo.InvariantCulture);
            return stop.IsCancellationRequested ? null : new TradeMeasurement(1 / substeps, [substeps, substeps]);
        }

        public void Dispose()
        {
        }
    }
}
