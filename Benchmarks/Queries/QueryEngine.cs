using System;
using System.Numerics;
using Benchmarks.Queries.Shared;
using Benchmarks.Sweeps.Shared;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities;

namespace Benchmarks.Queries;

/// <summary>Asks this engine.</summary>
static class QueryEngine
{
    /// <summary>How to ask; null for what the engine cannot be asked.</summary>
    public static QuickestTime.Question? Create(SweepWorld world, string query, string shape) => shape switch
    {
        "ray" => CreateRay(world, query),
        "point" => (in SweepWorld.Case place) =>
            world.Simulation.FindNearest(place.Pose.Position, QueryNames.Reach, world.Pool, out _) ? 1 : 0,
        "sphere" => Create(world, query, SweepWorld.Sphere),
        "box" => Create(world, query, SweepWorld.Box),
        "hull" => Create(world, query, world.Hull),
        _ => null,
    };

    static QuickestTime.Question CreateRay(SweepWorld world, string query)
    {
        if (query == QueryNames.FirstHit)
            return (in SweepWorld.Case ray) => world.Simulation.RayCast(ray.Pose.Position, ray.Velocity.Linear, 1, world.Pool, out _) ? 1 : 0;
        return (in SweepWorld.Case ray) =>
        {
            Span<RayHit> hits = stackalloc RayHit[QueryNames.HitCount];
            return world.Simulation.RayCastAll(ray.Pose.Position, ray.Velocity.Linear, 1, world.Pool, hits);
        };
    }

    static QuickestTime.Question? Create<TShape>(SweepWorld world, string query, TShape shape) where TShape : unmanaged, IConvexShape => query switch
    {
        QueryNames.Bounds => (in SweepWorld.Case place) => CountBounds(world, place),
        QueryNames.Overlap => (in SweepWorld.Case place) => world.Simulation.OverlapsAny(shape, place.Pose, world.Pool) ? 1 : 0,
        QueryNames.Contacts => (in SweepWorld.Case place) => CountContacts(world, shape, place),
        QueryNames.Nearest => (in SweepWorld.Case place) =>
            world.Simulation.FindNearest(shape, place.Pose, QueryNames.Reach, world.Pool, out _) ? 1 : 0,
        _ => null,
    };

    static int CountBounds(SweepWorld world, in SweepWorld.Case place)
    {
        var counter = new Counter();
        var half = new Vector3(QueryNames.HalfWidth);
        world.Simulation.BroadPhase.GetOverlaps(place.Pose.Position - half, place.Pose.Position + half, world.Pool, ref counter);
        return counter.Count;
    }

    static int CountContacts<TShape>(SweepWorld world, in TShape shape, in SweepWorld.Case place) where TShape : unmanaged, IConvexShape
    {
        var counter = new Counter();
        world.Simulation.FindContacts(shape, place.Pose, 0, world.Pool, ref counter);
        return counter.Count;
    }

    struct Counter : IBreakableForEach<CollidableReference>, IShapeContactHandler
    {
        public int Count;

        public bool LoopBody(CollidableReference collidable)
        {
            ++Count;
            return true;
        }

        public readonly bool AllowTest(CollidableReference collidable) => true;

        public readonly bool AllowTest(CollidableReference collidable, int childIndex) => true;

        public void OnContacts<TManifold>(CollidableReference collidable, ref TManifold manifold) where TManifold : unmanaged, IContactManifold<TManifold> =>
            Count += manifold.Count;
    }
}
