using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using System.Security;
using System.Text;

namespace Demos.Trade;

/// <summary>
/// Error over time of a step, both in powers of ten: a mark for each point, a line along each engine's front, and the settings beside it. Written by
/// hand, as SVG: a plot of points and lines is a hundred lines of text, where a plotting package brings a native drawing library for each system.
/// </summary>
sealed class TradePlot
{
    const int Width = 900, Height = 600, Left = 90, Right = 30, Top = 60, Bottom = 60;

    static readonly string[] colours = ["#1f5fa8", "#c4501b", "#3a8a3a", "#7a4aa0"];

    readonly TradeScene scene;
    readonly List<(string Engine, List<TradePoint> Points, List<TradePoint> Front)> series;
    readonly (double Least, double Greatest) times, errors;
    readonly List<(double Left, double Right, double Bottom)> labels = [];
    readonly StringBuilder svg = new();

    public TradePlot(TradeScene scene, IEnumerable<(string Engine, List<TradePoint> Points, List<TradePoint> Front)> series)
    {
        this.scene = scene;
        this.series = [.. series];
        List<TradePoint> shown = [.. this.series.SelectMany(entry => entry.Points).Where(IsShown)];
        times = Range(shown.Select(point => point.Milliseconds));
        errors = Range(shown.Select(point => point.Error));
    }

    /// <summary>The plot as the text of a file.</summary>
    public string ToSvg()
    {
        svg.Clear();
        labels.Clear();
        svg.Append(CultureInfo.InvariantCulture, $"<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {Width} {Height}\" ");
        svg.Append("font-family=\"sans-serif\" font-size=\"12\">\n");
        svg.Append(CultureInfo.InvariantCulture, $"<rect width=\"{Width}\" height=\"{Height}\" fill=\"white\"/>\n");
        Text(Left, 24, $"{scene.Name}: {scene.Summary}", "start", size: 15);
        DrawGrid();
        for (int i = 0; i < series.Count; ++i)
            DrawSeries(series[i].Engine, series[i].Points, series[i].Front, colours[i % colours.Length], i);
        svg.Append("</svg>\n");
        return svg.ToString();
    }

    void DrawGrid()
    {
        for (int power = Power(times.Least); power <= Power(times.Greatest); ++power)
        {
            double x = X(Math.Pow(10, power));
            Line(x, Top, x, Height - Bottom, "#dddddd");
            Text(x, Height - Bottom + 18, Decimal(power, 0), "middle");
        }
        for (int power = Power(errors.Least); power <= Power(errors.Greatest); ++power)
        {
            double y = Y(Math.Pow(10, power));
            Line(Left, y, Width - Right, y, "#dddddd");
            Text(Left - 8, y + 4, Decimal(power, scene.Unit == "%" ? 2 : 0), "end");
        }
        Text((Left + Width - Right) / 2, Height - 14, "milliseconds of a step", "middle");
        svg.Append(CultureInfo.InvariantCulture, $"<text transform=\"translate(18 {(Top + Height - Bottom) / 2}) rotate(-90)\" text-anchor=\"middle\">");
        svg.Append(CultureInfo.InvariantCulture, $"{SecurityElement.Escape($"{scene.ErrorName}, {scene.Unit}")}</text>\n");
    }

