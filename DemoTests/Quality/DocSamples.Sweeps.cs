using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuUtilities.Memory;

namespace DemoTests.Quality;

// Docs/Guides/Sweeps.md.
static partial class DocSamples
{
    public static Vector3 Walk(Simulation simulation, BufferPool pool, RigidPose pose, Vector3 walking)
    {
        var nearest = new NearestSweepHit();
        simulation.Sweep(new Capsule(.4f, 1), pose, new BodyVelocity(walking), 1 / 60f, pool, ref nearest);
        if (nearest.Exists)
            pose.Position += walking * nearest.T;
        return pose.Position;
    }

    struct NearestSweepHit : ISweepHitHandler
    {
        public bool Exists;
        public float T;
        public Vector3 Normal;
        public CollidableReference Collidable;

        public readonly bool AllowTest(CollidableReference collidable) => true;

        public readonly bool AllowTest(CollidableReference collidable, int childIndex) => true;

        public void OnHit(ref float maximumT, float t, Vector3 hitLocation, Vector3 hitNormal, CollidableReference collidable)
        {
            maximumT = t;
            (Exists, T, Normal, Collidable) = (true, t, hitNormal, collidable);
        }

        public void OnHitAtZeroT(ref float maximumT, CollidableReference collidable)
        {
            maximumT = 0;
            (Exists, T, Normal, Collidable) = (true, 0, default, collidable);
        }
    }
}
