using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Trees;
using Demos.Accuracy;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Queries;

/// <summary>Rays without a handler: the first hit, and all in order.</summary>
public sealed class RayHitTests : IDisposable
{
    readonly TestWorld world = new(new AccuracySettings { Contacts = ContactScope.None });

    public void Dispose() => world.Dispose();

    // Everything that a handler hears of, in the order that is promised.
    struct Everything(List<RayHit> hits) : IRayHitHandler
    {
        public readonly bool AllowTest(CollidableReference collidable) => true;

        public readonly bool AllowTest(CollidableReference collidable, int childIndex) => true;

        public readonly void OnRayHit(in RayData ray, ref float maximumT, float t, Vector3 normal, CollidableReference collidable, int childIndex) =>
            hits.Add(new() { Collidable = collidable, ChildIndex = childIndex, T = t, Normal = normal, Place = ray.Origin + ray.Direction * t });
    }

    static RayHit[] Expected(TestWorld world, Vector3 origin, Vector3 direction, float maximumT)
    {
        var hits = new List<RayHit>();
        var handler = new Everything(hits);
        world.Simulation.RayCast(origin, direction, maximumT, world.Pool, ref handler);
        return [.. hits.OrderBy(hit => hit.T).ThenBy(hit => hit.Collidable.Packed).ThenBy(hit => hit.ChildIndex)];
    }

    RayHit[] All(Vector3 origin, Vector3 direction, float maximumT, CollisionLayers? layers = null)
    {
        var hits = new RayHit[64];
        return hits[..world.Simulation.RayCastAll(origin, direction, maximumT, world.Pool, hits, layers)];
    }

    [Fact]
    public void A_ray_through_spheres_in_a_row_hits_them_where_their_radii_say()
    {
        var far = world.AddStatic(new Sphere(2), new Vector3(0, 0, 20));
        var near = world.AddKinematic(new Sphere(1), new Vector3(0, 0, 5));
        var middle = world.AddDynamic(new Sphere(.5f), 1, new Vector3(0, 0, 10));
        world.AddStatic(new Sphere(1), new Vector3(0, 5, 10));

        Assert.True(world.Simulation.RayCast(default, new Vector3(0, 0, 2), 100, world.Pool, out var hit));
        var all = All(default, new Vector3(0, 0, 2), 100);

        Assert.Equal(near, hit.Collidable.BodyHandle);
        Assert.Equal(2, hit.T, 1e-6f);
        Assert.InRange(Vector3.Distance(new(0, 0, 4), hit.Place), 0, 1e-6f);
        Assert.Equal(-Vector3.UnitZ, hit.Normal);
        Assert.Equal([2, 4.75f, 9], all.Select(one => one.T));
        Assert.Equal(hit, all[0]);
        Assert.Equal(middle, all[1].Collidable.BodyHandle);
        Assert.Equal(far, all[2].Collidable.StaticHandle);
    }

    static Vector3 PoseOf(TestWorld world, CollidableReference collidable) => collidable.Mobility == CollidableMobility.Static
        ? world.Statics[collidable.StaticHandle].Pose.Position
        : world.Bodies[collidable.BodyHandle].Pose.Position;

    [Theory]
    [InlineData(1)]
    [InlineData(2)]
    public void In_a_world_of_everything_hits_are_those_that_a_handler_hears_of_in_order(int seed)
    {
        using var maze = new SweepMaze(seed);
        var random = new Random(seed);
        int hitCount = 0, childCount = 0;
        var room = new RayHit[64];
        for (int i = 0; i < 1000; ++i)
        {
            var origin = TestWorld.Scatter(random, 3 * SweepMaze.Extent);
            var target = PoseOf(maze.World, maze.Collidables[random.Next(maze.Collidables.Count)]) + TestWorld.Scatter(random, 2);
            var direction = (target - origin) * MathF.Pow(10, random.Next(-2, 3));
            var maximumT = random.Next(3) switch { 0 => float.PositiveInfinity, 1 => 5 / direction.Length(), _ => 30 / direction.Length() };
            var expected = Expected(maze.World, origin, direction, maximumT);

            var isHit = maze.Simulation.RayCast(origin, direction, maximumT, maze.World.Pool, out var hit);
            var count = maze.Simulation.RayCastAll(origin, direction, maximumT, maze.World.Pool, room);
            Assert.Equal(expected, room[..count]);
            Assert.Equal(expected.Length > 0, isHit);
            Assert.Equal(expected.FirstOrDefault(), hit);
            // With less room the nearest ones are told.
            var less = random.Next(1, 5);
            Assert.Equal(
                expected.Take(less), room[..maze.Simulation.RayCastAll(origin, direction, maximumT, maze.World.Pool, room.AsSpan(0, less))]);
            hitCount += count;
            childCount += expected.Count(one => one.ChildIndex > 0);
        }
        Assert.True(hitCount > 400);
        Assert.True(childCount > 20);
    }

    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void Of_hits_at_the_same_place_the_lowest_reference_is_first_whatever_the_order_of_the_tree(bool reversed)
    {
        // Tiles that overlap their neighbours, twice over, and rays through four of them.
        const int size = 8;
        var places = Enumerable.Range(0, 2 * size * size).Select(i => new Vector3(i % size, 0, i / size % size)).ToArray();
        if (reversed)
            Array.Reverse(places);
        foreach (var place in places)
            world.AddStatic(new Box(1.5f, 1, 1.5f), place);
        for (int x = 0; x < size - 1; ++x)
        {
            for (int z = 0; z < size - 1; ++z)
            {
                var origin = new Vector3(x + .5f, 7.3f, z + .5f);
                var all = All(origin, -Vector3.UnitY, 100);

                Assert.Equal(8, all.Length);
                Assert.All(all, hit => Assert.Equal(all[0].T, hit.T));
                Assert.Equal(all.OrderBy(hit => hit.Collidable.Packed), all);
                Assert.True(world.Simulation.RayCast(origin, -Vector3.UnitY, 100, world.Pool, out var first));
                Assert.Equal(all[0], first);
            }
        }
    }

