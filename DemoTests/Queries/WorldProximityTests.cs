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

/// <summary>What is near in a world with everything in it, compared with a loop over all parts of it.</summary>
public sealed class WorldProximityTests : IDisposable
{
    static readonly int caseCount = Environment.GetEnvironmentVariable("PHYSICS_FULL_TESTS") is { Length: > 0 } ? 20_000 : 400;

    readonly SweepMaze maze = new(5);

    public void Dispose() => maze.Dispose();

    static IEnumerable<SweepMaze.Case> Cases(int seed, int count)
    {
        var random = new Random(seed);
        for (int i = 0; i < count; ++i)
        {
            yield return SweepMaze.NextCase(random) with
            {
                MaximumT = random.Next(6) switch { 0 => 0, 1 => float.PositiveInfinity, 2 => 20, _ => random.NextSingle() * 3 }
            };
        }
    }

    List<Proximity> FindNear(in SweepMaze.Case near, SweepMaze? world = null)
    {
        world ??= maze;
        var handler = new ProximityList { Found = [] };
        world.FindNear(near, world.World.Pool, ref handler);
        return handler.Found;
    }

    [Fact]
    public void All_that_is_near_is_that_of_a_loop_over_all_parts()
    {
        int foundCount = 0, childCount = 0, overlapCount = 0;
        foreach (var near in Cases(1, caseCount))
        {
            var found = FindNear(near).ToDictionary(proximity => proximity.Collidable);
            foreach (var collidable in maze.Collidables)
            {
                var expected = BruteForce(near, collidable, found.GetValueOrDefault(collidable).ChildIndex);
                Assert.Equal(expected is not null, found.ContainsKey(collidable));
                if (expected is not { } proximity)
                    continue;
                Assert.Equal(proximity, found[collidable]);
                ++foundCount;
                childCount += proximity.ChildIndex > 0 ? 1 : 0;
                overlapCount += proximity.Overlaps ? 1 : 0;
            }
        }
        Assert.True(foundCount > caseCount && childCount > caseCount / 8 && overlapCount > caseCount / 8, $"{foundCount} {childCount} {overlapCount}");
    }

    [Fact]
    public void The_nearest_is_the_least_of_all_with_the_lowest_reference()
    {
        foreach (var near in Cases(2, caseCount))
        {
            var handler = new NearestProximity();
            maze.FindNear(near, maze.World.Pool, ref handler);
            var all = FindNear(near);
            Assert.Equal(all.Count > 0, handler.Exists);
            if (all.Count > 0)
                Assert.Equal(all.OrderBy(proximity => proximity.Distance).ThenBy(proximity => proximity.Collidable.Packed).First(), handler.Nearest);
        }
    }

    [Fact]
    public void A_world_that_was_made_last_to_first_answers_alike()
    {
        using var reversed = new SweepMaze(5, reversed: true);
        foreach (var near in Cases(3, caseCount / 2))
        {
            Assert.Equal(Told(maze), Told(reversed));

            IEnumerable<(int, Proximity)> Told(SweepMaze world) => FindNear(near, world)
                .Select(found => (world.Names[found.Collidable], found with { Collidable = default })).OrderBy(found => found.Item1);
        }
    }

    [Fact]
    public void What_is_not_allowed_is_not_found()
    {
        foreach (var near in Cases(4, 60))
        {
            var all = FindNear(near);
            foreach (var one in all)
            {
                var handler = new ProximityList { Found = [], Ignored = one.Collidable };
                maze.FindNear(near, maze.World.Pool, ref handler);
                Assert.Equal(all.Where(other => other.Collidable != one.Collidable), handler.Found);
            }
        }
    }

    [Fact]
    public void Of_a_container_only_the_children_that_are_allowed_are_found()
    {
        int count = 0;
        foreach (var near in Cases(5, 30))
        {
            foreach (var one in FindNear(near).Where(found => !found.Overlaps && maze.Children(found.Collidable) is not null))
            {
                var handler = new ProximityList { Found = [], IgnoredChild = one.ChildIndex };
                maze.FindNear(near, maze.World.Pool, ref handler);
                var second = handler.Found.Where(found => found.Collidable == one.Collidable).ToArray();
                Assert.All(second, found => Assert.True(found.Distance >= one.Distance && found.ChildIndex != one.ChildIndex));
                count += second.Length;
            }
        }
        Assert.True(count > 30, $"{count}");
    }

