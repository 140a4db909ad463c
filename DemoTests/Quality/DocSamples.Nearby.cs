using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;

namespace DemoTests.Quality;

// Docs/Guides/Nearby.md.
static partial class DocSamples
{
    public static bool CanStand(Simulation simulation, BufferPool pool, Vector3 eye, RigidPose standing)
    {
        // How far it is to the nearest thing, and where that is.
        if (simulation.FindNearest(eye, 5, pool, out var nearest))
            Console.WriteLine($"{nearest.Collidable} is {nearest.Distance} m away, at {nearest.Place}.");

        // Is there room to stand up?
        var canStand = !simulation.OverlapsAny(new Capsule(.4f, 1), standing, pool);
        return canStand;
    }

    struct Nearby(List<Proximity> found) : IProximityHandler
    {
        public readonly List<Proximity> Found = found;

        public readonly bool AllowTest(CollidableReference collidable) => collidable.Mobility == CollidableMobility.Dynamic;

        public readonly bool AllowTest(CollidableReference collidable, int childIndex) => true;

        public readonly void OnProximity(ref float maximumDistance, in Proximity proximity) => Found.Add(proximity);
    }

    public static void Explode(Simulation simulation, BufferPool pool, Vector3 center, float reach, float strength)
    {
        var nearby = new Nearby([]);
        simulation.FindNear(center, reach, pool, ref nearby);
        foreach (var proximity in nearby.Found)
        {
            var body = simulation.Bodies[proximity.Collidable.BodyHandle];
            body.Awake = true;
            var place = proximity.Overlaps ? body.Pose.Position : proximity.Place;
            var away = place - center;
            if (away.LengthSquared() > 0)
                body.ApplyImpulse(Vector3.Normalize(away) * (strength * (1 - proximity.Distance / reach)), place - body.Pose.Position);
        }
    }

    struct WayOut(Vector3 push) : IShapeContactHandler
    {
        public Vector3 Push = push;

        public readonly bool AllowTest(CollidableReference collidable) => collidable.Mobility != CollidableMobility.Dynamic;

        public readonly bool AllowTest(CollidableReference collidable, int childIndex) => true;

        public void OnContacts<TManifold>(CollidableReference collidable, ref TManifold manifold) where TManifold : unmanaged, IContactManifold<TManifold>
        {
            for (int i = 0; i < manifold.Count; ++i)
            {
                var normal = manifold.GetNormal(i);
                Push += normal * MathF.Max(0, manifold.GetDepth(i) - Vector3.Dot(Push, normal));
            }
        }
    }

    public static Vector3 GetOut(Simulation simulation, BufferPool pool, RigidPose pose)
    {
        var way = new WayOut(default);
        simulation.FindContacts(new Capsule(.4f, 1), pose, 0, pool, ref way);
        pose.Position += way.Push;
        return pose.Position;
    }
}