    [Fact]
    public void Layers_leave_out_what_they_do_not_meet()
    {
        var glass = world.AddStatic(new Box(4, 4, .1f), new Vector3(0, 0, 2));
        var wall = world.AddStatic(new Box(4, 4, .1f), new Vector3(0, 0, 4));
        world.Simulation.Layers[glass] = new(2, uint.MaxValue);
        var opaque = new CollisionLayers(uint.MaxValue, ~2u);

        Assert.True(world.Simulation.RayCast(default, Vector3.UnitZ, 10, world.Pool, out var hit, opaque));
        Assert.Equal(wall, hit.Collidable.StaticHandle);
        Assert.Equal([hit], All(default, Vector3.UnitZ, 10, opaque));
        Assert.True(world.Simulation.RayCast(default, Vector3.UnitZ, 10, world.Pool, out hit));
        Assert.Equal(glass, hit.Collidable.StaticHandle);
        Assert.False(world.Simulation.RayCast(default, Vector3.UnitZ, 10, world.Pool, out _, CollisionLayers.Nothing));
    }

    [Fact]
    public void Nothing_is_hit_beyond_the_length_before_the_start_or_in_no_direction()
    {
        world.AddStatic(new Sphere(1), new Vector3(0, 0, 5));

        Assert.False(world.Simulation.RayCast(default, Vector3.UnitZ, 3.99f, world.Pool, out var hit));
        Assert.Equal(default, hit);
        Assert.True(world.Simulation.RayCast(default, Vector3.UnitZ, 4, world.Pool, out _));
        Assert.False(world.Simulation.RayCast(default, -Vector3.UnitZ, float.PositiveInfinity, world.Pool, out _));
        Assert.False(world.Simulation.RayCast(new(0, 0, 5), Vector3.Zero, float.PositiveInfinity, world.Pool, out _));
        Assert.Empty(All(default, Vector3.UnitZ, 3.99f));
        Assert.True(world.Simulation.RayCast(new(0, 0, 5), Vector3.UnitZ, 0, world.Pool, out hit));
        Assert.Equal(0, hit.T);
    }

    [Fact]
    public void What_cannot_be_asked_is_refused()
    {
        Assert.Throws<ArgumentException>(() => All(new(float.NaN, 0, 0), Vector3.UnitX, 1));
        Assert.Throws<ArgumentException>(() => All(default, new(0, float.PositiveInfinity, 0), 1));
        Assert.Throws<ArgumentOutOfRangeException>(() => All(default, Vector3.UnitX, -1));
        Assert.Throws<ArgumentOutOfRangeException>(() => world.Simulation.RayCast(default, Vector3.UnitX, float.NaN, world.Pool, out _));
        Assert.Throws<ArgumentNullException>(() => world.Simulation.RayCast(default, Vector3.UnitX, 1, null!, out _));
        var error = Assert.Throws<ArgumentException>(() => world.Simulation.RayCastAll(default, Vector3.UnitX, 1, world.Pool, []));
        Assert.Equal("hits", error.ParamName);
    }

    [Fact]
    public void Rays_make_no_garbage()
    {
        for (int i = 0; i < 10; ++i)
            world.AddStatic(new Sphere(1), new Vector3(0, 0, 3 * i));
        Span<RayHit> hits = stackalloc RayHit[4];
        long allocated = 0;
        for (int i = 0; i < 3; ++i)
        {
            var before = GC.GetAllocatedBytesForCurrentThread();
            world.Simulation.RayCast(new(0, 0, -5), Vector3.UnitZ, 100, world.Pool, out _);
            world.Simulation.RayCastAll(new(0, 0, -5), Vector3.UnitZ, 100, world.Pool, hits, CollisionLayers.Everything);
            allocated = GC.GetAllocatedBytesForCurrentThread() - before;
        }
        Assert.Equal(0, allocated);
    }
}
