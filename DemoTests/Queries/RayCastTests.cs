using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using System.Threading;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Trees;
using BepuUtilities.Memory;
using Demos.Accuracy;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Queries;

/// <summary>Rays against everything in a simulation, compared with a loop over all of it.</summary>
public sealed class RayCastTests : IDisposable
{
    const int RayCount = 300;
    readonly TestWorld world = new(new AccuracySettings { Contacts = ContactScope.None });
    readonly Random random = new(12);
    readonly List<CollidableReference> collidables = [];

    readonly record struct Hit(CollidableReference Collidable, float T, Vector3 Normal);

    // Keeps all hits, or only the nearest.
    struct Collector(List<Hit> hits, bool nearestOnly, CollidableMobility? ignored = null) : IRayHitHandler
    {
        public int Calls;

        public readonly bool AllowTest(CollidableReference collidable) => collidable.Mobility != ignored;

        public readonly bool AllowTest(CollidableReference collidable, int childIndex) => throw new InvalidOperationException("These shapes have no children.");

        public void OnRayHit(in RayData ray, ref float maximumT, float t, Vector3 normal, CollidableReference collidable, int childIndex)
        {
            ++Calls;
            Assert.Equal((0, 77), (childIndex, ray.Id));
            Assert.InRange(t, 0, maximumT);
            if (nearestOnly)
            {
                hits.Clear();
                maximumT = t;
            }
            hits.Add(new Hit(collidable, t, normal));
        }
    }

    public RayCastTests()
    {
        for (int i = 0; i < 120; ++i)
        {
            Add(new Sphere(.3f + random.NextSingle()), i);
            Add(new Capsule(.2f + random.NextSingle(), 2 * random.NextSingle()), i + 1);
            Add(new Box(.3f + random.NextSingle(), .3f + 2 * random.NextSingle(), .3f + random.NextSingle()), i + 2);
        }
    }

    public void Dispose() => world.Dispose();

    [Fact]
    public void All_hits_are_those_of_a_loop_over_all_collidables()
    {
        AssertLikeBruteForce();
        // Bodies that move freely stay within the bounds that the step gave them.
        for (int i = 0; i < 3; ++i)
        {
            world.Step();
            AssertLikeBruteForce();
        }
        for (int i = 0; i < 60; ++i)
            Remove(random.Next(collidables.Count));
        AssertLikeBruteForce();
    }

    [Fact]
    public void The_nearest_hit_is_that_of_a_loop_over_all_collidables()
    {
        for (int i = 0; i < RayCount; ++i)
        {
            NextRay(out var origin, out var direction, out var maximumT);
            var all = BruteForce(origin, direction, maximumT);
            var nearest = Cast(origin, direction, maximumT, nearestOnly: true);
            Assert.Equal(all.Count > 0 ? 1 : 0, nearest.Count);
            if (all.Count > 0)
                Assert.Equal(all.Min(hit => hit.T), nearest[0].T);
        }
    }

    [Theory]
    [InlineData(CollidableMobility.Dynamic)]
    [InlineData(CollidableMobility.Kinematic)]
    [InlineData(CollidableMobility.Static)]
    public void What_is_not_allowed_is_not_hit(CollidableMobility ignored)
    {
        int hitCount = 0;
        for (int i = 0; i < RayCount; ++i)
        {
            NextRay(out var origin, out var direction, out var maximumT);
            var expected = BruteForce(origin, direction, maximumT).FindAll(hit => hit.Collidable.Mobility != ignored);
            AssertSame(expected, Cast(origin, direction, maximumT, ignored: ignored));
            hitCount += expected.Count;
        }
        Assert.True(hitCount > 50);
    }

    [Fact]
    public void A_body_that_was_moved_by_hand_is_found_when_its_bounds_were_updated()
    {
        var moved = collidables.First(collidable => collidable.Mobility == CollidableMobility.Dynamic).BodyHandle;
        world.Step();
        world.Bodies[moved].Pose.Position = new Vector3(500, 0, 0);
        world.Bodies[moved].UpdateBounds();

        var hits = Cast(new Vector3(500, 50, 0), -Vector3.UnitY, 100);

        Assert.Equal(moved, Assert.Single(hits).Collidable.BodyHandle);
        world.Simulation.Validate();
        world.Bodies.GetDescription(moved, out var description);
        description.Pose.Position = new Vector3(0, 500, 0);
        world.Bodies.ApplyDescription(moved, description);
        Assert.Single(Cast(new Vector3(-50, 500, 0), Vector3.UnitX, 100));
        Assert.Empty(Cast(new Vector3(500, 50, 0), -Vector3.UnitY, 100));
        world.Simulation.Validate();
    }

    [Fact]
    public void Threads_may_ask_at_the_same_time()
    {
        var rays = new (Vector3 Origin, Vector3 Direction, float Length)[RayCount];
        foreach (ref var ray in rays.AsSpan())
            NextRay(out ray.Origin, out ray.Direction, out ray.Length);
        var expected = rays.Select(ray => Cast(ray.Origin, ray.Direction, ray.Length)).ToArray();
        var found = new List<Hit>[4][];
        var threads = new Thread[4];
        for (int i = 0; i < threads.Length; ++i)
        {
            int thread = i;
            threads[i] = new Thread(() =>
            {
                var pool = new BufferPool();
                found[thread] = [.. rays.Select(ray => Cast(ray.Origin, ray.Direction, ray.Length, pool: pool))];
                pool.AssertEmpty();
                pool.Clear();
            });
            threads[i].Start();
        }
        foreach (var thread in threads)
            thread.Join();
        foreach (var hits in found)
            Assert.Equal(expected, hits);
    }

