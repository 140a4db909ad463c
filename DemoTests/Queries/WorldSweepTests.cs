using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using System.Threading.Tasks;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;
using DemoTests.Support;
using Xunit;

namespace DemoTests.Queries;

/// <summary>Shapes swept through a world with everything in it, compared with a loop over all parts of it.</summary>
public sealed class WorldSweepTests : IDisposable
{
    static readonly int sweepCount = Environment.GetEnvironmentVariable("PHYSICS_FULL_TESTS") is { Length: > 0 } ? 20_000 : 400;

    readonly SweepMaze maze = new(5);

    public void Dispose() => maze.Dispose();

    List<SweptHit> Sweep(in SweepMaze.Case sweep, bool nearestOnly = false, SweepMaze? world = null)
    {
        var hits = new List<SweptHit>();
        var handler = new SweepHits(hits, nearestOnly);
        (world ?? maze).Sweep(sweep, ref handler);
        return hits;
    }

    static IEnumerable<SweepMaze.Case> Cases(int seed, int count)
    {
        var random = new Random(seed);
        for (int i = 0; i < count; ++i)
            yield return SweepMaze.NextCase(random);
    }

    [Fact]
    public void All_hits_are_those_of_a_loop_over_all_parts()
    {
        int hitCount = 0, containerHits = 0, overlaps = 0;
        foreach (var sweep in Cases(1, sweepCount))
        {
            var hits = Sweep(sweep).ToDictionary(hit => hit.Collidable);
            foreach (var collidable in maze.Collidables)
            {
                var expected = BruteForce(sweep, collidable, out var isContainer);
                Assert.Equal(expected is not null, hits.ContainsKey(collidable));
                if (expected is not { } hit)
                    continue;
                Assert.Equal(hit, hits[collidable]);
                ++hitCount;
                overlaps += hit.Overlaps ? 1 : 0;
                containerHits += isContainer ? 1 : 0;
            }
        }
        Assert.True(hitCount > sweepCount / 2 && overlaps > sweepCount / 20 && containerHits > sweepCount / 8, $"{hitCount} {overlaps} {containerHits}");
    }

    [Fact]
    public void The_nearest_hit_is_the_first_of_all()
    {
        foreach (var sweep in Cases(2, sweepCount))
        {
            var all = Sweep(sweep);
            var nearest = Sweep(sweep, nearestOnly: true);
            Assert.Equal(all.Count > 0 ? 1 : 0, nearest.Count);
            if (all.Count > 0)
                Assert.Equal(all.Min(hit => hit.T), nearest[0].T);
        }
    }

    [Fact]
    public void A_world_that_was_made_last_to_first_is_hit_alike()
    {
        using var reversed = new SweepMaze(5, reversed: true);
        foreach (var sweep in Cases(3, sweepCount / 2))
        {
            Assert.Equal(
                Sweep(sweep).Select(hit => (maze.Names[hit.Collidable], hit.T, hit.Place, hit.Normal)).Order(),
                Sweep(sweep, world: reversed).Select(hit => (reversed.Names[hit.Collidable], hit.T, hit.Place, hit.Normal)).Order());
        }
    }

    [Fact]
    public void What_is_not_allowed_is_not_hit()
    {
        foreach (var sweep in Cases(4, 60))
        {
            foreach (var hit in Sweep(sweep))
            {
                var hits = new List<SweptHit>();
                var handler = new SweepHits(hits) { Ignored = hit.Collidable };
                maze.Sweep(sweep, ref handler);
                Assert.DoesNotContain(hits, other => other.Collidable == hit.Collidable);
                Assert.Equal(Sweep(sweep).Count - 1, hits.Count);
            }
        }
    }

    [Fact]
    public void Of_a_container_only_the_children_that_are_allowed_are_hit()
    {
        int found = 0;
        foreach (var sweep in Cases(5, 60))
        {
            foreach (var whole in Sweep(sweep))
            {
                if (maze.Children(whole.Collidable) is not { } children)
                    continue;
                foreach (var child in children)
                {
                    var hits = new List<SweptHit>();
                    var handler = new SweepHits(hits) { OnlyChild = child };
                    maze.Sweep(sweep, ref handler);
                    var expected = BruteForce(sweep, whole.Collidable, out _, child);
                    var own = hits.Where(hit => hit.Collidable == whole.Collidable).ToArray();
                    Assert.Equal(expected is null ? 0 : 1, own.Length);
                    if (expected is not { } hit)
                        continue;
                    Assert.Equal(hit, own[0]);
                    ++found;
                }
            }
        }
        Assert.True(found > 50, $"{found}");
    }

    [Fact]
    public async Task Threads_that_ask_at_once_hear_the_same()
    {
        var cases = Cases(6, 200).ToArray();
        var expected = Array.ConvertAll(cases, sweep => Sweep(sweep));
        await Task.WhenAll(Enumerable.Range(0, 4).Select(_ => Task.Run(() =>
        {
            using var pool = new BufferPool();
            for (int i = 0; i < cases.Length; ++i)
            {
                var hits = new List<SweptHit>();
                var handler = new SweepHits(hits);
                var sweep = cases[i];
                if (sweep.Shape != 0)
                    continue;
                maze.Simulation.Sweep(new Sphere(.4f), sweep.Pose, sweep.Velocity, sweep.MaximumT, pool, ref handler);
                Assert.Equal(expected[i], hits);
            }
            pool.AssertEmpty();
        })));
    }

    [Fact]
    public void Sweeping_leaves_no_garbage_and_keeps_no_memory()
    {
        var cases = Cases(7, 50).ToArray();
        var taken = 0ul;
        Assert.Equal(0, Garbage.Of(() =>
        {
            foreach (ref readonly var sweep in cases.AsSpan())
            {
                var handler = new Listener();
                maze.Sweep(sweep, ref handler);
            }
            var now = maze.World.Pool.GetTotalAllocatedByteCount();
            Assert.True(taken == 0 || now == taken);
            taken = now;
        }));
    }

    struct Listener : ISweepHitHandler
    {
        public readonly bool AllowTest(CollidableReference collidable) => true;

        public readonly bool AllowTest(CollidableReference collidable, int childIndex) => true;

        public readonly void OnHit(ref float maximumT, float t, Vector3 hitLocation, Vector3 hitNormal, CollidableReference collidable) { }

        public readonly void OnHitAtZeroT(ref float maximumT, CollidableReference collidable) { }
    }

    // Every child by itself, or the shape, without any tree.
    SweptHit? BruteForce(in SweepMaze.Case sweep, CollidableReference collidable, out bool isContainer, int? only = null)
    {
        var children = maze.Children(collidable);
        isContainer = children is not null;
        var motion = maze.MotionOf(sweep, collidable);
        var part = maze.SweptBody(sweep, motion);
        var hit = default(SweepHit);
        foreach (var child in children ?? [0])
        {
            if (only is { } one && child != one)
                continue;
            var core = maze.PieceOf(collidable, child, out var local);
            var body = new ImpactBody(core, local, motion.OrientationB, default);
            part.Restart();
            hit.Test(motion, ref part, ref body, 0, child);
        }
        if (!hit.Exists)
            return null;
        return hit.Overlaps ? new(collidable, 0, default, default)
            : new(collidable, hit.EarliestT, (new DoubleVector3(sweep.Pose.Position) + hit.Place).ToSingle(), hit.Normal.ToSingle());
    }
}
