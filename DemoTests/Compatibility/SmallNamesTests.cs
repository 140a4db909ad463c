using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Constraints;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Memory;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Compatibility;

/// <summary>Names that games use and that are small: each does here what it does there.</summary>
public class SmallNamesTests
{
    [Fact]
    public void Dynamics_of_a_set_are_read_and_written_as_where_they_lie_in_one_place()
    {
        using var world = new TestWorld();
        var handle = world.AddDynamic(new Box(1, 2, 3), 4, new RigidPose(new Vector3(1, 2, 3)));
        var location = world.Bodies[handle].MemoryLocation;
        ref var set = ref world.Bodies.Sets[location.SetIndex];
        Assert.True(set.Allocated);
        Assert.False(default(BodySet).Allocated);

        ref var pose = ref set.DynamicsState[location.Index].Motion.Pose;
        pose.Position.X += 5;
        set.DynamicsState[location.Index].Motion.Velocity.Linear += new Vector3(0, 7, 0);

        Assert.Equal(new Vector3(6, 2, 3), world.Bodies[handle].Pose.Position);
        Assert.Equal(new Vector3(0, 7, 0), world.Bodies[handle].Velocity.Linear);
        Assert.Equal(.25f, set.DynamicsState[location.Index].Inertia.Local.InverseMass);
        world.Step();
        // The world inertia of a body that has not turned.
        var inertia = set.DynamicsState[location.Index].Inertia;
        Assert.Equal(inertia.Local.InverseInertiaTensor, inertia.World.InverseInertiaTensor);
        Assert.True(set.DynamicsState.Length >= set.Count);
    }

    [Fact]
    public void A_matrix_turns_about_an_axis()
    {
        Matrix3x3.CreateFromAxisAngle(Vector3.UnitZ, MathF.PI / 2, out var turn);
        Matrix3x3.Transform(Vector3.UnitX, turn, out var turned);
        Assert.True((turned - Vector3.UnitY).Length() < 1e-6f, $"{turned}");
        Assert.Equal(1, turn.Determinant(), 1e-6f);
        Matrix3x3.CreateScale(new Vector3(2, 3, 4), out var scale);
        Assert.Equal(24, scale.Determinant());
    }

    [Fact]
    public void Rotations_are_taken_apart_as_the_names_say()
    {
        var random = new Random(7);
        for (int i = 0; i < 100; ++i)
        {
            var start = TestWorld.Turn(random);
            var end = TestWorld.Turn(random);
            QuaternionEx.GetRelativeRotationWithoutOverlap(start, end, out var relative);
            AssertSame(end, QuaternionEx.Concatenate(start, relative));
            QuaternionEx.GetLocalRotationWithoutOverlap(end, start, out var local);
            AssertSame(end, QuaternionEx.Concatenate(local, start));
        }
        Assert.Equal(Quaternion.Identity, QuaternionEx.Identity);
    }

    static void AssertSame(Quaternion expected, Quaternion actual) =>
        Assert.True((expected - actual).Length() < 1e-5f, $"{expected} {actual}");

    [Fact]
    public void A_pose_fills_all_lanes()
    {
        var pose = new RigidPose(new Vector3(1, 2, 3), new Quaternion(.5f, .5f, .5f, .5f));
        RigidPoseWide.Broadcast(pose, out var wide);
        for (int lane = 0; lane < Vector<float>.Count; ++lane)
        {
            Assert.Equal(pose.Position, new Vector3(wide.Position.X[lane], wide.Position.Y[lane], wide.Position.Z[lane]));
            Assert.Equal(.5f, wide.Orientation.W[lane]);
        }
    }

    [Fact]
    public void An_element_is_removed_where_it_was_found()
    {
        using var pool = new BufferPool();
        var map = new QuickDictionary<CollidableReference, int, CollidableReferenceComparer>(8, pool);
        var keys = Enumerable.Range(0, 100).Select(i => new CollidableReference(new StaticHandle(i))).ToArray();
        foreach (var key in keys)
            map.Add(key, key.RawHandleValue, pool);

        Assert.True(map.GetTableIndices(keys[10], out var tableIndex, out var index));
        Assert.Throws<ArgumentException>(() => map.FastRemove(tableIndex, index + 1));
        Assert.Throws<ArgumentException>(() => map.FastRemove(-1, index));
        Assert.Throws<ArgumentException>(() => map.FastRemove(tableIndex, 100));
        Assert.Equal(100, map.Count);
        map.FastRemove(tableIndex, index);

        Assert.Equal(99, map.Count);
        Assert.False(map.ContainsKey(keys[10]));
        Assert.All(keys.Where(key => key != keys[10]), key =>
        {
            Assert.True(map.TryGetValue(key, out var value));
            Assert.Equal(key.RawHandleValue, value);
        });
        map.Dispose(pool);
    }

    [Fact]
    public void A_cached_shape_is_added_directly()
    {
        using var pool = new BufferPool();
        using var world = new TestWorld();
        var sphere = world.Simulation.Shapes.Add(new Sphere(.5f));
        var depths = new List<float>();
        var batcher = new CollisionBatcher<DepthReader>(
            pool, world.Simulation.Shapes, world.Simulation.NarrowPhase.CollisionTaskRegistry, 1, new DepthReader(depths));
        QueryOverlap(ref batcher, world.Simulation.Shapes, sphere);
        batcher.Flush();
        Assert.Equal(.25f, Assert.Single(depths), 1e-6f);
        pool.AssertEmpty();
    }