    [Fact]
    public void The_handler_comes_back_with_what_it_counted()
    {
        var hits = new List<Hit>();
        var collector = new Collector(hits, nearestOnly: false);
        var target = PoseOf(collidables[7]).Position;
        world.Simulation.RayCast(target - 50 * Vector3.UnitX, Vector3.UnitX, 100, world.Pool, ref collector, 77);
        Assert.Equal(hits.Count, collector.Calls);
        Assert.NotEmpty(hits);
    }

    [Fact]
    public void Rays_that_are_none_are_refused_and_a_direction_of_zero_hits_nothing()
    {
        Assert.Throws<ArgumentException>(() => Cast(new Vector3(float.NaN, 0, 0), Vector3.UnitX, 1));
        Assert.Throws<ArgumentException>(() => Cast(default, new Vector3(0, float.PositiveInfinity, 0), 1));
        Assert.Throws<ArgumentOutOfRangeException>(() => Cast(default, Vector3.UnitX, -1));
        Assert.Throws<ArgumentOutOfRangeException>(() => Cast(default, Vector3.UnitX, float.NaN));
        var collector = new Collector([], nearestOnly: false);
        Assert.Throws<ArgumentNullException>(() => world.Simulation.RayCast(default, Vector3.UnitX, 1, null!, ref collector));
        Assert.Empty(Cast(default, Vector3.Zero, float.PositiveInfinity));
        Assert.NotEmpty(Cast(PoseOf(collidables[7]).Position - 50 * Vector3.UnitX, Vector3.UnitX, float.PositiveInfinity));
    }

    [Fact]
    public void A_disposed_simulation_is_refused()
    {
        var gone = new TestWorld();
        gone.Dispose();
        var collector = new Collector([], nearestOnly: false);
        Assert.Throws<ObjectDisposedException>(() => gone.Simulation.RayCast(default, Vector3.UnitX, 1, world.Pool, ref collector));
    }

    void Add<TShape>(in TShape shape, int number) where TShape : unmanaged, IConvexShape
    {
        var pose = new RigidPose(TestWorld.Scatter(random, 30), TestWorld.Turn(random));
        collidables.Add((number % 3) switch
        {
            0 => new(CollidableMobility.Dynamic, world.AddDynamic(
                shape, 1, pose, new BodyVelocity(TestWorld.Scatter(random, 8), TestWorld.Scatter(random, 8)))),
            1 => new(CollidableMobility.Kinematic, world.AddKinematic(shape, pose)),
            _ => new(world.AddStatic(shape, pose)),
        });
    }

    void Remove(int index)
    {
        if (collidables[index].Mobility == CollidableMobility.Static)
            world.Statics.Remove(collidables[index].StaticHandle);
        else
            world.Bodies.Remove(collidables[index].BodyHandle);
        collidables.RemoveAt(index);
    }

    void NextRay(out Vector3 origin, out Vector3 direction, out float maximumT)
    {
        // Past the centre of one of the collidables, some along an axis, of any length.
        var target = PoseOf(collidables[random.Next(collidables.Count)]).Position;
        origin = TestWorld.Scatter(random, 50);
        if (random.Next(5) == 0)
            origin = target - new Vector3(0, 30, 0);
        else
            target += TestWorld.Scatter(random, 2);
        direction = target - origin;
        direction *= MathF.Pow(10, random.Next(-2, 3)) / direction.Length();
        maximumT = random.Next(4) == 0 ? 20 * random.NextSingle() / direction.Length() : 100 / direction.Length();
    }

    void AssertLikeBruteForce()
    {
        int hitCount = 0;
        for (int i = 0; i < RayCount; ++i)
        {
            NextRay(out var origin, out var direction, out var maximumT);
            var expected = BruteForce(origin, direction, maximumT);
            AssertSame(expected, Cast(origin, direction, maximumT));
            hitCount += expected.Count;
        }
        Assert.InRange(hitCount, 100, int.MaxValue);
    }

    static void AssertSame(List<Hit> expected, List<Hit> actual)
    {
        Assert.Equal(Sorted(expected), Sorted(actual));
        static Hit[] Sorted(List<Hit> hits) => [.. hits.OrderBy(hit => hit.Collidable.Packed)];
    }

    List<Hit> Cast(Vector3 origin, Vector3 direction, float maximumT, bool nearestOnly = false, CollidableMobility? ignored = null, BufferPool? pool = null)
    {
        var hits = new List<Hit>();
        var collector = new Collector(hits, nearestOnly, ignored);
        world.Simulation.RayCast(origin, direction, maximumT, pool ?? world.Pool, ref collector, 77);
        return hits;
    }

    RigidPose PoseOf(CollidableReference collidable) => collidable.Mobility == CollidableMobility.Static
        ? world.Statics[collidable.StaticHandle].Pose : world.Bodies[collidable.BodyHandle].Pose;

    List<Hit> BruteForce(Vector3 origin, Vector3 direction, float maximumT)
    {
        var hits = new List<Hit>();
        foreach (var collidable in collidables)
        {
            var pose = PoseOf(collidable);
            var shape = collidable.Mobility == CollidableMobility.Static
                ? world.Statics[collidable.StaticHandle].Shape
                : world.Bodies[collidable.BodyHandle].Collidable.Shape;
            float t;
            Vector3 normal;
            bool isHit = shape.Type switch
            {
                0 => world.Simulation.Shapes.GetShape<Sphere>(shape.Index).RayTest(pose, origin, direction, out t, out normal),
                1 => world.Simulation.Shapes.GetShape<Capsule>(shape.Index).RayTest(pose, origin, direction, out t, out normal),
                _ => world.Simulation.Shapes.GetShape<Box>(shape.Index).RayTest(pose, origin, direction, out t, out normal),
            };
            if (isHit && t <= maximumT)
                hits.Add(new Hit(collidable, t, normal));
        }
        return hits;
    }
}
