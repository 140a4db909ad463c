using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Trees;
using BepuUtilities.Memory;

namespace DemoTests.Quality;

// Docs/Guides/Rays.md.
static partial class DocSamples
{
    public static RayHit Look(Simulation simulation, BufferPool pool, Vector3 eye, Vector3 looking)
    {
        if (simulation.RayCast(eye, looking, 100, pool, out var seen))
            Console.WriteLine($"{seen.Collidable} is hit at {seen.Place}, where its surface looks along {seen.Normal}.");
        return seen;
    }

    public static int Shoot(Simulation simulation, BufferPool pool, Vector3 muzzle, Vector3 shooting, float strength, CollisionLayers bullets)
    {
        Span<RayHit> hits = stackalloc RayHit[3];
        var count = simulation.RayCastAll(muzzle, shooting, 500, pool, hits, bullets);
        foreach (ref var hit in hits[..count])
        {
            if (hit.Collidable.Mobility != CollidableMobility.Dynamic)
                break;
            var body = simulation.Bodies[hit.Collidable.BodyHandle];
            body.Awake = true;
            body.ApplyImpulse(shooting * strength, hit.Place - body.Pose.Position);
            strength *= .5f;
        }
        return count;
    }

    struct IsBlocked(CollidableReference self) : IRayHitHandler
    {
        public bool Answer;

        public readonly bool AllowTest(CollidableReference collidable) => collidable.Packed != self.Packed;

        public readonly bool AllowTest(CollidableReference collidable, int childIndex) => true;

        public void OnRayHit(in RayData ray, ref float maximumT, float t, Vector3 normal, CollidableReference collidable, int childIndex)
        {
            Answer = true;
            maximumT = 0;
        }
    }

    public static bool IsWayBlocked(Simulation simulation, BufferPool pool, CollidableReference self, Vector3 eye, Vector3 target)
    {
        var blocked = new IsBlocked(self);
        simulation.RayCast(eye, target - eye, 1, pool, ref blocked);
        return blocked.Answer;
    }
}