    // As games ask for what a shape touches that is in no simulation: the shape is gone when the pair is tested.
    static unsafe void QueryOverlap(ref CollisionBatcher<DepthReader> batcher, Shapes shapes, TypedIndex other)
    {
        var query = new Sphere(.25f);
        shapes[other.Type]!.GetShapeData(other.Index, out var otherData, out _);
        batcher.CacheShapeB(other.Type, Sphere.Id, &query, sizeof(Sphere), out var cached);
        var none = Quaternion.Identity;
        batcher.AddDirectly(other.Type, Sphere.Id, otherData, cached, new Vector3(.5f, 0, 0), none, none, 0, new PairContinuation(3));
        query = new Sphere(100);
    }

    readonly struct DepthReader(List<float> depths) : ICollisionCallbacks
    {
        public void OnPairCompleted<TManifold>(int pairId, ref TManifold manifold) where TManifold : unmanaged, IContactManifold<TManifold>
        {
            Assert.Equal(3, pairId);
            for (int i = 0; i < manifold.Count; ++i)
                depths.Add(manifold.GetDepth(i));
        }

        public void OnChildPairCompleted(int pairId, int childA, int childB, ref ConvexContactManifold manifold) { }

        public bool AllowCollisionTesting(int pairId, int childA, int childB) => true;
    }

    [Fact]
    public void A_shape_is_asked_about_a_ray_without_a_pool()
    {
        using var world = new TestWorld();
        var shape = world.Simulation.Shapes.Add(new Sphere(1));
        var hits = new NearestHit { T = float.NaN };
        float maximumT = 10;
        world.Simulation.Shapes[shape.Type]!.RayTest(
            shape.Index, new RigidPose(new Vector3(5, 0, 0)), new RayData { Direction = Vector3.UnitX }, ref maximumT, ref hits);
        Assert.Equal(4, hits.T, 1e-5f);
    }

    struct NearestHit : IShapeRayHitHandler
    {
        public float T;

        public readonly bool AllowTest(int childIndex) => true;

        public void OnRayHit(in RayData ray, ref float maximumT, float t, Vector3 normal, int childIndex) => T = t;
    }

    // The order is that of the callbacks, whichever way round a game knows the two.
    [Fact]
    public void Pairs_are_sorted_as_the_narrow_phase_sorts_them()
    {
        CollidableReference[] all =
        [
            new(CollidableMobility.Dynamic, new BodyHandle(3)), new(CollidableMobility.Dynamic, new BodyHandle(8)),
            new(CollidableMobility.Kinematic, new BodyHandle(1)), new(new StaticHandle(0)),
        ];
        for (int first = 0; first < all.Length; ++first)
        {
            for (int second = first + 1; second < all.Length; ++second)
            {
                NarrowPhase.SortCollidableReferencesForPair(all[first], all[second], out var mobilityA, out var mobilityB, out var a, out var b);
                NarrowPhase.SortCollidableReferencesForPair(all[second], all[first], out _, out _, out var c, out var d);
                Assert.Equal((all[first], all[second]), (a, b));
                Assert.Equal((a, b), (c, d));
                Assert.Equal((a.Mobility, b.Mobility), (mobilityA, mobilityB));
            }
        }
    }

    [Fact]
    public void Batched_rays_hit_what_single_ones_hit()
    {
        using var world = new TestWorld();
        for (int i = 0; i < 10; ++i)
            world.AddStatic(new Sphere(.4f), new RigidPose(new Vector3(i, 0, 0)));
        var batched = new Dictionary<int, float>();
        var batcher = new SimulationRayBatcher<RayHits>(world.Pool, world.Simulation, new RayHits(batched), 4);
        for (int i = 0; i < 10; ++i)
        {
            var origin = new Vector3(i + .05f * i, 5, 0);
            var direction = -Vector3.UnitY;
            batcher.Add(ref origin, ref direction, 10, i);
        }
        Assert.NotEmpty(batched);
        batcher.Flush();
        batcher.Dispose();

        var single = new Dictionary<int, float>();
        var hits = new RayHits(single);
        for (int i = 0; i < 10; ++i)
            world.Simulation.RayCast(new Vector3(i + .05f * i, 5, 0), -Vector3.UnitY, 10, world.Pool, ref hits, i);
        Assert.Equal(single, batched);
        Assert.True(single.Count is > 5 and < 10);
    }

    readonly struct RayHits(Dictionary<int, float> found) : IRayHitHandler
    {
        public bool AllowTest(CollidableReference collidable) => true;

        public bool AllowTest(CollidableReference collidable, int childIndex) => true;

        public void OnRayHit(in RayData ray, ref float maximumT, float t, Vector3 normal, CollidableReference collidable, int childIndex) =>
            found[ray.Id] = t;
    }

    // No field of a constraint that is not the library's is known to it: a description may leave out the check, and nothing boxes it.
    [Fact]
    public void A_description_need_not_check_itself_and_is_not_boxed()
    {
        using var world = new TestWorld();
        world.Solver.Register<UncheckedLimit>();
        var body = world.AddDynamic(new Sphere(1), 1, RigidPose.Identity);
        for (int i = 0; i < 100; ++i)
            world.Solver.Remove(world.Solver.Add(body, new UncheckedLimit { MinimumHeight = i }));
        var before = GC.GetAllocatedBytesForCurrentThread();
        ValidateMany(new UncheckedLimit());
        Assert.Equal(0, GC.GetAllocatedBytesForCurrentThread() - before);
    }

    static void ValidateMany<TDescription>(TDescription description) where TDescription : unmanaged, IConstraintDescription<TDescription>
    {
        for (int i = 0; i < 1000; ++i)
            TDescription.Validate(description);
    }
}