    void DrawSeries(string engine, List<TradePoint> points, List<TradePoint> front, string colour, int index)
    {
        foreach (TradePoint point in points.Where(IsShown))
        {
            bool isBest = front.Contains(point);
            svg.Append(CultureInfo.InvariantCulture, $"<circle cx=\"{X(point.Milliseconds):0.0}\" cy=\"{Y(point.Error):0.0}\" r=\"{(isBest ? 4 : 3)}\" ");
            svg.Append(CultureInfo.InvariantCulture, $"fill=\"{(isBest ? colour : "none")}\" stroke=\"{colour}\" stroke-opacity=\"{(isBest ? 1 : 0.4)}\">");
            string title = FormattableString.Invariant($"{engine} {point.Label}: {scene.Show(point.Error)}, {point.Milliseconds:0.0000} ms");
            svg.Append(CultureInfo.InvariantCulture, $"<title>{SecurityElement.Escape(title)}</title></circle>\n");
        }
        List<TradePoint> line = [.. front.Where(IsShown)];
        if (line.Count > 1)
        {
            string path = string.Join(' ', line.Select(point => FormattableString.Invariant($"{X(point.Milliseconds):0.0},{Y(point.Error):0.0}")));
            svg.Append(CultureInfo.InvariantCulture, $"<polyline points=\"{path}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"1.5\"/>\n");
        }
        foreach (TradePoint point in line)
            Label(X(point.Milliseconds), Y(point.Error), point.Label, colour, index % 2 == 0);
        Text(Left + index * 220, 44, $"● {engine}", "start", colour);
    }

    /// <summary>
    /// Writes a label where there is room for it, or not at all: fronts lie close to each other. The first engine's stand above its line if they can, the
    /// next one's below.
    /// </summary>
    void Label(double x, double y, string text, string colour, bool isAbove)
    {
        const int size = 10;
        const double letter = 5.2;
        double width = letter * text.Length, near = isAbove ? -6 : 14, far = isAbove ? 14 : -6;
        foreach ((double left, double bottom) in new[] { (x + 6, y + near), (x - 6 - width, y + near), (x + 6, y + far), (x - 6 - width, y + far) })
        {
            if (left < Left || left + width > Width || labels.Exists(other =>
                left < other.Right && other.Left < left + width && bottom - size < other.Bottom && other.Bottom - size < bottom))
                continue;
            labels.Add((left, left + width, bottom));
            Text(left, bottom, text, "start", colour, size);
            return;
        }
    }

    void Line(double x1, double y1, double x2, double y2, string colour) =>
        svg.Append(CultureInfo.InvariantCulture, $"<line x1=\"{x1:0.0}\" y1=\"{y1:0.0}\" x2=\"{x2:0.0}\" y2=\"{y2:0.0}\" stroke=\"{colour}\"/>\n");

    void Text(double x, double y, string text, string anchor, string colour = "#222222", int size = 12)
    {
        svg.Append(CultureInfo.InvariantCulture, $"<text x=\"{x:0.0}\" y=\"{y:0.0}\" text-anchor=\"{anchor}\" fill=\"{colour}\" font-size=\"{size}\">");
        svg.Append(CultureInfo.InvariantCulture, $"{SecurityElement.Escape(text)}</text>\n");
    }

    double X(double milliseconds) => Left + (Width - Left - Right) * Share(milliseconds, times);

    double Y(double error) => Height - Bottom - (Height - Top - Bottom) * Share(error, errors);

    /// <summary>What has a place where both axes are logarithms.</summary>
    static bool IsShown(TradePoint point) => double.IsFinite(point.Error) && point.Error > 0 && double.IsFinite(point.Milliseconds) && point.Milliseconds > 0;

    static double Share(double value, (double Least, double Greatest) range) => Math.Log(value / range.Least) / Math.Log(range.Greatest / range.Least);

    /// <summary>Whole powers of ten around some values.</summary>
    static (double Least, double Greatest) Range(IEnumerable<double> values)
    {
        double least = double.PositiveInfinity, greatest = 0;
        foreach (double value in values)
            (least, greatest) = (Math.Min(least, value), Math.Max(greatest, value));
        if (greatest == 0)
            return (1, 10);
        double low = Math.Floor(Math.Log10(least)), high = Math.Ceiling(Math.Log10(greatest));
        return (Math.Pow(10, low), Math.Pow(10, Math.Max(high, low + 1)));
    }

    static int Power(double value) => (int)Math.Round(Math.Log10(value));

    static string Decimal(int power, int shift) => Math.Pow(10, power + shift).ToString("0.#########", CultureInfo.InvariantCulture);
}
