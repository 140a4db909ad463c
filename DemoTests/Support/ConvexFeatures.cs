using System;
using Demos.References;

namespace DemoTests.Support;

/// <summary>Distances of points, segments and triangles in double precision.</summary>
static class ConvexFeatures
{
    // Parts of an edge. The triangles of a face share borders that are no edges of the shape: what is nearest to one of these must not be
    // outside of both. A point beyond the border by this is farther than its height over the plane by a part of 1e-18 of a height as
    // large as the triangle.
    const double BorderTolerance = 1e-9;

    /// <summary>Distance of a point from a triangle where the nearest point is within it; infinite where that is beyond its border.</summary>
    public static double PointTriangle(Double3 p, Double3 a, Double3 b, Double3 c, out Double3 nearest)
    {
        var u = b - a;
        var v = c - a;
        var q = p - a;
        var normal = Double3.Cross(u, v);
        var squared = normal.LengthSquared;
        nearest = a;
        if (squared <= 1e-24 * u.LengthSquared * v.LengthSquared)
            return double.PositiveInfinity;
        var s = Double3.Dot(Double3.Cross(q, v), normal) / squared;
        var t = Double3.Dot(Double3.Cross(u, q), normal) / squared;
        if (s < -BorderTolerance || t < -BorderTolerance || s + t > 1 + BorderTolerance)
            return double.PositiveInfinity;
        nearest = a + u * s + v * t;
        return Math.Abs(Double3.Dot(q, normal)) / Math.Sqrt(squared);
    }

    public static double PointSegment(Double3 p, Double3 a, Double3 b, out Double3 nearest)
    {
        var d = b - a;
        var squared = d.LengthSquared;
        nearest = a + d * (squared > 0 ? Math.Clamp(Double3.Dot(p - a, d) / squared, 0, 1) : 0);
        return (p - nearest).Length;
    }

    /// <summary>Distance of two segments within which the nearest points lie; infinite where one of them is an end.</summary>
    public static double SegmentSegment(Double3 a, Double3 b, Double3 c, Double3 d, out Double3 onA, out Double3 onB)
    {
        var u = b - a;
        var v = d - c;
        var offset = c - a;
        var cross = Double3.Cross(u, v);
        var squared = cross.LengthSquared;
        (onA, onB) = (a, c);
        if (squared <= 1e-24 * u.LengthSquared * v.LengthSquared)
            return double.PositiveInfinity;
        var s = Double3.Dot(Double3.Cross(offset, v), cross) / squared;
        var t = Double3.Dot(Double3.Cross(offset, u), cross) / squared;
        if (s < 0 || s > 1 || t < 0 || t > 1)
            return double.PositiveInfinity;
        onA = a + u * s;
        onB = c + v * t;
        return (onB - onA).Length;
    }
}
