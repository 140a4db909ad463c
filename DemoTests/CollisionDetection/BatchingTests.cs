using System;
using System.Linq;
using System.Numerics;
using System.Runtime.InteropServices;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.CollisionDetection;

/// <summary>What a batcher does with pairs, whatever their shapes are.</summary>
public sealed class BatchingTests
{
    static readonly Quaternion Turn = Quaternion.Normalize(new(0.1f, -0.3f, 0.2f, 0.9f));

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

    static float Deepest(ConvexContactManifold manifold) => Enumerable.Range(0, manifold.Count).Max(manifold.GetDepth);

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
        where TShapeA : unmanaged, IConvexShape where TShapeB : unmanaged, IConvexShape
    {
        var cases = CreateCases(333, createA, createB);
        var expected = PairHarness.Run(cases, 0.1f);
        var random = new PairRandom(3);
        int[] order = [.. Enumerable.Range(0, cases.Length).OrderBy(_ => random.Next())];
        foreach (var flushInterval in new[] { int.MaxValue, 1, 5, 11 })
        {
            var actual = PairHarness.Run(cases, 0.1f, order, flushInterval);
            for (int i = 0; i < cases.Length; ++i)
                Assert.Equal(Bits(expected[i]), Bits(actual[i]));
        }
    }

    // Contacts beyond the count mean nothing.
    static byte[] Bits(ConvexContactManifold manifold) =>
        MemoryMarshal.AsBytes(new ReadOnlySpan<ConvexContactManifold>(in manifold))[..(28 + manifold.Count * 20)].ToArray();

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
        var swapped = cases.Select(x => new PairCase<TShapeB, TShapeA>(x.B, x.A, -x.OffsetB, x.OrientationB, x.OrientationA)).ToArray();
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
            Assert.Equal(Deepest(first[i]), Deepest(second[i]), 1e-5f);
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
        var cases = CreateShallowCases(createA, createB);
        var moved = cases.Select(x => x with
        {
            OffsetB = Vector3.Transform(x.OffsetB, Turn),
            OrientationA = Quaternion.Normalize(Turn * x.OrientationA),
            OrientationB = Quaternion.Normalize(Turn * x.OrientationB),
        }).ToArray();
        var first = PairHarness.Run(cases, 0.1f);
        var second = PairHarness.Run(moved, 0.1f);
        for (int i = 0; i < cases.Length; ++i)
        {
            if (first[i].Count == 0 || second[i].Count == 0)
                continue;
            Assert.True(Vector3.Distance(Vector3.Transform(first[i].Normal, Turn), second[i].Normal) < 1e-4f);
            Assert.Equal(Deepest(first[i]), Deepest(second[i]), 1e-5f);
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
                batcher.Add(a, b, new(0, 1, 0), Quaternion.Identity, Turn, 0, new(0));
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
