using System;
using System.Linq;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.CollisionDetection;

/// <summary>What a batcher does with pairs, whatever their shapes are.</summary>
public sealed class BatchingTests
{
    static PairCase<TShapeA, TShapeB>[] CreateCases<TShapeA, TShapeB>(int count,
        Func<PairRandom, TShapeA> createA, Func<PairRandom, TShapeB> createB)
    {
        var random = new PairRandom(77);
        var kinds = Enum.GetValues<PairKind>();
        return [.. Enumerable.Range(0, count).Select(i => PairHarness.Create(ref random, kinds[i % kinds.Length], createA, createB))];
    }

    // Deep ones may leave by another way when they are rounded otherwise.
    static PairCase<TShapeA, TShapeB>[] CreateShallowCases<TShapeA, TShapeB>(
        Func<PairRandom, TShapeA> createA, Func<PairRandom, TShapeB> createB) =>
        [.. CreateCases(400, createA, createB).Where((_, i) => (PairKind)(i % 8) is PairKind.Apart or PairKind.Touching or PairKind.Shallow)];

    static Sphere CreateSphere(PairRandom random) => new(random.Next(0.2, 1));

    static Capsule CreateCapsule(PairRandom random) => new(random.Next(0.1, 0.5), random.Next(0.2, 1));

    static Box CreateBox(PairRandom random) => new(random.Next(0.2, 1), random.Next(0.2, 1), random.Next(0.2, 1));

    [Fact]
    public void ResultsDoNotDependOnTheOtherPairs()
    {
        CheckPurity(CreateSphere, CreateSphere);
        CheckPurity(CreateSphere, CreateCapsule);
        CheckPurity(CreateSphere, CreateBox);
        CheckPurity(CreateCapsule, CreateCapsule);
        CheckPurity(CreateCapsule, CreateBox);
        CheckPurity(CreateBox, CreateBox);
        CheckPurity(CreateBox, CreateSphere);
    }

    static void CheckPurity<TShapeA, TShapeB>(Func<PairRandom, TShapeA> createA, Func<PairRandom, TShapeB> createB)
        where TShapeA : unmanaged, IConvexShape where TShapeB : unmanaged, IConvexShape =>
        PairProperties.CheckPurity(CreateCases(333, createA, createB), 0.1f);

    [Fact]
    public void OtherOrderOfShapesGivesTheOppositeNormal()
    {
        CheckSwap(CreateSphere, CreateSphere);
        CheckSwap(CreateSphere, CreateCapsule);
        CheckSwap(CreateSphere, CreateBox);
        CheckSwap(CreateCapsule, CreateCapsule);
        CheckSwap(CreateCapsule, CreateBox);
    }

    static void CheckSwap<TShapeA, TShapeB>(Func<PairRandom, TShapeA> createA, Func<PairRandom, TShapeB> createB)
        where TShapeA : unmanaged, IConvexShape where TShapeB : unmanaged, IConvexShape
    {
        var cases = CreateShallowCases(createA, createB);
        var swapped = cases.Select(x => x.Swap()).ToArray();
        var first = PairHarness.Run(cases, 0.1f);
        var second = PairHarness.Run(swapped, 0.1f);
        for (int i = 0; i < cases.Length; ++i)
        {
            Assert.Equal(first[i].Count, second[i].Count);
            Assert.Equal(cases[i].OffsetB, first[i].OffsetB);
            Assert.Equal(-cases[i].OffsetB, second[i].OffsetB);
            if (first[i].Count == 0)
                continue;
            Assert.True(Vector3.Distance(first[i].Normal, -second[i].Normal) < 1e-4f);
            Assert.Equal(first[i].Deepest(), second[i].Deepest(), 1e-5f);
            // Two capsules share a stretch that is measured on the first. Places are relative to A, which is the other shape.
            if (typeof(TShapeA) == typeof(TShapeB) && first[i].Count > 1)
                continue;
            var places = Enumerable.Range(0, first[i].Count).Select(first[i].GetOffset).ToArray();
            for (int j = 0; j < second[i].Count; ++j)
                Assert.True(places.Min(p => Vector3.Distance(p, second[i].GetOffset(j) + cases[i].OffsetB)) < 1e-3f);
        }
    }

    [Fact]
    public void ContactsMoveWithThePair()
    {
        CheckMotion(CreateSphere, CreateBox);
        CheckMotion(CreateCapsule, CreateCapsule);
        CheckMotion(CreateCapsule, CreateBox);
        CheckMotion(CreateBox, CreateBox);
    }