    [Fact]
    public async Task Threads_that_ask_at_once_hear_the_same()
    {
        var cases = Cases(6, 200).ToArray();
        var expected = Array.ConvertAll(cases, near => FindNear(near));
        await Task.WhenAll(Enumerable.Range(0, 4).Select(_ => Task.Run(() =>
        {
            using var pool = new BufferPool();
            for (int i = 0; i < cases.Length; ++i)
            {
                var handler = new ProximityList { Found = [] };
                maze.FindNear(cases[i], pool, ref handler);
                Assert.Equal(expected[i], handler.Found);
            }
            pool.AssertEmpty();
        })));
    }

    [Fact]
    public void Asking_leaves_no_garbage_and_keeps_no_memory()
    {
        var cases = Cases(7, 50).ToArray();
        var taken = 0ul;
        Assert.Equal(0, Garbage.Of(() =>
        {
            foreach (ref readonly var near in cases.AsSpan())
            {
                var handler = new NearestProximity();
                maze.FindNear(near, maze.World.Pool, ref handler);
            }
            var now = maze.World.Pool.GetTotalAllocatedByteCount();
            Assert.True(taken == 0 || now == taken);
            taken = now;
        }));
    }

    [Fact]
    public void A_point_is_as_near_as_a_sphere_without_its_radius()
    {
        const float Radius = .01f;
        int count = 0;
        foreach (var near in Cases(8, caseCount / 4))
        {
            var exists = maze.Simulation.FindNearest(near.Pose.Position, float.PositiveInfinity, maze.World.Pool, out var point);
            Assert.True(maze.Simulation.FindNearest(
                new Sphere(Radius), near.Pose, float.PositiveInfinity, maze.World.Pool, out var sphere) == exists);
            if (!exists || sphere.Overlaps)
                continue;
            Assert.InRange(point.Distance - Radius - sphere.Distance, -1e-6f * point.Distance, 1e-6f * point.Distance);
            Assert.InRange(Vector3.Distance(point.Place, near.Pose.Position), point.Distance * .99999f - 2e-6f, point.Distance * 1.00001f + 2e-6f);
            ++count;
        }
        Assert.True(count > 50, $"{count}");
    }

    [Fact]
    public void A_shape_overlaps_something_if_anything_is_at_no_distance()
    {
        int overlapping = 0;
        foreach (var near in Cases(9, 4 * caseCount))
        {
            if (near.Shape != 0)
                continue;
            var any = maze.Simulation.OverlapsAny(new Sphere(.4f), near.Pose, maze.World.Pool);
            Assert.Equal(FindNear(near with { MaximumT = 0 }).Count > 0, any);
            overlapping += any ? 1 : 0;
        }
        Assert.True(overlapping > 10, $"{overlapping}");
    }

    // Every child by itself, or the shape, without any tree. Where shapes overlap, the child that was told must be one that does.
    Proximity? BruteForce(in SweepMaze.Case near, CollidableReference collidable, int told)
    {
        var position = new DoubleVector3(near.Pose.Position);
        var motion = maze.MotionOf(near with { Velocity = default }, collidable);
        var a = maze.SweptBody(near, motion);
        Proximity? nearest = null;
        var least = double.PositiveInfinity;
        foreach (var child in (maze.Children(collidable) ?? [0]).Order())
        {
            var core = maze.PieceOf(collidable, child, out var local);
            var b = new ImpactBody(core, local, motion.OrientationB, default);
            if (!ImpactPair.FindDistance(ref a, ref b, motion.OffsetB, near.MaximumT, out var found) || found.Distance > least)
                continue;
            if (found.Distance == least && !(found.Overlaps && child == told))
                continue;
            least = found.Distance;
            var distance = (float)least;
            nearest = new()
            {
                Collidable = collidable,
                ChildIndex = child,
                Distance = distance < least ? MathF.BitIncrement(distance) : distance,
                Overlaps = found.Overlaps,
                Place = found.Overlaps ? default : (position + found.Place).ToSingle(),
                Normal = found.Normal.ToSingle(),
            };
        }
        return nearest;
    }

    struct ProximityList : IProximityHandler
    {
        public List<Proximity> Found;
        public CollidableReference? Ignored;
        public int? IgnoredChild;

        public readonly bool AllowTest(CollidableReference collidable) => collidable != Ignored;

        public readonly bool AllowTest(CollidableReference collidable, int childIndex) => childIndex != IgnoredChild;

        public readonly void OnProximity(ref float maximumDistance, in Proximity proximity)
        {
            Assert.InRange(proximity.Distance, 0, maximumDistance);
            Assert.Equal(proximity.Overlaps ? 0 : 1, proximity.Normal.Length(), 1e-6f);
            Found.Add(proximity);
        }
    }
}
