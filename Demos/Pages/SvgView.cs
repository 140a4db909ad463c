using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using System.Numerics;
using System.Security;
using System.Text;

namespace Demos.Pages;

/// <summary>A picture in space, seen from a fixed direction without perspective: what is drawn later is in front.</summary>
sealed class SvgView(int width, int height, Vector3 middle, float pixelsPerMetre)
{
    // From the right and above: x to the right, y up, z towards the viewer.
    static readonly Vector3 towardsViewer = Vector3.Normalize(new(0.35f, 0.4f, 0.85f));
    static readonly Vector3 right = Vector3.Normalize(Vector3.Cross(Vector3.UnitY, towardsViewer));
    static readonly Vector3 up = Vector3.Cross(towardsViewer, right);

    readonly StringBuilder svg = new();
    readonly List<Vector2> labels = [];

    /// <summary>How near a point is to the viewer.</summary>
    public static float Nearness(Vector3 point) => Vector3.Dot(point, towardsViewer);

    /// <summary>A box along the axes of the world: the three faces that are seen.</summary>
    public void Box(Vector3 centre, Vector3 size, string colour)
    {
        var half = size / 2;
        Vector3 x = new(half.X, 0, 0), y = new(0, half.Y, 0), z = new(0, 0, half.Z);
        Face(centre + z, x, y, 0.25);
        Face(centre + y, x, z, 0.12);
        Face(centre + x, z, y, 0.4);

        void Face(Vector3 c, Vector3 u, Vector3 v, double opacity) => svg.Append(CultureInfo.InvariantCulture,
            $"<polygon points=\"{Points([c - u - v, c + u - v, c + u + v, c - u + v])}\" fill=\"{colour}\" fill-opacity=\"{opacity}\" stroke=\"{colour}\"/>\n");
    }

    /// <summary>A line through points.</summary>
    public void Line(IEnumerable<Vector3> points, string colour, bool isDashed = false) => svg.Append(CultureInfo.InvariantCulture,
        $"<polyline points=\"{Points(points)}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"2\"{(isDashed ? " stroke-dasharray=\"5 4\"" : "")}/>\n");

    /// <summary>An arrow.</summary>
    public void Arrow(Vector3 from, Vector3 to, string colour, bool isDashed = false)
    {
        Line([from, to], colour, isDashed);
        Head(Project(from), Project(to), colour);
    }

    /// <summary>An arrow that turns most of the way around an axis.</summary>
    public void Turn(Vector3 centre, Vector3 axis, float radius, string colour)
    {
        const int Count = 24;
        var u = Vector3.Normalize(Vector3.Cross(axis, MathF.Abs(axis.X) < 0.9f ? Vector3.UnitX : Vector3.UnitY));
        var v = Vector3.Cross(axis, u);
        Vector3[] points = [.. Enumerable.Range(0, Count + 1).Select(i => i * 5.2f / Count)
            .Select(angle => centre + radius * (u * MathF.Cos(angle) + v * MathF.Sin(angle)))];
        Line(points, colour);
        Head(Project(points[^2]), Project(points[^1]), colour);
    }

    /// <summary>A dot.</summary>
    public void Dot(Vector3 point, string colour)
    {
        var at = Project(point);
        svg.Append(CultureInfo.InvariantCulture, $"<circle cx=\"{at.X:0.0}\" cy=\"{at.Y:0.0}\" r=\"4\" fill=\"{colour}\"/>\n");
    }

    /// <summary>A text beside a point; further down where there is one already.</summary>
    public void Label(Vector3 point, string text, string colour)
    {
        var at = Project(point) + new Vector2(6, -4);
        while (labels.Any(other => MathF.Abs(other.Y - at.Y) < 13 && MathF.Abs(other.X - at.X) < 120))
            at.Y += 13;
        labels.Add(at);
        Text(at, text, colour);
    }

    /// <summary>A line of text at the foot.</summary>
    public void Caption(string text) => Text(new(10, height - 10), text, "#333333");

    /// <summary>The picture as the text of a file.</summary>
    public string ToSvg() =>
        $"<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" font-family=\"sans-serif\" font-size=\"12\">\n" +
        $"<rect width=\"{width}\" height=\"{height}\" fill=\"white\"/>\n{svg}</svg>\n";

    void Text(Vector2 at, string text, string colour) => svg.Append(CultureInfo.InvariantCulture,
        $"<text x=\"{at.X:0.0}\" y=\"{at.Y:0.0}\" fill=\"{colour}\">{SecurityElement.Escape(text)}</text>\n");

    void Head(Vector2 from, Vector2 tip, string colour)
    {
        var along = tip - from;
        // Seen along its line it is a point, which has no head.
        if (along.Length() < 0.5f)
            return;
        along = Vector2.Normalize(along);
        Vector2 side = new(-along.Y, along.X);
        Vector2 back = tip - 10 * along;
        svg.Append(CultureInfo.InvariantCulture, $"<polygon points=\"{Pair(tip)} {Pair(back + 4 * side)} {Pair(back - 4 * side)}\" fill=\"{colour}\"/>\n");
    }

    Vector2 Project(Vector3 point)
    {
        var d = point - middle;
        return new(width / 2f + pixelsPerMetre * Vector3.Dot(d, right), height / 2f - pixelsPerMetre * Vector3.Dot(d, up));
    }

    string Points(IEnumerable<Vector3> points) => string.Join(' ', points.Select(point => Pair(Project(point))));

    static string Pair(Vector2 point) => string.Create(CultureInfo.InvariantCulture, $"{point.X:0.0},{point.Y:0.0}");
}
