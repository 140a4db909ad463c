using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Linq;
using System.Text.Json;
using Demos.Terminal;

namespace Demos.Trade;

/// <summary>What a sweep found: its tables, its sentence about the peer, and its file.</summary>
sealed class TradeReport
{
    readonly TradeScene scene;
    readonly List<IGrouping<string, TradePoint>> engines;
    readonly bool isComplete;
    readonly HashSet<TradePoint> onFront;
    readonly List<(TradePoint Theirs, TradePoint? Ours, double Ratio)> ratios = [];

    /// <param name="scene">What was measured.</param>
    /// <param name="points">All points; our engine's come first.</param>
    /// <param name="isComplete">Whether all runs were done.</param>
    public TradeReport(TradeScene scene, IEnumerable<TradePoint> points, bool isComplete)
    {
        this.scene = scene;
        this.isComplete = isComplete;
        engines = [.. points.Where(point => point.RunCount > 0).GroupBy(point => point.Engine)];
        onFront = [.. engines.SelectMany(TradeFront.Of)];
        if (engines.Count == 2)
            ratios = TradeFront.Compare([.. engines[0]], [.. engines[1]]);
    }

    /// <summary>All that was measured, by engine, as a plot of error over time.</summary>
    public string Plot() => new TradePlot(scene, engines.Select(engine => (engine.Key, engine.ToList(), TradeFront.Of(engine)))).ToSvg();

    /// <summary>Writes the fronts, or all points with a mark at those on a front.</summary>
    public void WriteTable(TextWriter writer, bool all) => Table(all).Write(writer, Title);

    /// <summary>Writes the page of a scene: all points and what they say about the peer.</summary>
    public void WriteMarkdown(TextWriter writer)
    {
        writer.WriteLine($"# {Title}\n");
        Table(true).WriteMarkdown(writer);
        if (Verdict() is string verdict)
            writer.WriteLine($"\n{verdict}");
    }

    /// <summary>Where our front lies to the peer's; null when there is only one engine.</summary>
    public string? Verdict()
    {
        if (engines.Count != 2)
            return null;
        string other = engines[1].Key;
        double best = LeastError(engines[0]), theirs = LeastError(engines[1]);
        if (ratios.Count == 0)
            return $"Against {other}: none of its settings holds. Least error {scene.Show(best)}.";
        double[] known = [.. ratios.Select(entry => entry.Ratio).Where(double.IsFinite)];
        int unreached = ratios.Count - known.Length;
        string reach = unreached == 0 ? "" : $"; {unreached} of {ratios.Count} points of its front are more exact than any of ours";
        string time = known.Length == 0 ? "no point of its front is reached" : string.Create(CultureInfo.InvariantCulture,
            $"our time at no larger error is {known.Min():0.00} to {known.Max():0.00} of its time, "
            + $"{Math.Exp(known.Average(Math.Log)):0.00} in the geometric mean");
        return $"Against {other}: {time}{reach}. Least error {scene.Show(best)} : {scene.Show(theirs)}.";
    }

    /// <summary>Writes everything as one JSON object.</summary>
    public string ToJson() => JsonSerializer.Serialize(
        new TradeReportJson(scene.Name, scene.Summary, scene.ErrorName, scene.Unit, isComplete,
            [.. engines.SelectMany(engine => engine).Select(ToJson)],
            [.. ratios.Select(entry => new TradeRatioJson(entry.Theirs.Label, entry.Theirs.Error, entry.Ours?.Label, Known(entry.Ratio)))]),
        TradeFileJson.Default.TradeReportJson);

    string Title => $"{scene.Name}: {scene.Summary}; error: {scene.ErrorName}{(isComplete ? "" : " (stopped before its end)")}";

    TextTable Table(bool all)
    {
        var table = new TextTable("engine", "setting", ">error", ">ms per step", ">least", ">greatest", "front");
        foreach (TradePoint point in engines.SelectMany(engine => engine.OrderBy(point => point.Milliseconds)))
        {
            if (all || onFront.Contains(point))
                table.Add(point.Engine, point.Label, scene.Show(point.Error), Time(point.Milliseconds), Time(point.LeastMilliseconds),
                    Time(point.GreatestMilliseconds), onFront.Contains(point) ? "*" : "");
        }
        return table;
    }

    TradePointJson ToJson(TradePoint point) => new(point.Engine, point.Label, point.Place, Known(point.Error), Known(point.Milliseconds),
        Known(point.LeastMilliseconds), Known(point.GreatestMilliseconds), point.RunCount, onFront.Contains(point));

    /// <summary>The most exact point's error; not a number when all broke.</summary>
    static double LeastError(IEnumerable<TradePoint> points) =>
        points.Select(point => point.Error).Where(double.IsFinite).DefaultIfEmpty(double.NaN).Min();

    static double? Known(double value) => double.IsFinite(value) ? value : null;

    static string Time(double milliseconds) => milliseconds.ToString(milliseconds < 1 ? "0.0000" : "0.000", CultureInfo.InvariantCulture);
}
