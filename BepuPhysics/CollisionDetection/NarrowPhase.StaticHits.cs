using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Constraints.Contact;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

// What lies on one static and is stopped by another, as a plate that slides to a lip, is hit by both at once: the wall turns its edge down, which the floor
// does not let happen. One sweep makes them one after the other, so that the edge goes down at the speed of the impact for a substep, and is pushed out of the
// floor at a part of that speed, however short the substep is: it keeps what it was pushed out with. So such impacts are made exactly, by the stage of
// bounces, as those of thin things are: in turn, until neither approaches.
//
// Only edges that hit what stands: what is round climbs, and a corner that is alone is not held.
public sealed unsafe partial class NarrowPhase<TCallbacks>
{
    // Part of its distance from the centre of its body by which a contact that is hit comes nearer in the step, at least: what is slower hardly differs.
    const float LeastHit = 2e-2f;
    // Cosine of the least angle between the two that is a corner.
    const float Across = .9f;
    // Part of that distance by which contacts that are hit may be above what holds the body: a higher wall holds it up itself.
    const float LowestWall = .1f;

    // Contacts of an edge.
    const int LeastEdgeCount = 2;

    /// <summary>Watches the pairs of a body that is hit by one of them while another holds it.</summary>
    void WatchHits(ref Worker worker, in AgreeingBody body)
    {
        if (!TryFindHit(body, out var hit) || !IsHeldAcross(worker.Statics, body, hit))
            return;
        for (int i = body.First; i < body.End; ++i)
        {
            if (HasContacts(i))
                Note(ref worker.Bouncing, new() { Pair = Waiting(i).Tested.Pair }, worker.Pool);
        }
        foreach (ref var old in worker.Statics.OldOf(body))
        {
            if (old.IsWritten)
                Note(ref worker.Bouncing, new() { Pair = Pairs.Pairs.Keys[old.CacheIndex] }, worker.Pool);
        }
    }

    // The contacts of which one comes nearest in the step, of those that touch in it.
    bool TryFindHit(in AgreeingBody body, out ConvexContactManifold hit)
    {
        Unsafe.SkipInit(out hit);
        var velocity = VelocityOf(Waiting(body.First).Tested.Pair.A);
        var dt = workers[0].Batcher.Dt;
        var greatest = 0f;
        for (int i = body.First; i < body.End; ++i)
        {
            ref var pair = ref Waiting(i);
            var velocityB = VelocityOf(pair.Tested.Pair.B);
            if (velocityB.Linear != default || velocityB.Angular != default)
                continue;
            for (int j = pair.Start; j < pair.End; ++j)
            {
                ref var manifold = ref ResultOf(i, j).Manifold;
                for (int k = 0; k < manifold.Count && manifold.Count >= LeastEdgeCount; ++k)
                {
                    var arm = manifold.GetOffset(k);
                    var way = -dt * Exact.Dot(manifold.Normal, velocity.Linear + Exact.Cross(velocity.Angular, arm));
                    // Acceleration, and what else pushes, may add to it.
                    if (!(2 * way > -manifold.GetDepth(k)) || !(way > greatest) || !(way * way > LeastHit * LeastHit * Exact.LengthSquared(arm)))
                        continue;
                    hit = manifold;
                    greatest = way;
                }
            }
        }
        return greatest > 0;
    }

    bool IsHeldAcross(in StaticPairs statics, in AgreeingBody body, in ConvexContactManifold hit)
    {
        for (int i = body.First; i < body.End; ++i)
        {
            ref var pair = ref Waiting(i);
            for (int j = pair.Start; j < pair.End; ++j)
            {
                ref var manifold = ref ResultOf(i, j).Manifold;
                if (manifold.Count > 0 && manifold.GreatestDepth >= 0 && IsCorner(hit, manifold.Normal, manifold.Contact0.Offset))
                    return true;
            }
        }
        foreach (ref var old in statics.OldOf(body))
        {
            if (!old.IsWritten)
                continue;
            var rows = new ContactRows(Simulation.Solver, Simulation.Bodies, old.Constraint, old.ContactCount);
            if (IsCorner(hit, rows.Normal, rows.Arm(0)))
                return true;
        }
        return false;
    }

    // Whether all contacts are at the foot of a wall on a floor.
    static bool IsCorner(in ConvexContactManifold wall, in Vector3 normal, in Vector3 place)
    {
        if (MathF.Abs(Exact.Dot(wall.Normal, normal)) > Across)
            return false;
        for (int i = 0; i < wall.Count; ++i)
        {
            var arm = wall.GetOffset(i);
            var height = Exact.Dot(arm - place, normal);
            if (height * height > LowestWall * LowestWall * Exact.LengthSquared(arm))
                return false;
        }
        return true;
    }
}
