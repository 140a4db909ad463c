using System;
using System.Linq;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities;
using BepuUtilities.Memory;
using DemoTests.Support;

namespace DemoTests.CollisionDetection;

/// <summary>Makes shapes of about one metre, and thin ones.</summary>
static class DepthSearchShapes
{
    public static DepthSearchShape Create(string kind, ref PairRandom random, float scale = 1)
    {
        switch (kind)
        {
            case "sphere":
                return Sphere(random.Next(0.2, 0.8) * scale);
            case "box":
                return Box(random.Next(0.4, 2) * scale, random.Next(0.4, 2) * scale, random.Next(0.4, 2) * scale);
            case "plate":
                return Box(random.Next(1, 2) * scale, 0.01f * scale, random.Next(1, 2) * scale);
            case "cylinder":
                return Cylinder(random.Next(0.2, 0.8) * scale, random.Next(0.2, 2) * scale);
            case "disc":
                return Cylinder(random.Next(0.5, 1) * scale, 0.01f * scale);
            case "rod":
                return Cylinder(0.02f * scale, 2 * scale);
            case "capsule":
                return Capsule(random.Next(0.1, 0.4) * scale, random.Next(0.4, 2) * scale);
            case "triangle":
                return Triangle(ref random, scale, default);
            case "far triangle":
                return Triangle(ref random, scale, random.NextDirection() * scale * 20);
            case "hull14":
                return Hull(ref random, 14, 0.7, new(1, random.Next(0.5, 1), random.Next(0.5, 1)), scale);
            case "hull32":
                return Hull(ref random, 32, 0.9, new(1, random.Next(0.5, 1), random.Next(0.5, 1)), scale);
            case "hull64":
                return Hull(ref random, 64, 0.95, new(1, random.Next(0.5, 1), random.Next(0.5, 1)), scale);
            case "sliver":
                return Hull(ref random, 14, 0.7, new(1, 0.01f, 1), scale);
            case "needle":
                return Hull(ref random, 14, 0.7, new(1, 0.02f, 0.02f), scale);
            default:
                throw new ArgumentException(kind, nameof(kind));
        }
    }

    public static DepthSearchShape Sphere(float radius) =>
        new DepthSearchShape.Typed<Sphere, SphereWide, SphereSupport>(new(radius), ConvexShape.Sphere(radius));

    public static DepthSearchShape Capsule(float radius, float length) =>
        new DepthSearchShape.Typed<Capsule, CapsuleWide, CapsuleSupport>(new(radius, length), ConvexShape.Capsule(radius, length));

    public static DepthSearchShape Box(float width, float height, float length) =>
        new DepthSearchShape.Typed<Box, BoxWide, BoxSupport>(new(width, height, length), ConvexShape.Box(width, height, length));

    public static DepthSearchShape Cylinder(float radius, float length) =>
        new DepthSearchShape.Typed<Cylinder, CylinderWide, CylinderSupport>(new(radius, length), ConvexShape.Cylinder(radius, length));

    public static DepthSearchShape Triangle(Vector3 a, Vector3 b, Vector3 c) =>
        new DepthSearchShape.Typed<Triangle, TriangleWide, TriangleSupport>(new(a, b, c), ConvexShape.Triangle(a, b, c));

    static DepthSearchShape Triangle(ref PairRandom random, float scale, Vector3 from)
    {
        while (true)
        {
            var a = random.NextDirection() * random.Next(0.3, 1);
            var b = random.NextDirection() * random.Next(0.3, 1);
            var c = random.NextDirection() * random.Next(0.3, 1);
            if (Vector3.Cross(b - a, c - a).Length() > 0.1f)
                return Triangle(a * scale + from, b * scale + from, c * scale + from);
        }
    }

    static DepthSearchShape Hull(ref PairRandom random, int count, double innermost, Vector3 stretch, float scale)
    {
        var points = new Vector3[count];
        var center = Vector3.Zero;
        for (int i = 0; i < count; ++i)
        {
            points[i] = random.NextDirection() * random.Next(innermost, 1) * stretch * scale;
            center += points[i] / count;
        }
        for (int i = 0; i < count; ++i)
            points[i] -= center;
        return Hull(points);
    }

    /// <summary>A hull around the origin with the corners of some points; what only faces need is left out.</summary>
    public static unsafe DepthSearchShape Hull(Vector3[] points)
    {
        var reference = ConvexShape.Hull(points);
        var vertices = reference.Edges.SelectMany(edge => new[] { edge.A, edge.B }).Distinct().Order()
            .Select(i => reference.Vertices[i]).ToArray();
        var bundleCount = (vertices.Length + Vector<float>.Count - 1) / Vector<float>.Count;
        var memory = GC.AllocateArray<byte>(HullHeader.ByteCount + bundleCount * sizeof(Vector3Wide), pinned: true);
        var address = (byte*)Unsafe.AsPointer(ref memory[0]);
        var header = (HullHeader*)address;
        header->VertexCount = vertices.Length;
        header->VertexBundleCount = bundleCount;
        header->InnerRadius = (float)reference.FaceOffsets.Min();
        header->OuterRadius = (float)vertices.Max(v => v.Length);
        for (int i = 0; i < bundleCount * Vector<float>.Count; ++i)
        {
            var v = vertices[i < vertices.Length ? i : 0];
            Lanes.Write(new Vector3((float)v.X, (float)v.Y, (float)v.Z), ref header->Points[i / Vector<float>.Count], i % Vector<float>.Count);
        }
        ConvexHull hull = default;
        hull.Data = new Buffer<byte>(address, memory.Length, 0);
        return new DepthSearchShape.Typed<ConvexHull, ConvexHullWide, ConvexHullSupport>(hull, reference, memory);
    }
}
