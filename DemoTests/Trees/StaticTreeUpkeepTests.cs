using System;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.Trees;

/// <summary>Statics that come and go keep a good tree, and no step pays for a new one where the old one is good.</summary>
public class StaticTreeUpkeepTests
{
    const int Count = 4000;
    const int ChangesPerStep = 50;
    const int Steps = 400;

    static BoundingBox Box(Random random, float start, float end)
    {
        var center = new Vector3(start + (end - start) * random.NextSingle(), 10 * random.NextSingle(), 300 * random.NextSingle());
        var half = new Vector3(.2f + 3 * random.NextSingle() * random.NextSingle());
        return new(center - half, center + half);
    }

    [Theory]
    // Anywhere: nothing is built, five times over.
    [InlineData("random", 0, 0, 1.2f)]
    // The last fiftieth goes, and comes in front: a level that streams by. Less than the former rule, which built at each quarter: 20 times.
    [InlineData("stream", 1, 19, 1.6f)]
    public void ATreeIsBuiltWhereChangesHaveMadeItWorse(string kind, int leastBuilds, int mostBuilds, float worstCost)
    {
        using var pool = new BufferPool();
        var broadPhase = new BroadPhase(pool, 16, Count);
        var random = new Random(kind.Length);
        for (int i = 0; i < Count; ++i)
            Add(i, Box(random, 0, 300));
        broadPhase.Update();
        int builds = 0;
        for (int step = 1; step <= Steps; ++step)
        {
            var front = 300f + 300f * step * ChangesPerStep / Count;
            for (int i = 0; i < ChangesPerStep; ++i)
            {
                var leaf = kind == "random" ? random.Next(Count) : Last();
                broadPhase.RemoveStaticAt(leaf, out _);
                Add(step, kind == "random" ? Box(random, 0, 300) : Box(random, front - 4, front));
            }
            var before = TreeBytes.Of(broadPhase.StaticTree);
            broadPhase.Update();
            builds += before.AsSpan().SequenceEqual(TreeBytes.Of(broadPhase.StaticTree)) ? 0 : 1;
        }
        broadPhase.Validate();
        Assert.InRange(builds, leastBuilds, mostBuilds);
        var cost = broadPhase.StaticTree.MeasureRelativeCost();
        broadPhase.StaticTree.BinnedBuild(pool);
        Assert.InRange(cost / broadPhase.StaticTree.MeasureRelativeCost(), .5f, worstCost);
        broadPhase.Dispose();
        pool.AssertEmpty();

        void Add(int handle, BoundingBox bounds) => broadPhase.AddStatic(new CollidableReference(new StaticHandle(handle)), ref bounds);

        int Last() => Enumerable.Range(0, 60).Select(_ => random.Next(Count)).MinBy(MinimumX);

        unsafe float MinimumX(int leaf)
        {
            broadPhase.GetStaticBoundsPointers(leaf, out var min, out _);
            return min->X;
        }
    }

    [Fact]
    public void ALevelThatIsLoadedIsBuiltAtOnce()
    {
        using var pool = new BufferPool();
        var broadPhase = new BroadPhase(pool, 16, Count);
        var random = new Random(9);
        for (int i = 0; i < Count; ++i)
        {
            // In order, which is the worst for insertion.
            var bounds = Box(random, .1f * i, .1f * i + 1);
            broadPhase.AddStatic(new CollidableReference(new StaticHandle(i)), ref bounds);
        }
        broadPhase.Update();
        var built = TreeBytes.Of(broadPhase.StaticTree);
        broadPhase.StaticTree.BinnedBuild(pool);
        Assert.Equal(TreeBytes.Of(broadPhase.StaticTree), built);
        broadPhase.Dispose();
    }
}