    static void CheckMotion<TShapeA, TShapeB>(Func<PairRandom, TShapeA> createA, Func<PairRandom, TShapeB> createB)
        where TShapeA : unmanaged, IConvexShape where TShapeB : unmanaged, IConvexShape
    {
        foreach (var (before, after) in PairProperties.RunTurned(CreateShallowCases(createA, createB), 0.1f))
        {
            Assert.True(Vector3.Distance(Vector3.Transform(before.Normal, PairProperties.Turn), after.Normal) < 1e-4f);
            Assert.Equal(before.Deepest(), after.Deepest(), 1e-5f);
        }
    }

    [Fact]
    public void UnregisteredPairIsRefusedByName()
    {
        using var pool = new BufferPool();
        var shapes = new Shapes(pool, 1);
        var registry = new CollisionTaskRegistry();
        registry.Register(PairHarness.Registry[0]);
        var batcher = new CollisionBatcher<ManifoldCollector>(pool, shapes, registry, 0, new([], []));
        var sphere = shapes.Add(new Sphere(1));
        var box = shapes.Add(new Box(1, 1, 1));
        var exception = Assert.Throws<InvalidOperationException>(
            () => batcher.Add(sphere, box, default, Quaternion.Identity, Quaternion.Identity, 0, new(0)));
        Assert.Contains("Sphere", exception.Message, StringComparison.Ordinal);
        Assert.Contains("type 2", exception.Message, StringComparison.Ordinal);
        batcher.Dispose();
        shapes.Dispose();
        pool.AssertEmpty();
    }

    [Fact]
    public void BadInputIsRefused()
    {
        using var pool = new BufferPool();
        var shapes = new Shapes(pool, 1);
        var batcher = new CollisionBatcher<ManifoldCollector>(pool, shapes, PairHarness.Registry, 0, new([], []));
        var sphere = shapes.Add(new Sphere(1));
        var none = Quaternion.Identity;
        Assert.ThrowsAny<ArgumentException>(() => batcher.Add(default, sphere, default, none, none, 0, new(0)));
        Assert.ThrowsAny<ArgumentException>(() => batcher.Add(sphere, new(Sphere.Id, 5), default, none, none, 0, new(0)));
        Assert.ThrowsAny<ArgumentException>(() => batcher.Add(sphere, sphere, new(0, float.NaN, 0), none, none, 0, new(0)));
        Assert.ThrowsAny<ArgumentException>(() => batcher.Add(sphere, sphere, default, default, none, 0, new(0)));
        Assert.ThrowsAny<ArgumentException>(() => batcher.Add(sphere, sphere, default, none, none, -1, new(0)));
        Assert.ThrowsAny<ArgumentException>(() => batcher.Add(new Sphere(-1), new Sphere(1), default, none, none, 0, 0));
        Assert.ThrowsAny<ArgumentException>(
            () => new CollisionBatcher<ManifoldCollector>(pool, shapes, PairHarness.Registry, float.NaN, new([], [])));
        batcher.Dispose();
        shapes.Dispose();
        pool.AssertEmpty();
    }

    readonly struct Counter(int[] counts) : ICollisionCallbacks
    {
        public void OnPairCompleted<TManifold>(int pairId, ref TManifold manifold)
            where TManifold : unmanaged, IContactManifold<TManifold> =>
            counts[pairId] += manifold.Count;

        public void OnChildPairCompleted(int pairId, int childA, int childB, ref ConvexContactManifold manifold) { }

        public bool AllowCollisionTesting(int pairId, int childA, int childB) => true;
    }

    [Fact]
    public void AddingAndFlushingAllocatesNothingManaged()
    {
        using var pool = new BufferPool();
        var shapes = new Shapes(pool, 1);
        TypedIndex[] types = [shapes.Add(new Sphere(1)), shapes.Add(new Capsule(1, 1)), shapes.Add(new Box(1, 1, 1))];
        var counts = new int[1];
        var batcher = new CollisionBatcher<Counter>(pool, shapes, PairHarness.Registry, 0, new(counts));
        long allocated = 0;
        for (int round = 0; round < 3; ++round)
        {
            counts[0] = 0;
            var before = GC.GetAllocatedBytesForCurrentThread();
            for (int i = 0; i < 900; ++i)
            {
                var (a, b) = (types[i % 3], types[i / 3 % 3]);
                batcher.Add(a, b, new(0, 1, 0), Quaternion.Identity, PairProperties.Turn, 0, new(0));
            }
            batcher.Flush();
            allocated = GC.GetAllocatedBytesForCurrentThread() - before;
        }
        Assert.Equal(0, allocated);
        Assert.InRange(counts[0], 900, 3600);
        shapes.Dispose();
        pool.AssertEmpty();
    }
}
