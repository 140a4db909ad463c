using System;
using System.Collections.Generic;
using System.Linq;
using Demos.References;

namespace DemoTests.Support;

/// <summary>
/// Depth of two polytopes (points and segments are such, too): all normals of faces and of pairs of edges, and when no such normal shows an
/// overlap, the distance of all pairs of features.
/// </summary>
sealed class ConvexPolytopes : IConvexSearch
{
    // Products of unit vectors: wide enough that rounding never loses a face of the difference.
    const double LooseTolerance = 1e-9;

    readonly ConvexShape a;
    readonly ConvexShape b;
    readonly ConvexRotation rotation;
    // Directions from A to B, with the extent of the difference along each.
    readonly List<(Double3 Direction, double Extent)> axes = [];
    readonly Double3[] verticesB;
    readonly double size;

    /// <param name="a">First shape.</param>
    /// <param name="b">Second shape.</param>
    /// <param name="rotation">Axes of B in A's frame.</param>
    /// <param name="exhaustive">Whether to try all pairs of edges, also those that cannot span a face of the difference.</param>
    public ConvexPolytopes(ConvexShape a, ConvexShape b, ConvexRotation rotation, bool exhaustive = false)
    {
        this.a = a;
        this.b = b;
        this.rotation = rotation;
        verticesB = [.. b.Vertices.Select(rotation.Rotate)];
        size = a.OuterRadius + b.OuterRadius;
        foreach (var n in a.FaceNormals)
            AddAxis(n);
        var facesB = b.FaceNormals.Select(n => -rotation.Rotate(n)).ToArray();
        foreach (var n in facesB)
            AddAxis(n);
        var edgesB = b.Edges.Select(e => verticesB[e.B] - verticesB[e.A]).ToArray();
        var prune = !exhaustive && a.Vertices.Length > 3 && b.Vertices.Length > 3;
        foreach (var edgeA in a.Edges)
        {
            var u = a.Vertices[edgeA.B] - a.Vertices[edgeA.A];
            Double3 faceA0 = default, faceA1 = default, crossA = default;
            if (prune)
            {
                faceA0 = a.FaceNormals[edgeA.FaceA];
                faceA1 = a.FaceNormals[edgeA.FaceB];
                crossA = Double3.Cross(faceA1, faceA0);
            }
            for (int i = 0; i < edgesB.Length; ++i)
            {
                if (prune && !ArcsCross(faceA0, faceA1, crossA, facesB[b.Edges[i].FaceA], facesB[b.Edges[i].FaceB]))
                    continue;
                var cross = Double3.Cross(u, edgesB[i]);
                var squared = cross.LengthSquared;
                if (squared <= 1e-24 * u.LengthSquared * edgesB[i].LengthSquared)
                    continue;
                var direction = cross * (1 / Math.Sqrt(squared));
                AddAxis(direction);
                AddAxis(-direction);
            }
        }
    }

    public (double Depth, double AxisDepth) Find(Double3 offset, ConvexCandidates found)
    {
        var axisDepth = double.MaxValue;
        foreach (var (direction, extent) in axes)
        {
            var depth = extent - Double3.Dot(direction, offset);
            found.Add(depth, direction);
            axisDepth = Math.Min(axisDepth, depth);
        }
        // Within rounding of nothing: the difference is flat, or touches, and only the distance tells whether the cores are apart.
        var tiny = 1e-12 * size;
        if (axes.Count > 0 && axisDepth > tiny)
            return (axisDepth, axisDepth);
        var distance = Distance(offset, out var separation);
        if (distance > tiny)
        {
            found.Add(-distance, separation * (1 / distance));
            return (-distance, axes.Count == 0 ? -distance : axisDepth);
        }
        // Points and segments that meet have no axis of their own when they are parallel: any across them will do.
        if (axes.Count == 0)
            found.Add(0, AnyAcross());
        return (0, 0);
    }

    /// <summary>Distance of the cores by all pairs of features, and the way from A to B.</summary>
    double Distance(Double3 offset, out Double3 separation)
    {
        var moved = new Double3[verticesB.Length];
        for (int i = 0; i < moved.Length; ++i)
            moved[i] = verticesB[i] + offset;
        var best = double.MaxValue;
        Double3 way = default;
        foreach (var p in a.Vertices)
        {
            foreach (var q in moved)
                Try((q - p).Length, p, q);
            foreach (var (i, j, k) in b.Triangles)
                Try(ConvexFeatures.PointTriangle(p, moved[i], moved[j], moved[k], out var q), p, q);
            foreach (var edge in b.Edges)
                Try(ConvexFeatures.PointSegment(p, moved[edge.A], moved[edge.B], out var q), p, q);
        }
        foreach (var q in moved)
        {
            foreach (var (i, j, k) in a.Triangles)
                Try(ConvexFeatures.PointTriangle(q, a.Vertices[i], a.Vertices[j], a.Vertices[k], out var p), p, q);
            foreach (var edge in a.Edges)
                Try(ConvexFeatures.PointSegment(q, a.Vertices[edge.A], a.Vertices[edge.B], out var p), p, q);
        }
        foreach (var e in a.Edges)
        {
            foreach (var f in b.Edges)
                Try(ConvexFeatures.SegmentSegment(a.Vertices[e.A], a.Vertices[e.B], moved[f.A], moved[f.B], out var p, out var q), p, q);
        }
        separation = way;
        return best;

        void Try(double distance, Double3 p, Double3 q)
        {
            if (distance < best)
                (best, way) = (distance, q - p);
        }
    }

    Double3 AnyAcross()
    {
        var along = a.Edges.Length > 0 ? a.Vertices[1] - a.Vertices[0] : b.Edges.Length > 0 ? verticesB[1] - verticesB[0] : new(1, 0, 0);
        var least = Math.Abs(along.X) < Math.Abs(along.Y) ? new Double3(1, 0, 0) : new Double3(0, 1, 0);
        var across = Double3.Cross(along, least);
        return across.Length > 0 ? across * (1 / across.Length) : least;
    }

    /// <summary>Whether the arc of directions in which an edge of A is the farthest meets that of an edge of B.</summary>
    static bool ArcsCross(Double3 a, Double3 b, Double3 crossA, Double3 c, Double3 d)
    {
        var cba = Double3.Dot(c, crossA);
        var dba = Double3.Dot(d, crossA);
        if (cba * dba > LooseTolerance)
            return false;
        var crossB = Double3.Cross(d, c);
        var adc = Double3.Dot(a, crossB);
        var bdc = Double3.Dot(b, crossB);
        return adc * bdc <= LooseTolerance && cba * bdc >= -LooseTolerance;
    }

    void AddAxis(Double3 direction) => axes.Add((direction, a.CoreExtent(direction) + b.CoreExtent(rotation.RotateBack(-direction))));
}
