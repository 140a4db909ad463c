using System;
using System.Collections.Generic;
using System.Linq;

namespace DemoTests.CollisionDetection.References;

/// <summary>A point seen along the normal, and the height of a surface there.</summary>
readonly record struct FacePoint(double X, double Y, double Height)
{
    public static double Cross(FacePoint o, FacePoint a, FacePoint b) => (a.X - o.X) * (b.Y - o.Y) - (a.Y - o.Y) * (b.X - o.X);
}

/// <summary>
/// The overlap of two flat features seen along a normal, in double precision: one polygon clipped by the edges of the other in turn
/// (Sutherland and Hodgman 1974), and heights from the planes of three vertices.
/// </summary>
sealed class FaceReference
{
    readonly Double3 axisX, axisY, normal;
    readonly FacePoint[] a, b;

    /// <summary>Corners of the overlap; the height is the depth there.</summary>
    public IReadOnlyList<FacePoint> Corners { get; }

    /// <summary>Features by their vertices in one frame, counter-clockwise from outside; two vertices are a segment.</summary>
    public FaceReference(IEnumerable<Double3> a, IEnumerable<Double3> b, Double3 normal)
    {
        this.normal = normal;
        var helper = Math.Abs(normal.X) < 0.6 ? new Double3(1, 0, 0) : new Double3(0, 1, 0);
        axisX = Double3.Cross(helper, normal);
        axisX *= 1 / axisX.Length;
        axisY = Double3.Cross(normal, axisX);
        // Seen along the normal B runs counter-clockwise and A, which looks the other way, clockwise.
        this.a = [.. a.Reverse().Select(Project)];
        this.b = [.. b.Select(Project)];
        Corners = [.. FindCorners()];
    }

    public FacePoint Project(Double3 v) => new(Double3.Dot(v, axisX), Double3.Dot(v, axisY), Double3.Dot(v, normal));

    public Double3 Unproject(double x, double y, double height) => axisX * x + axisY * y + normal * height;

    /// <summary>Greatest depth, and a place on A's surface where it is.</summary>
    public (double Depth, Double3 PointOnA) FindDeepest()
    {
        var deepest = Corners.MaxBy(corner => corner.Height);
        return (deepest.Height, Unproject(deepest.X, deepest.Y, HeightAt(a, deepest.X, deepest.Y)));
    }

    public double DepthAt(double x, double y) => HeightAt(b, x, y) - HeightAt(a, x, y);

    public double HeightOfA(double x, double y) => HeightAt(a, x, y);

    public double HeightOfB(double x, double y) => HeightAt(b, x, y);

    /// <summary>How far a point is outside of either feature.</summary>
    public double Outside(double x, double y) => Math.Max(Outside(a, x, y), Outside(b, x, y));

    public double Area => AreaOf(Corners);

    public static double AreaOf(IReadOnlyList<FacePoint> polygon)
    {
        double area = 0;
        for (int i = 1; i + 1 < polygon.Count; ++i)
            area += FacePoint.Cross(polygon[0], polygon[i], polygon[i + 1]) * 0.5;
        return Math.Abs(area);
    }

    /// <summary>Area of the convex hull of a few points.</summary>
    public static double HullArea(IReadOnlyList<FacePoint> points)
    {
        // All triangles: of up to four points the hull is the largest quadrilateral, half the sum of their four triangles.
        if (points.Count < 3)
            return 0;
        if (points.Count == 3)
            return Math.Abs(FacePoint.Cross(points[0], points[1], points[2])) * 0.5;
        double sum = 0, most = 0;
        for (int i = 0; i < 4; ++i)
        {
            var triangle = Math.Abs(FacePoint.Cross(points[(i + 1) % 4], points[(i + 2) % 4], points[(i + 3) % 4])) * 0.5;
            sum += triangle;
            most = Math.Max(most, triangle);
        }
        return Math.Max(most, sum * 0.5);
    }

    IEnumerable<FacePoint> FindCorners()
    {
        // A segment is clipped by the polygon, whichever it is. The corners carry the height of what was clipped, then the depth.
        var clipsB = b.Length == 2 && a.Length > 2;
        var subject = (clipsB ? b : a).ToList();
        var clipper = clipsB ? a : b;
        for (int i = 0; i < clipper.Length; ++i)
            subject = Clip(subject, clipper[i], clipper[(i + 1) % clipper.Length]);
        return subject.Select(corner => new FacePoint(corner.X, corner.Y,
            clipsB ? corner.Height - HeightAt(a, corner.X, corner.Y) : HeightAt(b, corner.X, corner.Y) - corner.Height));
    }

    static List<FacePoint> Clip(List<FacePoint> polygon, FacePoint from, FacePoint to)
    {
        List<FacePoint> result = [];
        for (int i = 0; i < polygon.Count; ++i)
        {
            var p = polygon[i];
            var q = polygon[(i + 1) % polygon.Count];
            double distanceP = FacePoint.Cross(from, to, p), distanceQ = FacePoint.Cross(from, to, q);
            if (distanceP >= 0)
                result.Add(p);
            if (distanceP * distanceQ < 0)
            {
                var t = distanceP / (distanceP - distanceQ);
                result.Add(new(p.X + (q.X - p.X) * t, p.Y + (q.Y - p.Y) * t, p.Height + (q.Height - p.Height) * t));
            }
        }
        return result;
    }

    static double HeightAt(FacePoint[] feature, double x, double y)
    {
        var p = feature[0];
        if (feature.Length == 2)
        {
            double ex = feature[1].X - p.X, ey = feature[1].Y - p.Y;
            return p.Height + (feature[1].Height - p.Height) * ((x - p.X) * ex + (y - p.Y) * ey) / (ex * ex + ey * ey);
        }
        // The triangle of the first vertex, the one farthest from it, and the one farthest from the line of both.
        var q = feature.MaxBy(v => (v.X - p.X) * (v.X - p.X) + (v.Y - p.Y) * (v.Y - p.Y));
        var r = feature.MaxBy(v => Math.Abs(FacePoint.Cross(p, q, v)));
        var place = new FacePoint(x, y, 0);
        var all = FacePoint.Cross(p, q, r);
        return p.Height + (q.Height - p.Height) * FacePoint.Cross(p, place, r) / all + (r.Height - p.Height) * FacePoint.Cross(p, q, place) / all;
    }

    static double Outside(FacePoint[] feature, double x, double y)
    {
        double outside = 0;
        var place = new FacePoint(x, y, 0);
        for (int i = 0; i < feature.Length; ++i)
        {
            var p = feature[i];
            var q = feature[(i + 1) % feature.Length];
            double ex = q.X - p.X, ey = q.Y - p.Y;
            var length = Math.Sqrt(ex * ex + ey * ey);
            if (length == 0)
                continue;
            outside = Math.Max(outside, -FacePoint.Cross(p, q, place) / length);
            if (feature.Length == 2)
                outside = Math.Max(outside, ((x - q.X) * ex + (y - q.Y) * ey) / length);
        }
        return outside;
    }
}
