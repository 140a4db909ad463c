using System.Collections.Generic;
using System.Linq;

namespace Demos.Trade;

/// <summary>The points that nothing beats, and how two engines' lie to each other.</summary>
static class TradeFront
{
    /// <summary>Errors that differ by less than this factor are the same: both engines leave 9.9 % at some setting, and 9.95 is not better than 9.96.</summary>
    public const double SameError = 1.05;

    /// <summary>
    /// The Pareto front, from the quickest to the most exact: of the others each is no quicker than one of these, and no more exact by more than
    /// <see cref="SameError"/>. What broke is on no front.
    /// </summary>
    public static List<TradePoint> Of(IEnumerable<TradePoint> points)
    {
        var front = new List<TradePoint>();
        foreach (TradePoint point in points.Where(IsMeasured).OrderBy(point => point.Milliseconds).ThenBy(point => point.Error))
        {
            if (front.Count == 0 || point.Error * SameError < front[^1].Error)
                front.Add(point);
        }
        return front;
    }

    /// <summary>The quickest point whose error is no larger, up to <see cref="SameError"/>; or null.</summary>
    public static TradePoint? QuickestWithin(IEnumerable<TradePoint> points, double error) =>
        points.Where(point => IsMeasured(point) && point.Error <= error * SameError).MinBy(point => point.Milliseconds);

    /// <summary>
    /// Our time over theirs for each point of their front, with the quickest of our settings that is no less exact; infinite where there is none. All below
    /// one: nowhere behind.
    /// </summary>
    public static List<(TradePoint Theirs, TradePoint? Ours, double Ratio)> Compare(List<TradePoint> ours, List<TradePoint> theirs) =>
    [
        .. Of(theirs).Select(point =>
        {
            TradePoint? match = QuickestWithin(ours, point.Error);
            return (point, match, match is null ? double.PositiveInfinity : match.Milliseconds / point.Milliseconds);
        }),
    ];

    static bool IsMeasured(TradePoint point) => double.IsFinite(point.Error) && double.IsFinite(point.Milliseconds);
}
