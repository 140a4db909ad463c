using System.Collections.Generic;
using System.Linq;
using Demos.Trade;
using Xunit;

namespace DemoTests.Runner;

public class TradeFrontTests
{
    [Fact]
    public void The_front_is_what_nothing_beats()
    {
        TradePoint[] points =
        [
            Point(4, .1), Point(1, 5), Point(2, 1), Point(3, 2), Point(2, 3), Point(5, .1), Point(6, double.NaN), Point(6, .098), Point(7, .01),
        ];

        Assert.Equal([(1, 5), (2, 1), (4, .1), (7, .01)], TradeFront.Of(points).Select(point => (point.Milliseconds, point.Error)));
    }

    [Fact]
    public void Two_fronts_are_compared_at_no_larger_error()
    {
        List<TradePoint> ours = [Point(1, 4), Point(3, 1), Point(9, .5), Point(2.5, 2.08)], theirs = [Point(2, 4), Point(4, 2), Point(5, 2), Point(8, .1)];

        var ratios = TradeFront.Compare(ours, theirs);

        Assert.Equal([.5, .625, double.PositiveInfinity], ratios.Select(entry => entry.Ratio));
        Assert.Equal([ours[0], ours[3], null], ratios.Select(entry => entry.Ours));
    }

    [Fact]
    public void A_disturbed_run_does_not_count()
    {
        var point = new TradePoint("engine", new Dictionary<string, string> { ["substeps"] = "4" });
        foreach (double[] run in (double[][])[[1, 3, 5], [100, 3, 5], [1, 3, 900]])
            point.Add(new TradeMeasurement(.5, run));

        Assert.Equal(3, point.Milliseconds);
        Assert.Equal(3, point.LeastMilliseconds);
        Assert.Equal(.5, point.Error);
        Assert.Equal("s4", point.Label);
    }

    static TradePoint Point(double milliseconds, double error)
    {
        var point = new TradePoint("engine", new Dictionary<string, string>());
        point.Add(new TradeMeasurement(double.IsNaN(error) ? null : error, [milliseconds]));
        return point;
    }
}
