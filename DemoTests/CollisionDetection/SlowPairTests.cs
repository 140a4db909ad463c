using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.CollisionDetection;

/// <summary>Pairs whose last search was slow wait at the other end of a batch, and that is all that it changes.</summary>
public unsafe class SlowPairTests
{
    readonly struct Results(ConvexContactManifold[] manifolds, int[] counts) : ICollisionCallbacks
    {
        public void OnPairCompleted<TManifold>(int pairId, ref TManifold manifold) where TManifold : unmanaged, IContactManifold<TManifold>
        {
            var convex = (ConvexContactManifold)(object)manifold;
            // What is behind the last contact is anything.
            for (int i = convex.Count; i < 4; ++i)
                ConvexContactManifold.GetConvexContactReference(ref convex, i) = default;
            manifolds[pairId] = convex;
            ++counts[pairId];
        }

        public void OnChildPairCompleted(int pairId, int childA, int childB, ref ConvexContactManifold manifold) { }

        public bool AllowCollisionTesting(int pairId, int childA, int childB) => true;
    }

    /// <summary>Numbers of pairs that leave bundles of either kind empty, begun and full, with any part of them slow.</summary>
    [Theory]
    [InlineData(1, 0.0)]
    [InlineData(1, 1.0)]
    [InlineData(3, 0.5)]
    [InlineData(9, 0.2)]
    [InlineData(31, 0.4)]
    [InlineData(32, 1.0)]
    [InlineData(97, 0.0)]
    [InlineData(97, 0.3)]
    [InlineData(200, 0.7)]
    public void Which_pairs_were_slow_changes_no_contact(int count, double slowPart)
    {
        var quick = Test(count, 0);
        var mixed = Test(count, slowPart);

        Assert.Equal(quick, mixed);
        Assert.Contains(quick, manifold => manifold.Count > 0);
    }

    static ConvexContactManifold[] Test(int count, double slowPart)
    {
        using var pool = new BufferPool();
        var shapes = new Shapes(pool, 8);
        var registry = DefaultTypes.CreateDefaultCollisionTaskRegistry();
        var box = shapes.Add(new Box(1, 0.7f, 1.3f));
        var cylinder = shapes.Add(new Cylinder(0.4f, 0.9f));
        pool.Take<PairHistory>(count + 1, out var histories);
        histories.Clear(0, count + 1);
        var manifolds = new ConvexContactManifold[count];
        var counts = new int[count];
        var batcher = new CollisionBatcher<Results>(pool, shapes, registry, 0.01f, new Results(manifolds, counts), histories.Memory);
        var places = new Random(1);
        var slowness = new Random(2);
        for (int i = 0; i < count; ++i)
        {
            // Every other pair in the other order.
            var isTurned = i % 2 != 0;
            var first = isTurned ? cylinder : box;
            var second = isTurned ? box : cylinder;
            var task = registry.GetTask(first.Type, second.Type, out var taskIndex, out var flipped);
            ref var history = ref histories[i + 1];
            var evaluations = slowness.NextDouble() < slowPart ? 9 : 1;
            default(HistoryLane).Record(ref history, default, new PairMeasures { Evaluations = evaluations }, Quaternion.Identity, Quaternion.Identity, 0, 1);
            Assert.Equal(evaluations > 1, PairHistory.IsSlow(history.GetReference(i + 1)));
            Assert.Equal(i + 1, PairHistory.GetIndex(history.GetReference(i + 1)));
            var offset = i == 0 ? new Vector3(0.5f, 0.1f, 0) : new Vector3(places.NextSingle(), places.NextSingle(), places.NextSingle()) * 1.2f;
            batcher.Add(task, taskIndex, flipped, first.Index, second.Index, offset, Turn(places), Turn(places), 0.1f, i,
                history.GetReference(i + 1));
        }
        batcher.Flush();
        Assert.All(counts, times => Assert.Equal(1, times));
        shapes.Dispose();
        return manifolds;
    }

    static Quaternion Turn(Random random) => Exact.Normalize(new Quaternion(
        random.NextSingle() - 0.5f, random.NextSingle() - 0.5f, random.NextSingle() - 0.5f, random.NextSingle() + 0.1f));
}
