using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics.Collidables;
using Demos.References;

namespace DemoTests.Collidables;

/// <summary>A hull read out into double precision, and all that must be true of it.</summary>
sealed class HullChecker
{
    public List<Double3> Vertices { get; } = [];

    public List<int[]> Faces { get; } = [];

    public List<(Double3 Normal, double Offset)> Planes { get; } = [];

    /// <summary>Longest side of the vertices' box.</summary>
    public double Size { get; }

    public double Volume { get; private set; }

    public Double3 Centroid { get; private set; }

    /// <summary>Integrals of x x^T over the inside: xx, yy, zz, xy, xz, yz.</summary>
    public double[] SecondMoments { get; } = new double[6];

    public HullChecker(in ConvexHull hull)
    {
        for (int i = 0; i < hull.VertexCount; ++i)
        {
            hull.GetPoint(i, out var point);
            Vertices.Add(point);
        }
        for (int i = 0; i < hull.FaceCount; ++i)
        {
            hull.GetVertexIndicesForFace(i, out var face);
            var numbers = new int[face.Length];
            for (int j = 0; j < face.Length; ++j)
                numbers[j] = face[j].BundleIndex * Vector<float>.Count + face[j].InnerIndex;
            Faces.Add(numbers);
            ref var plane = ref hull.BoundingPlanes[i / Vector<float>.Count];
            var lane = i % Vector<float>.Count;
            Planes.Add((new(plane.Normal.X[lane], plane.Normal.Y[lane], plane.Normal.Z[lane]), plane.Offset[lane]));
        }
        Size = Math.Max(Vertices.Max(v => v.X) - Vertices.Min(v => v.X),
            Math.Max(Vertices.Max(v => v.Y) - Vertices.Min(v => v.Y), Vertices.Max(v => v.Z) - Vertices.Min(v => v.Z)));
        Integrate();
    }

    /// <summary>What is wrong with the hull; null when nothing is.</summary>
    public string? FindFault(double tolerance = 1e-4)
    {
        if (Vertices.Distinct().Count() != Vertices.Count)
            return "vertices coincide";
        Dictionary<(int, int), int> edges = [];
        var faceCounts = new int[Vertices.Count];
        for (int i = 0; i < Faces.Count; ++i)
        {
            var face = Faces[i];
            if (face.Length < 3)
                return $"face {i} has {face.Length} vertices";
            if (face[0] != face.Min())
                return $"face {i} does not begin with its lowest vertex";
            for (int j = 0; j < face.Length; ++j)
            {
                ++faceCounts[face[j]];
                if (!edges.TryAdd((face[j], face[(j + 1) % face.Length]), i))
                    return $"an edge of face {i} is there twice";
            }
        }
        foreach (var (a, b) in edges.Keys)
        {
            if (!edges.ContainsKey((b, a)))
                return $"edge {a} {b} is open";
        }
        if (faceCounts.Any(count => count < 2))
            return "a vertex has fewer than two faces";
        if (Vertices.Count - edges.Count / 2 + Faces.Count != 2)
            return $"V {Vertices.Count} - E {edges.Count / 2} + F {Faces.Count} is not 2";
        return FindShapeFault(tolerance * Size);
    }

    string? FindShapeFault(double tolerance)
    {
        for (int i = 0; i < Faces.Count; ++i)
        {
            var (normal, offset) = Planes[i];
            if (Math.Abs(normal.Length - 1) > 1e-6)
                return $"normal {i} is {normal.Length} long";
            if (!(offset > 0))
                return $"the centre is outside of face {i}";
            var face = Faces[i];
            for (int j = 0; j < face.Length; ++j)
            {
                Double3 before = Vertices[face[(j + face.Length - 1) % face.Length]], corner = Vertices[face[j]];
                var after = Vertices[face[(j + 1) % face.Length]];
                var height = Double3.Dot(normal, corner) - offset;
                if (height > 1e-7 * Size || height < -tolerance)
                    return $"corner {j} of {face.Length} of face {i} is {height / Size:e2} sizes over its plane";
                var line = after - before;
                if (Double3.Dot(Double3.Cross(line, corner - before), normal) > tolerance * line.Length)
                    return $"face {i} is not convex";
            }
        }
        // Large hulls: every vertex with some of the planes.
        var step = Math.Max(1, (int)((long)Vertices.Count * Planes.Count / 10_000_000)) | 1;
        for (int i = 0; i < Vertices.Count; ++i)
        {
            for (int j = i % step; j < Planes.Count; j += step)
            {
                var height = Double3.Dot(Planes[j].Normal, Vertices[i]) - Planes[j].Offset;
                if (height > tolerance)
                    return $"vertex {i} is {height / Size:e2} sizes over plane {j}";
            }
        }
        // Rounding the vertices to floats moves the centre of a thin hull by more than that: it changes how thick it is, here and there.
        var thickness = Planes.Min(plane => plane.Offset) / Size;
        return Centroid.Length > (1e-7 + 1e-7 / thickness) * Size ? $"the centre of mass is {Centroid.Length / Size:e2} sizes off" : null;
    }

    /// <summary>How far points are outside of the farthest plane, at most, in sizes.</summary>
    public double FarthestOutside(ReadOnlySpan<Vector3> points, Vector3 center)
    {
        var step = Math.Max(1, (int)((long)points.Length * Planes.Count / 20_000_000)) | 1;
        var farthest = double.MinValue;
        for (int i = 0; i < points.Length; ++i)
        {
            var point = (Double3)points[i] - center;
            for (int j = i % step; j < Planes.Count; j += step)
                farthest = Math.Max(farthest, Double3.Dot(Planes[j].Normal, point) - Planes[j].Offset);
        }
        return farthest / Size;
    }

    void Integrate()
    {
        // Divergence theorem by tetrahedra from vertex 0, to be about something else than the shape does.
        var origin = Vertices[0];
        var first = Double3.Zero;
        foreach (var face in Faces)
        {
            for (int i = 2; i < face.Length; ++i)
            {
                Double3 a = Vertices[face[0]] - origin, b = Vertices[face[i - 1]] - origin, c = Vertices[face[i]] - origin;
                var volume = Double3.Dot(a, Double3.Cross(b, c)) / 6;
                Volume += volume;
                first += (a + b + c) * (volume / 4);
            }
        }
        Centroid = origin + first * (1 / Volume);
        foreach (var face in Faces)
        {
            for (int i = 2; i < face.Length; ++i)
            {
                Double3[] corners = [Double3.Zero, Vertices[face[0]] - Centroid, Vertices[face[i - 1]] - Centroid, Vertices[face[i]] - Centroid];
                var volume = Double3.Dot(corners[1], Double3.Cross(corners[2], corners[3])) / 6;
                // Exact for polynomials of degree two: four points inside of a tetrahedron (Hammer and Stroud, 1956).
                foreach (var corner in corners)
                {
                    const double near = 0.58541019662496852, far = 0.1381966011250105;
                    var p = (corners[0] + corners[1] + corners[2] + corners[3]) * far + corner * (near - far);
                    var weight = volume / 4;
                    SecondMoments[0] += weight * p.X * p.X;
                    SecondMoments[1] += weight * p.Y * p.Y;
                    SecondMoments[2] += weight * p.Z * p.Z;
                    SecondMoments[3] += weight * p.X * p.Y;
                    SecondMoments[4] += weight * p.X * p.Z;
                    SecondMoments[5] += weight * p.Y * p.Z;
                }
            }
        }
    }
}
