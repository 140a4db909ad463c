using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using Demos.References;

namespace DemoTests.Support;

/// <summary>Kinds of convex shapes, by the library's type ids.</summary>
public enum ConvexKind
{
    Sphere,
    Capsule,
    Box,
    Triangle,
    Cylinder,
    Hull,
}

/// <summary>An edge of a polytope by its vertices, and the faces beside it: -1 where there are none.</summary>
public readonly record struct ConvexEdge(int A, int B, int FaceA, int FaceB);

/// <summary>
/// A convex shape in double precision, for references: a polytope or a cylinder, and a radius around it. Shares no code with the library.
/// </summary>
public sealed class ConvexShape
{
    ConvexShape(ConvexKind kind) => Kind = kind;

    public ConvexKind Kind { get; }

    /// <summary>Radius of spheres, capsules and cylinders.</summary>
    public double Radius { get; private init; }

    /// <summary>Half the length of the segment of a capsule, or of a cylinder, along Y.</summary>
    public double HalfLength { get; private init; }

    /// <summary>Half the sizes of a box.</summary>
    public Double3 HalfExtents { get; private init; }

    /// <summary>What the library's shape is made of: corners of a triangle, points of a hull.</summary>
    public Vector3[] Points { get; private init; } = [];

    /// <summary>What is taken off the points of a hull: the library moves them to the centre of their volume.</summary>
    public Double3 Center { get; private init; }

    /// <summary>Vertices of the core; none for a cylinder.</summary>
    public Double3[] Vertices { get; private set; } = [];

    public Double3[] FaceNormals { get; private set; } = [];

    public double[] FaceOffsets { get; private set; } = [];

    public ConvexEdge[] Edges { get; private set; } = [];

    /// <summary>Triangles that together cover the surface, overlapping where a face has more corners; no order of corners.</summary>
    public (int A, int B, int C)[] Triangles { get; private set; } = [];

    /// <summary>Middle of the vertices: what generators put beside each other.</summary>
    public Double3 Middle { get; private set; }

    /// <summary>Distance from the middle to the farthest point.</summary>
    public double OuterRadius { get; private set; }

    public bool IsCylinder => Kind == ConvexKind.Cylinder;

    /// <summary>Radius around the core: the whole of a sphere, of a capsule.</summary>
    public double Rounding => Kind is ConvexKind.Sphere or ConvexKind.Capsule ? Radius : 0;

    public static ConvexShape Sphere(float radius) =>
        new ConvexShape(ConvexKind.Sphere) { Radius = radius, Vertices = [Double3.Zero] }.Complete();

    /// <summary>A capsule by the whole length of its segment, as in the library.</summary>
    public static ConvexShape Capsule(float radius, float length)
    {
        var half = length * 0.5f;
        var shape = new ConvexShape(ConvexKind.Capsule) { Radius = radius, HalfLength = half };
        shape.Vertices = [new(0, half, 0), new(0, -half, 0)];
        shape.Edges = [new(0, 1, -1, -1)];
        return shape.Complete();
    }

    /// <summary>A box by its whole sizes, as in the library.</summary>
    public static ConvexShape Box(float width, float height, float length)
    {
        var half = new Double3(width * 0.5f, height * 0.5f, length * 0.5f);
        var shape = new ConvexShape(ConvexKind.Box) { HalfExtents = half };
        shape.Vertices = [.. Enumerable.Range(0, 8).Select(i => Double3.Scale(half, new((i & 1) * 2 - 1, (i & 2) - 1, (i & 4) / 2 - 1)))];
        // Faces in pairs by axis, the negative one first.
        shape.FaceNormals = [new(-1, 0, 0), new(1, 0, 0), new(0, -1, 0), new(0, 1, 0), new(0, 0, -1), new(0, 0, 1)];
        var edges = new List<ConvexEdge>();
        var triangles = new List<(int, int, int)>();
        for (int axis = 0; axis < 3; ++axis)
        {
            int u = (axis + 1) % 3, v = (axis + 2) % 3;
            for (int side = 0; side < 4; ++side)
            {
                var start = (side & 1) << u | side >> 1 << v;
                edges.Add(new(start, start | 1 << axis, u * 2 + (side & 1), v * 2 + (side >> 1)));
            }
            for (int side = 0; side < 2; ++side)
            {
                var corner = side << axis;
                triangles.Add((corner, corner | 1 << u, corner | 1 << u | 1 << v));
                triangles.Add((corner, corner | 1 << v, corner | 1 << u | 1 << v));
            }
        }
        shape.Edges = [.. edges];
        shape.Triangles = [.. triangles];
        return shape.Complete();
    }

