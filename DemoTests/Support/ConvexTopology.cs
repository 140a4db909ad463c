using System;
using System.Collections.Generic;
using System.Linq;
using Demos.References;

namespace DemoTests.Support;

/// <summary>Faces and edges of the hull of points, by trying the plane of every three of them.</summary>
sealed record ConvexTopology(Double3[] Vertices, Double3[] Normals, ConvexEdge[] Edges, (int, int, int)[] Triangles)
{
    // Relative to the size: the points are floats, so planes that are meant to be one differ by more, and stay several, which is as good.
    const double Tolerance = 1e-9;

    public static ConvexTopology Build(Double3[] points)
    {
        var all = Enumerate(points);
        // Points within the hull, or within a face, are no vertices: they would only cost time.
        var used = all.Edges.SelectMany(e => new[] { e.A, e.B }).Distinct().Order().ToArray();
        return used.Length == points.Length ? all : Enumerate([.. used.Select(i => points[i])]);
    }

    static ConvexTopology Enumerate(Double3[] points)
    {
        var size = points.Max(p => (p - points[0]).Length);
        var planes = new List<(Double3 Normal, bool[] IsOn)>();
        var triangles = new List<(int, int, int)>();
        for (int i = 0; i < points.Length; ++i)
        {
            for (int j = i + 1; j < points.Length; ++j)
            {
                for (int k = j + 1; k < points.Length; ++k)
                {
                    if (!IsFace(points, i, j, k, Tolerance * size, out var normal))
                        continue;
                    triangles.Add((i, j, k));
                    if (planes.Any(p => p.IsOn[i] && p.IsOn[j] && p.IsOn[k]))
                        continue;
                    var offset = Double3.Dot(normal, points[i]);
                    planes.Add((normal, [.. points.Select(p => Math.Abs(Double3.Dot(normal, p) - offset) <= Tolerance * size)]));
                }
            }
        }
        var edges = new List<ConvexEdge>();
        for (int a = 0; a < planes.Count; ++a)
        {
            for (int b = a + 1; b < planes.Count; ++b)
            {
                var shared = Enumerable.Range(0, points.Length).Where(i => planes[a].IsOn[i] && planes[b].IsOn[i]).ToArray();
                if (shared.Length < 2)
                    continue;
                // More than two where points lie within an edge: the outer ones are its ends.
                var direction = points[shared[1]] - points[shared[0]];
                edges.Add(new(shared.MinBy(i => Double3.Dot(points[i], direction)), shared.MaxBy(i => Double3.Dot(points[i], direction)), a, b));
            }
        }
        return new(points, [.. planes.Select(p => p.Normal)], [.. edges], [.. triangles]);
    }

    static bool IsFace(Double3[] points, int i, int j, int k, double tolerance, out Double3 normal)
    {
        var u = points[j] - points[i];
        var v = points[k] - points[i];
        normal = Double3.Cross(u, v);
        var length = normal.Length;
        if (length <= 1e-12 * u.Length * v.Length)
            return false;
        normal *= 1 / length;
        var offset = Double3.Dot(normal, points[i]);
        bool above = false, below = false;
        foreach (var p in points)
        {
            var height = Double3.Dot(normal, p) - offset;
            above |= height > tolerance;
            below |= height < -tolerance;
            if (above && below)
                return false;
        }
        if (above)
            normal = -normal;
        return true;
    }
}
