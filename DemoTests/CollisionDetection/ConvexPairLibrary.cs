using System;
using System.Collections.Generic;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;
using DemoTests.Support;

namespace DemoTests.CollisionDetection;

/// <summary>A shape of the reference, and the library's own: as bytes, and for searches alone.</summary>
sealed record ConvexPairShape(ConvexShape Shape, byte[] Bytes, DepthSearchShape Search);

/// <summary>Tests any convex pair through the batcher.</summary>
sealed class ConvexPairLibrary : IDisposable
{
    readonly BufferPool pool = new();
    readonly Shapes shapes;
    readonly List<ConvexHull> hulls = [];

    public ConvexPairLibrary() => shapes = new(pool, 1);

    /// <summary>Whether the library has a test for a pair.</summary>
    public static bool Supports(ConvexKind a, ConvexKind b) => PairHarness.Registry.TryGetTask((int)a, (int)b, out _);

    /// <summary>Whether the library's test of a pair is a search, not a closed form.</summary>
    public static bool Searches(ConvexKind a, ConvexKind b) =>
        PairHarness.Registry.TryGetTask((int)a, (int)b, out var task) && task.GetType().GetGenericTypeDefinition() == typeof(SearchCollisionTask<,,,,,>);

    /// <summary>Makes the library's shape. The reference's shape is changed where the library moves points to a centre of its own.</summary>
    public ConvexPairShape Create(ConvexShape shape)
    {
        if (shape.Kind == ConvexKind.Hull)
        {
            var hull = new ConvexHull(shape.Points, pool, out var center);
            hulls.Add(hull);
            var moved = ConvexShape.Hull(shape.Points, center);
            return new(moved, ToBytes(hull), DepthSearchShapes.Of(hull, moved));
        }
        return new(shape, ToBytes(shape), DepthSearchShapes.Create(shape, pool));
    }

    static byte[] ToBytes(ConvexShape shape)
    {
        switch (shape.Kind)
        {
            case ConvexKind.Sphere:
                return ToBytes(new Sphere((float)shape.Radius));
            case ConvexKind.Capsule:
                return ToBytes(new Capsule((float)shape.Radius, (float)(2 * shape.HalfLength)));
            case ConvexKind.Box:
                var whole = ConvexGenerator.ToVector(shape.HalfExtents * 2);
                return ToBytes(new Box(whole.X, whole.Y, whole.Z));
            case ConvexKind.Triangle:
                return ToBytes(new Triangle(shape.Points[0], shape.Points[1], shape.Points[2]) { TwoSided = true });
            case ConvexKind.Cylinder:
                return ToBytes(new Cylinder((float)shape.Radius, (float)(2 * shape.HalfLength)));
            default:
                throw new ArgumentException($"{shape.Kind}", nameof(shape));
        }
    }

    /// <summary>Tests pairs, each with its own margin.</summary>
    public unsafe ConvexContactManifold[] Run(IReadOnlyList<(ConvexPairShape A, ConvexPairShape B, ConvexPose Pose, float Margin)> pairs)
    {
        var manifolds = new ConvexContactManifold[pairs.Count];
        var completions = new int[pairs.Count];
        var batcher = new CollisionBatcher<ManifoldCollector>(pool, shapes, PairHarness.Registry, 1 / 60f, new(manifolds, completions));
        for (int i = 0; i < pairs.Count; ++i)
        {
            var (a, b, pose, margin) = pairs[i];
            fixed (byte* bytesA = a.Bytes, bytesB = b.Bytes)
            {
                batcher.AddDirectly((int)a.Shape.Kind, (int)b.Shape.Kind, bytesA, bytesB, pose.OffsetB, pose.OrientationA,
                    pose.OrientationB, margin, new PairContinuation(i));
            }
        }
        batcher.Flush();
        foreach (var count in completions)
            Xunit.Assert.Equal(1, count);
        return manifolds;
    }

    public void Dispose()
    {
        foreach (var hull in hulls)
            hull.Dispose(pool);
        shapes.Dispose();
        pool.Dispose();
    }

    static byte[] ToBytes<TShape>(TShape shape) where TShape : unmanaged, IShape
    {
        shape.Validate();
        var bytes = new byte[Unsafe.SizeOf<TShape>()];
        Unsafe.WriteUnaligned(ref bytes[0], shape);
        return bytes;
    }
}
