using System;
using System.Collections.Generic;
using System.Linq;
using System.Runtime.CompilerServices;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.CollisionDetection;

/// <summary>Pairs and their manifolds, against dictionaries.</summary>
public class PairCacheTests
{
    static CollidablePair Pair(int a, int b) =>
        new(new CollidableReference(CollidableMobility.Dynamic, new BodyHandle(a)), new CollidableReference(new StaticHandle(b)));

    /// <summary>What a pair of convex shapes takes is two lines of the cache for four pairs; each child of others has a line.</summary>
    [Fact]
    public void Records_have_the_sizes_that_the_decision_says()
    {
        Assert.Equal(32, Unsafe.SizeOf<CachedPair>());
        Assert.Equal(64, Unsafe.SizeOf<ChildManifold>());
        Assert.Equal(256, Unsafe.SizeOf<PairHistory>());
    }

    [Theory, InlineData(1), InlineData(2), InlineData(3)]
    public void Manifolds_are_in_the_order_of_children_whatever_comes_and_goes(int seed)
    {
        using var pool = new BufferPool();
        var cache = new PairCache(8, pool);
        var random = new Random(seed);
        var expected = new Dictionary<int, SortedDictionary<(int, int), int>>();
        for (int step = 0; step < 3000; ++step)
        {
            var name = random.Next(12);
            var index = cache.Pairs.IndexOf(Pair(name, name + 1));
            Assert.Equal(expected.ContainsKey(name), index >= 0);
            var children = new ChildIds(random.Next(3), random.Next(7));
            switch (random.Next(20))
            {
                case < 10:
                    index = cache.FindOrAdd(Pair(name, name + 1), ofChildren: true, pool);
                    ref var manifold = ref cache.FindOrAdd(ref cache.Pairs.Values[index], children, pool).Manifold;
                    if (!expected.ContainsKey(name))
                        expected.Add(name, []);
                    if (expected[name].TryAdd((children.A, children.B), step))
                    {
                        Assert.False(manifold.HasConstraint);
                        Assert.True(manifold.History < 0);
                        manifold.History = step % 2 == 0 ? cache.Histories.Take(pool) : PairInput.NoHistory;
                        manifold.Features[0] = step;
                    }
                    break;
                case < 18 when index >= 0 && expected[name].ContainsKey((children.A, children.B)):
                    cache.Remove(index, children, pool);
                    expected[name].Remove((children.A, children.B));
                    if (expected[name].Count == 0)
                        expected.Remove(name);
                    break;
                case 19 when index >= 0:
                    cache.Remove(index, pool);
                    expected.Remove(name);
                    break;
            }
            Compare(cache, expected);
        }
        cache.Clear();
        Assert.Equal(0, cache.Manifolds.Count + cache.Histories.Count);
        cache.Dispose(pool);
        pool.AssertEmpty();
    }

    static void Compare(PairCache cache, Dictionary<int, SortedDictionary<(int, int), int>> expected)
    {
        Assert.Equal(expected.Count, cache.Pairs.Count);
        Assert.Equal(expected.Values.Sum(manifolds => manifolds.Count), cache.Manifolds.Count);
        Assert.Equal(expected.Values.Sum(manifolds => manifolds.Values.Count(step => step % 2 == 0)), cache.Histories.Count);
        foreach (var (name, manifolds) in expected)
        {
            var actual = new List<((int, int), int)>();
            for (var list = cache.ManifoldsOf(cache.Pairs.IndexOf(Pair(name, name + 1))); list.MoveNext();)
                actual.Add(((list.Children.A, list.Children.B), list.Current.Features[0]));
            Assert.Equal(manifolds.Select(manifold => (manifold.Key, manifold.Value)), actual);
        }
    }

    /// <summary>A body that got a shape of another kind: what was remembered of the pair was of the old one.</summary>
    [Fact]
    public void A_pair_that_changes_its_kind_forgets_its_manifolds()
    {
        using var pool = new BufferPool();
        var cache = new PairCache(8, pool);
        var index = cache.FindOrAdd(Pair(1, 2), ofChildren: false, pool);
        cache.Pairs.Values[index].Single.History = cache.Histories.Take(pool);
        cache.Empty(ref cache.Pairs.Values[index], ofChildren: true, pool);
        Assert.True(cache.Pairs.Values[index].IsOfChildren);
        Assert.Equal(0, cache.Histories.Count);
        cache.FindOrAdd(ref cache.Pairs.Values[index], new ChildIds(0, 3), pool).Manifold.History = cache.Histories.Take(pool);
        cache.Empty(ref cache.Pairs.Values[index], ofChildren: false, pool);
        Assert.Equal((0, 0, false), (cache.Histories.Count, cache.Manifolds.Count, cache.Pairs.Values[index].IsOfChildren));
        cache.Dispose(pool);
        pool.AssertEmpty();
    }
}
