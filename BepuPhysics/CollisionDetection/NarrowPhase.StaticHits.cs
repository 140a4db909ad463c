using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints.Contact;

namespace BepuPhysics.CollisionDetection;

// Which pairs have impacts that are made exactly, as an edge is hit at the foot of a wall: of a body on several things, and of one with patches on one.
public sealed unsafe partial class NarrowPhase<TCallbacks>
{
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
        var greatest = 0f;
        for (int i = body.First; i < body.End; ++i)
        {
            ref var pair = ref Waiting(i);
            var velocityB = VelocityOf(pair.Tested.Pair.B);
            for (int j = pair.Start; j < pair.End; ++j)
            {
                ref var manifold = ref ResultOf(i, j).Manifold;
                var way = CornerHits.WayOf(manifold, velocity, velocityB, workers[0].Batcher.Dt);
                if (!(way > greatest))
                    continue;
                hit = manifold;
                greatest = way;
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
                ref var floor = ref ResultOf(i, j).Manifold;
                if (CornerHits.Holds(floor, hit))
                    return !HasHigherWall(body, hit, floor.Normal, floor.Contact0.Offset);
            }
        }
        foreach (ref var old in statics.OldOf(body))
        {
            if (!old.IsWritten)
                continue;
            var rows = new ContactRows(Simulation.Solver, Simulation.Bodies, old.Constraint, old.ContactCount);
            if (CornerHits.IsCorner(hit, rows.Normal, rows.Arm(0)))
                return !HasHigherWall(body, hit, rows.Normal, rows.Arm(0));
        }
        return false;
    }

    // Whether the wall at whose foot an edge is hit goes on in another thing: a face that is hit by all of its corners is not held by some of them.
    bool HasHigherWall(in AgreeingBody body, in ConvexContactManifold hit, in Vector3 normal, in Vector3 place)
    {
        var velocity = VelocityOf(Waiting(body.First).Tested.Pair.A);
        for (int i = body.First; i < body.End; ++i)
        {
            ref var pair = ref Waiting(i);
            var velocityB = VelocityOf(pair.Tested.Pair.B);
            for (int j = pair.Start; j < pair.End; ++j)
            {
                ref var part = ref ResultOf(i, j).Manifold;
                if (part.Count > 0 && CornerHits.IsHigher(part, hit, normal, place, velocity, velocityB, workers[0].Batcher.Dt))
                    return true;
            }
        }
        return false;
    }

    // Of one pair that agrees with no other.
    bool HitsCorner(in CollidablePair pair, ReadOnlySpan<ChildResult> results) =>
        results.Length > 1 && results[1].Children.IsPatch && pair.B.Mobility != CollidableMobility.Dynamic &&
        CornerHits.Has(results, VelocityOf(pair.A), VelocityOf(pair.B), workers[0].Batcher.Dt);
}
