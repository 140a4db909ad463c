using System;
using BepuPhysics.Collidables;
using BepuUtilities;
using BepuUtilities.Collections;

namespace BepuPhysics.CollisionDetection;

// What is marked is watched, and sees what it meets. A body that is not marked, and is shot at, pushes others on that it touches or is joined with, into the
// way of what is marked, where nobody has foreseen them: plates of a stack that is hit. So all that hangs together with such a body is watched from the
// beginning. Bodies that are marked themselves look around when they are pushed, as balls that lie against each other and of which one is hit: they are
// followed from the beginning, and need no pairs before.
sealed unsafe partial class FastPairs
{
    // So many are watched around what is hit, nearest first.
    const int MostPushed = 16;

    // So many are followed for each body of a pair of the beginning.
    const int MostFollowed = 16;

    struct FollowedList(FastPairs owner) : IForEach<BodyHandle>
    {
        public readonly void LoopBody(BodyHandle body)
        {
            if (!owner.IsMarked(body))
                return;
            var index = owner.Bodies.Locations[body.Slot].Index;
            owner.Link(ref index);
        }
    }

    // Of all that are watched. Who may have others is no question here: that is known only after a step with fast pairs, and what a step does may not depend
    // on what there was in the last one.
    void FollowPushed()
    {
        var list = new FollowedList(this);
        var most = movers.Count * MostFollowed;
        for (int i = 0; i < movers.Count && movers.Count < most; ++i)
        {
            foreach (var constraint in Bodies.GetConstraints(Bodies.ActiveSet.IndexToHandle[movers[i].Index]))
                simulation.Solver.EnumerateOtherBodies(constraint, ref list);
        }
    }

    struct ConnectedList(FastPairs owner, int first) : IForEach<BodyHandle>
    {
        public readonly void LoopBody(BodyHandle body)
        {
            if (owner.pushed.Count - first < MostPushed && owner.MayBePushed(body) && !owner.pushed.AsSpan()[first..].Contains(body))
                owner.pushed.Add(body, owner.Pool);
        }
    }

    // Bodies that are shot at, each before those that hang together with it. It has memory from the first one on.
    QuickList<BodyHandle> pushed;
    // Where those of each mover are: many may be shot at one. None where nobody has asked.
    QuickList<PushedRange> pushedBy;

    struct PushedRange
    {
        public int First, Count;
    }

    void WatchPushed()
    {
        pushed.Count = pushedBy.Count = 0;
        var count = pairs.Count;
        for (int i = 0; i < count; ++i)
        {
            var (pair, a, b, isSensor) = (pairs[i].Pair, pairs[i].A, pairs[i].B, pairs[i].IsSensor);
            if (isSensor || a < 0 || b < 0)
                continue;
            // One of them is marked.
            if (MayBePushed(pair.A.BodyHandle))
                WatchPushed(b, pair.B, a, pair.A.BodyHandle);
            else if (MayBePushed(pair.B.BodyHandle))
                WatchPushed(a, pair.A, b, pair.B.BodyHandle);
        }
    }

    void WatchPushed(int body, CollidableReference self, int hitBody, BodyHandle hit)
    {
        if (self.Mobility != CollidableMobility.Dynamic)
            return;
        var range = FindPushedBy(hitBody, hit);
        for (int i = range.First + 1; i < range.First + range.Count; ++i)
            PairFromTheBeginning(body, self, BepuPhysics.Bodies.ReferenceAt(Bodies.ActiveSet, Bodies.Locations[pushed[i].Slot].Index));
    }

    PushedRange FindPushedBy(int hitBody, BodyHandle hit)
    {
        if (pushedBy.Count == 0)
        {
            if (!pushed.Span.Allocated)
                (pushed, pushedBy) = (new(MostPushed, pool), new(movers.Count, pool));
            pushedBy.EnsureCapacity(movers.Count, pool);
            pushedBy.Count = movers.Count;
            pushedBy.AsSpan().Clear();
        }
        ref var range = ref pushedBy[hitBody];
        if (range.Count > 0)
            return range;
        range.First = pushed.Count;
        pushed.Add(hit, pool);
        var list = new ConnectedList(this, range.First);
        for (int i = range.First; i < pushed.Count; ++i)
        {
            foreach (var constraint in Bodies.GetConstraints(pushed[i]))
                simulation.Solver.EnumerateOtherBodies(constraint, ref list);
        }
        range.Count = pushed.Count - range.First;
        return range;
    }

    bool MayBePushed(BodyHandle body) => IsPushable(body, out var isMarked) && !isMarked;

    bool IsMarked(BodyHandle body) => IsPushable(body, out var isMarked) && isMarked;

    bool IsPushable(BodyHandle body, out bool isMarked)
    {
        isMarked = false;
        if (Bodies.IsAsleep(body.Slot))
            return false;
        var index = Bodies.Locations[body.Slot].Index;
        ref var collidable = ref Bodies.ActiveSet.Collidables[index];
        isMarked = collidable.Continuity.Mode == ContinuousDetectionMode.Continuous;
        return collidable.Shape.Exists && !BepuPhysics.Bodies.IsKinematic(Bodies.ActiveSet.LocalInertias[index]);
    }
}