    public static ConvexShape Triangle(Vector3 a, Vector3 b, Vector3 c)
    {
        var shape = new ConvexShape(ConvexKind.Triangle) { Points = [a, b, c] };
        shape.Vertices = [a, b, c];
        var normal = Double3.Cross(shape.Vertices[1] - shape.Vertices[0], shape.Vertices[2] - shape.Vertices[0]);
        var length = normal.Length;
        if (length > 0)
            shape.FaceNormals = [normal * (1 / length), normal * (-1 / length)];
        shape.Edges = [.. Enumerable.Range(0, 3).Select(i => new ConvexEdge(i, (i + 1) % 3, length > 0 ? 0 : -1, length > 0 ? 1 : -1))];
        shape.Triangles = [(0, 1, 2)];
        return shape.Complete();
    }

    /// <summary>A cylinder around Y by its whole length, as in the library.</summary>
    public static ConvexShape Cylinder(float radius, float length) =>
        new ConvexShape(ConvexKind.Cylinder) { Radius = radius, HalfLength = length * 0.5f }.Complete();

    /// <summary>Hull of points, which need not all be corners of it, less a centre.</summary>
    public static ConvexShape Hull(IReadOnlyList<Vector3> points, Vector3 center = default)
    {
        var shape = new ConvexShape(ConvexKind.Hull) { Points = [.. points], Center = center };
        var topology = ConvexTopology.Build([.. points.Distinct().Select(p => p - (Double3)center)]);
        shape.Vertices = topology.Vertices;
        shape.FaceNormals = topology.Normals;
        shape.Edges = topology.Edges;
        shape.Triangles = topology.Triangles;
        return shape.Complete();
    }

    /// <summary>Farthest reach of the core, without its radius, along a direction of any length.</summary>
    public double CoreExtent(Double3 d)
    {
        if (IsCylinder)
            return Radius * Math.Sqrt(d.X * d.X + d.Z * d.Z) + HalfLength * Math.Abs(d.Y);
        if (Kind == ConvexKind.Box)
            return HalfExtents.X * Math.Abs(d.X) + HalfExtents.Y * Math.Abs(d.Y) + HalfExtents.Z * Math.Abs(d.Z);
        var extent = double.MinValue;
        foreach (var v in Vertices)
        {
            var reach = v.X * d.X + v.Y * d.Y + v.Z * d.Z;
            if (reach > extent)
                extent = reach;
        }
        return extent;
    }

    /// <summary>Distance of a point in the shape's frame from the surface, negative inside. A triangle has no inside.</summary>
    public double SignedDistance(Double3 p)
    {
        switch (Kind)
        {
            case ConvexKind.Sphere:
                return p.Length - Radius;
            case ConvexKind.Capsule:
                return (p with { Y = p.Y - Math.Clamp(p.Y, -HalfLength, HalfLength) }).Length - Radius;
            case ConvexKind.Box:
                return Beyond(Math.Abs(p.X) - HalfExtents.X, Math.Abs(p.Y) - HalfExtents.Y, Math.Abs(p.Z) - HalfExtents.Z);
            case ConvexKind.Cylinder:
                return Beyond(Math.Sqrt(p.X * p.X + p.Z * p.Z) - Radius, Math.Abs(p.Y) - HalfLength, double.MinValue);
        }
        if (Kind == ConvexKind.Hull)
        {
            var inside = double.MinValue;
            for (int i = 0; i < FaceNormals.Length; ++i)
                inside = Math.Max(inside, Double3.Dot(FaceNormals[i], p) - FaceOffsets[i]);
            if (inside <= 0)
                return inside;
        }
        var distance = double.MaxValue;
        foreach (var (a, b, c) in Triangles)
            distance = Math.Min(distance, ConvexFeatures.PointTriangle(p, Vertices[a], Vertices[b], Vertices[c], out _));
        foreach (var edge in Edges)
            distance = Math.Min(distance, ConvexFeatures.PointSegment(p, Vertices[edge.A], Vertices[edge.B], out _));
        return distance;
    }

    /// <summary>Whether a point in the shape's frame lies in the shape, or no farther from it than a tolerance.</summary>
    public bool InsideWithin(Double3 point, double tolerance) => SignedDistance(point) <= tolerance;

    static double Beyond(double x, double y, double z)
    {
        var outside = new Double3(Math.Max(x, 0), Math.Max(y, 0), Math.Max(z, 0)).Length;
        return outside > 0 ? outside : Math.Max(x, Math.Max(y, z));
    }

    ConvexShape Complete()
    {
        FaceOffsets = [.. FaceNormals.Select(n => Vertices.Max(v => Double3.Dot(n, v)))];
        if (Vertices.Length > 0)
            Middle = Vertices.Aggregate((a, b) => a + b) * (1.0 / Vertices.Length);
        OuterRadius = IsCylinder ? Math.Sqrt(Radius * Radius + HalfLength * HalfLength) : Vertices.Max(v => (v - Middle).Length) + Rounding;
        return this;
    }
}
