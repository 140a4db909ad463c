using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;
using DemoTests.CollisionDetection.References;

namespace DemoTests.CollisionDetection;

/// <summary>Keeps the manifolds of a batcher by pair id.</summary>
readonly struct ManifoldCollector(ConvexContactManifold[] manifolds, int[] completions) : ICollisionCallbacks
{
    public void OnPairCompleted<TManifold>(int pairId, ref TManifold manifold) where TManifold : unmanaged, IContactManifold<TManifold>
    {
        manifolds[pairId] = (ConvexContactManifold)(object)manifold;
        ++completions[pairId];
    }

    public void OnChildPairCompleted(int pairId, int childA, int childB, ref ConvexContactManifold manifold) =>
        throw new NotSupportedException();

    public bool AllowCollisionTesting(int pairId, int childA, int childB) => true;
}

static class PairHarness
{
    public static readonly CollisionTaskRegistry Registry = DefaultTypes.CreateDefaultCollisionTaskRegistry();

    /// <summary>Tests pairs through a batcher, in a given order.</summary>
    public static ConvexContactManifold[] Run<TShapeA, TShapeB>(IReadOnlyList<PairCase<TShapeA, TShapeB>> cases,
        float speculativeMargin, int[]? order = null, int flushInterval = int.MaxValue)
        where TShapeA : unmanaged, IConvexShape where TShapeB : unmanaged, IConvexShape
    {
        using var pool = new BufferPool();
        var shapes = new Shapes(pool, 1);
        var manifolds = new ConvexContactManifold[cases.Count];
        var completions = new int[cases.Count];
        var batcher = new CollisionBatcher<ManifoldCollector>(pool, shapes, Registry, 1 / 60f, new(manifolds, completions));
        for (int i = 0; i < cases.Count; ++i)
        {
            var index = order is null ? i : order[i];
            var (a, b, offset, orientationA, orientationB) = cases[index];
            batcher.Add(a, b, offset, orientationA, orientationB, speculativeMargin, index);
            if ((i + 1) % flushInterval == 0)
                batcher.Flush();
        }
        batcher.Flush();
        shapes.Dispose();
        pool.AssertEmpty();
        foreach (var count in completions)
            Xunit.Assert.Equal(1, count);
        return manifolds;
    }

    public static ConvexContactManifold Run<TShapeA, TShapeB>(in PairCase<TShapeA, TShapeB> pair, float speculativeMargin = 0)
        where TShapeA : unmanaged, IConvexShape where TShapeB : unmanaged, IConvexShape => Run([pair], speculativeMargin)[0];

    public static RoundedBox Reference<TShape>(in TShape shape, Vector3 position, Quaternion orientation) => (object)shape! switch
    {
        Sphere sphere => new(sphere, position),
        Capsule capsule => new(capsule, position, orientation),
        Box box => new(box, position, orientation),
        _ => throw new NotSupportedException(),
    };

    /// <summary>Makes a pair that lies in a given way, sizes even in their logarithm with ratios of up to 100.</summary>
    public static PairCase<TShapeA, TShapeB> Create<TShapeA, TShapeB>(ref PairRandom random, PairKind kind,
        Func<PairRandom, TShapeA> createA, Func<PairRandom, TShapeB> createB)
    {
        var a = createA(new(random.NextBits()));
        var b = createB(new(random.NextBits()));
        var orientationA = random.NextOrientation();
        var orientationB = kind switch
        {
            PairKind.ParallelShallow or PairKind.ParallelDeep => Quaternion.Normalize(orientationA * random.NextAligned(0)),
            PairKind.NearlyParallel => Quaternion.Normalize(orientationA * random.NextAligned(random.NextLogarithmic(1e-7, 1e-1))),
            _ => random.NextOrientation(),
        };
        var referenceA = Reference(a, default, orientationA);
        var referenceB = Reference(b, default, orientationB);
        // Boxes and capsules are mostly met at their faces and sides, so half of the directions are across those.
        var direction = random.Next(2) == 0 ? random.NextDirection() : Vector3.Transform(Vector3.UnitX, orientationA);
        var d = new Double3(direction);
        var size = Math.Min(referenceA.Size, referenceB.Size);
        var reach = referenceA.Extent(d) + referenceB.Extent(d);
        var offset = kind switch
        {
            PairKind.Apart => reach + size * random.Next(0, 0.1),
            PairKind.Touching => reach + size * random.Next(-1e-5, 1e-5),
            PairKind.Shallow or PairKind.ParallelShallow or PairKind.NearlyParallel => reach - size * random.Next(0, 0.05),
            PairKind.Concentric => random.Next(3) == 0 ? 0 : size * random.NextLogarithmic(1e-8, 1e-3),
            _ => reach * random.Next(0, 1),
        };
        // To the side, as far as the smaller shape reaches, so that corners and edges meet as well.
        var side = kind == PairKind.Concentric ? default : random.NextDirection() * (float)(size * random.Next(0, 0.5));
        side -= direction * Vector3.Dot(direction, side);
        return new(a, b, direction * (float)offset + side, orientationA, orientationB);
    }
}
