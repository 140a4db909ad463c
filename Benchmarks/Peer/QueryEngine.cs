using System;
using System.Numerics;
using Benchmarks.Queries.Shared;
using Benchmarks.Sweeps.Shared;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Trees;
using BepuUtilities;

namespace Benchmarks.Queries;

/// <summary>Asks bepuphysics2, by what a game has to write for it.</summary>
static class QueryEngine
{
    /// <summary>How to ask; null for what the engine cannot be asked: it has no distances.</summary>
    public static QuickestTime.Question? Create(SweepWorld world, string query, string shape) => query switch
    {
        QueryNames.FirstHit => (in SweepWorld.Case ray) =>
        {
            var nearest = new NearestRayHit();
            world.Simulation.RayCast(ray.Pose.Position, ray.Velocity.Linear, 1, world.Pool, ref nearest);
            return nearest.Count;
        },
        QueryNames.AllHits => CreateAllHits(world),
        QueryNames.Bounds => (in SweepWorld.Case place) =>
        {
            var counter = new BoundsCounter();
            var half = new Vector3(QueryNames.HalfWidth);
            world.Simulation.BroadPhase.GetOverlaps(place.Pose.Position - half, place.Pose.Position + half, world.Pool, ref counter);
            return counter.Count;
        },
        // A sweep that takes no time.
        QueryNames.Overlap => (in SweepWorld.Case place) => world.Sweep(shape, new(place.Pose, default), 0).IsHit ? 1 : 0,
        QueryNames.Contacts => CreateContacts(world, AddShape(world, shape)),
        _ => null,
    };

    static QuickestTime.Question CreateAllHits(SweepWorld world)
    {
        var times = new float[4 * QueryNames.HitCount];
        var hits = new RayHit[times.Length];
        return (in SweepWorld.Case ray) =>
        {
            var list = new RayHitList { Times = times, Hits = hits };
            world.Simulation.RayCast(ray.Pose.Position, ray.Velocity.Linear, 1, world.Pool, ref list);
            times.AsSpan(0, list.Count).Sort(hits.AsSpan(0, list.Count));
            return Math.Min(list.Count, QueryNames.HitCount);
        };
    }

    static TypedIndex AddShape(SweepWorld world, string shape) => shape switch
    {
        "sphere" => world.Simulation.Shapes.Add(SweepWorld.Sphere),
        "box" => world.Simulation.Shapes.Add(SweepWorld.Box),
        _ => world.Simulation.Shapes.Add(world.Hull),
    };

    static QuickestTime.Question CreateContacts(SweepWorld world, TypedIndex shape) => (in SweepWorld.Case place) =>
    {
        var simulation = world.Simulation;
        var batcher = new CollisionBatcher<ContactCounter>(
            world.Pool, simulation.Shapes, simulation.NarrowPhase.CollisionTaskRegistry, 0, new ContactCounter());
        simulation.Shapes.UpdateBounds(place.Pose, shape, out var bounds);
        var tester = new BoundsTester { Simulation = simulation, Batcher = batcher, Shape = shape, Pose = place.Pose };
        simulation.BroadPhase.GetOverlaps(bounds.Min, bounds.Max, world.Pool, ref tester);
        tester.Batcher.Flush();
        return tester.Batcher.Callbacks.Count;
    };

    readonly record struct RayHit(CollidableReference Collidable, int ChildIndex, Vector3 Normal);

    struct NearestRayHit : IRayHitHandler
    {
        public int Count;

        public readonly bool AllowTest(CollidableReference collidable) => true;

        public readonly bool AllowTest(CollidableReference collidable, int childIndex) => true;

        public void OnRayHit(in RayData ray, ref float maximumT, float t, Vector3 normal, CollidableReference collidable, int childIndex)
        {
            maximumT = t;
            Count = 1;
        }
    }

    struct RayHitList : IRayHitHandler
    {
        public float[] Times;
        public RayHit[] Hits;
        public int Count;

        public readonly bool AllowTest(CollidableReference collidable) => true;

        public readonly bool AllowTest(CollidableReference collidable, int childIndex) => true;

        public void OnRayHit(in RayData ray, ref float maximumT, float t, Vector3 normal, CollidableReference collidable, int childIndex)
        {
            if (Count == Times.Length)
                return;
            Times[Count] = t;
            Hits[Count++] = new(collidable, childIndex, normal);
        }
    }

    struct BoundsCounter : IBreakableForEach<CollidableReference>
    {
        public int Count;

        public bool LoopBody(CollidableReference collidable)
        {
            ++Count;
            return true;
        }
    }

    struct BoundsTester : IBreakableForEach<CollidableReference>
    {
        public Simulation Simulation;
        public CollisionBatcher<ContactCounter> Batcher;
        public TypedIndex Shape;
        public RigidPose Pose;

        public bool LoopBody(CollidableReference collidable)
        {
            ref var other = ref Simulation.Statics.GetDirectReference(collidable.StaticHandle);
            Batcher.Add(other.Shape, Shape, Pose.Position - other.Pose.Position, other.Pose.Orientation, Pose.Orientation, 0, new PairContinuation(0));
            return true;
        }
    }

    struct ContactCounter : ICollisionCallbacks
    {
        public int Count;

        public readonly bool AllowCollisionTesting(int pairId, int childA, int childB) => true;

        public readonly void OnChildPairCompleted(int pairId, int childA, int childB, ref ConvexContactManifold manifold)
        {
        }

        public void OnPairCompleted<TManifold>(int pairId, ref TManifold manifold) where TManifold : unmanaged, IContactManifold<TManifold> =>
            Count += manifold.Count;
    }
}
