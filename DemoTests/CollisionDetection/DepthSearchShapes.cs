using System;
using System.Linq;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;
using DemoTests.Support;

namespace DemoTests.CollisionDetection;

/// <summary>The library's shapes for those of the reference.</summary>
static class DepthSearchShapes
{
    /// <summary>Makes the library's shape. A hull is then described by what the library made of its points.</summary>
    /// <param name="shape">Shape of the reference.</param>
    /// <param name="pool">Memory of hulls, which the pool's owner returns.</param>
    public static DepthSearchShape Create(ConvexShape shape, BufferPool pool)
    {
        var half = shape.HalfExtents;
        float radius = (float)shape.Radius, length = (float)(2 * shape.HalfLength);
        return shape.Kind switch
        {
            ConvexKind.Sphere => new DepthSearchShape.Typed<Sphere, SphereWide, SphereSupport>(new(radius), shape),
            ConvexKind.Capsule => new DepthSearchShape.Typed<Capsule, CapsuleWide, CapsuleSupport>(new(radius, length), shape),
            ConvexKind.Box => new DepthSearchShape.Typed<Box, BoxWide, BoxSupport>(
                new((float)(2 * half.X), (float)(2 * half.Y), (float)(2 * half.Z)), shape),
            ConvexKind.Triangle => new DepthSearchShape.Typed<Triangle, TriangleWide, TriangleSupport>(
                new(shape.Points[0], shape.Points[1], shape.Points[2]), shape),
            ConvexKind.Cylinder => new DepthSearchShape.Typed<Cylinder, CylinderWide, CylinderSupport>(new(radius, length), shape),
            ConvexKind.Hull => CreateHull([.. shape.Points], pool),
            _ => throw new ArgumentException($"{shape.Kind}", nameof(shape)),
        };
    }

    public static DepthSearchShape Create(ConvexKind kind, ConvexForm form, double size, ConvexRandom random, BufferPool pool) =>
        Create(ConvexGenerator.Create(kind, form, size, random), pool);

    static DepthSearchShape.Typed<ConvexHull, ConvexHullWide, ConvexHullSupport> CreateHull(Vector3[] points, BufferPool pool)
    {
        var hull = new ConvexHull(points, pool, out _);
        var vertices = Enumerable.Range(0, hull.VertexCount).Select(i =>
        {
            hull.GetPoint(i, out var point);
            return point;
        });
        return Of(hull, ConvexShape.Hull([.. vertices]));
    }

    /// <summary>A hull that there is.</summary>
    public static DepthSearchShape.Typed<ConvexHull, ConvexHullWide, ConvexHullSupport> Of(ConvexHull hull, ConvexShape reference) =>
        new(hull, reference);
}
