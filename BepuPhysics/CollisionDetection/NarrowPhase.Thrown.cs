using System;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

// What is marked looks around when it is thrown aside within a step, and what sleeps cannot be woken then: it was a wall, and took momentum. So what a marked
// body that is hit may come to in the step, and what that may come to, as balls of a rack, wakes with it.
public sealed unsafe partial class NarrowPhase<TCallbacks>
{
    // How often what is found makes the box larger in which it is looked for.
    const int MostGrowths = 16;

    struct SleeperFinder(NarrowPhase<TCallbacks> narrowPhase, float reach) : IBreakableForEach<CollidableReference>
    {
        public BoundingBox Region;

        public bool LoopBody(CollidableReference collidable)
        {
            if (collidable.Mobility != CollidableMobility.Dynamic || !narrowPhase.Simulation.Bodies.IsAsleep(collidable.Slot))
                return true;
            narrowPhase.Simulation.Awakener.Request(collidable.Slot);
            if (narrowPhase.ContinuityOf(collidable).Mode == ContinuousDetectionMode.Continuous)
                Add(collidable);
            return true;
        }

        public void Add(CollidableReference collidable)
        {
            narrowPhase.Simulation.GetPoseAndShape(collidable, out var pose, out var shape);
            var around = new Vector3(narrowPhase.RadiiOf(shape).Radius + reach);
            Region = new(Exact.Min(Region.Min, pose.Position - around), Exact.Max(Region.Max, pose.Position + around));
        }
    }

    void RequestThrownAt()
    {
        foreach (ref var worker in workers.AsSpan())
        {
            for (int i = 0; i < worker.Fast.Count; ++i)
            {
                var pair = worker.Fast[i].Pair;
                if (!worker.Fast[i].Hits || pair.A.Mobility != CollidableMobility.Dynamic || pair.B.Mobility != CollidableMobility.Dynamic)
                    continue;
                RequestThrownAt(pair.A, pair.B);
                RequestThrownAt(pair.B, pair.A);
            }
        }
    }

    void RequestThrownAt(CollidableReference hit, CollidableReference other)
    {
        if (ContinuityOf(hit).Mode != ContinuousDetectionMode.Continuous)
            return;
        var (velocity, otherVelocity) = (VelocityOf(hit), VelocityOf(other));
        float inverse = InverseMassOf(hit), otherInverse = InverseMassOf(other);
        if (!(inverse > 0))
            return;
        // What an elastic hit straight on gives at most.
        var speed = Exact.Length(velocity.Linear) + 2 * Exact.Length(velocity.Linear - otherVelocity.Linear) * (inverse / (inverse + otherInverse));
        var empty = new BoundingBox(new(float.MaxValue), new(float.MinValue));
        var finder = new SleeperFinder(this, speed * workers[0].Batcher.Dt) { Region = empty };
        finder.Add(hit);
        for (int i = 0; i < MostGrowths; ++i)
        {
            var known = finder.Region;
            Simulation.BroadPhase.FindOverlapping(known, ref finder);
            if (finder.Region.Min == known.Min && finder.Region.Max == known.Max)
                return;
        }
    }

    float InverseMassOf(CollidableReference collidable)
    {
        ref var location = ref Simulation.Bodies.Locations[collidable.Slot];
        return Simulation.Bodies.SetOf(location).LocalInertias[location.Index].InverseMass;
    }
}
