using System;
using BepuPhysics.Collidables;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

// What bodies that lie across statics have agreed on, from step to step.
public sealed unsafe partial class NarrowPhase<TCallbacks>
{
    // What moves, has children or was changed by a game may come out otherwise in the next step; so may what agrees with contacts that are written.
    bool MayRemember(in StaticPairs statics, in AgreeingBody body)
    {
        if (!RemembersAgreements)
            return false;
        for (int i = body.First; i < body.End; ++i)
        {
            ref var pair = ref Waiting(i);
            if (pair.IsTouching && (pair.IsOfChildren || pair.IsOfGame || pair.Tested.Pair.B.Mobility != CollidableMobility.Static))
                return false;
        }
        foreach (ref var old in statics.OldOf(body))
        {
            if (old.IsWritten)
                return false;
        }
        return true;
    }

    void RememberNothing(in AgreeingBody body)
    {
        for (int i = body.First; i < body.End; ++i)
            AgreedPairs.Pairs[i].IsRemembered = false;
    }

    /// <summary>Takes down what the pairs of a body have found, before they agree.</summary>
    void NoteFound(in AgreeingBody body)
    {
        for (int i = body.First; i < body.End; ++i)
        {
            ref var pair = ref Waiting(i);
            ref var agreed = ref AgreedPairs.Pairs[i];
            agreed = new() { B = pair.Tested.Pair.B, IsRemembered = pair.IsTouching || pair.IsOfChildren };
            if (pair.IsTouching)
                agreed.Find(ResultOf(i, pair.FirstResult).Manifold);
        }
    }

    /// <summary>Takes down what is left to the pairs of a body, if all of that is a part of what they had found.</summary>
    void NoteLeft(in StaticPairs statics, in AgreeingBody body)
    {
        var isRemembered = statics.Agreement.MayRemember(body.Number);
        for (int i = body.First; isRemembered && i < body.End; ++i)
            isRemembered = AgreedPairs.Pairs[i].Count == 0 || AgreedPairs.Pairs[i].Leave(ResultOf(i, Waiting(i).FirstResult).Manifold);
        if (!isRemembered)
            RememberNothing(body);
    }

    /// <summary>Remembers the bodies that have agreed anew.</summary>
    void RememberAgreed()
    {
        var count = heldCount;
        for (int first = heldCount, end; first < order.Count; first = end)
        {
            var isRemembered = AgreedPairs.Pairs[first].IsRemembered;
            for (end = first + 1; end < order.Count && BodyOf(end) == BodyOf(first); ++end)
                isRemembered |= AgreedPairs.Pairs[end].IsRemembered;
            if (!isRemembered)
                continue;
            var body = PairOf(order[first].Key).A;
            AgreedPairs.EnsureSlots(Simulation.Bodies.Locations.Length, Pool);
            Simulation.GetPoseAndShape(body, out var pose, out var shape);
            AgreedPairs.Add(new() { Body = body, Orientation = pose.Orientation, Reach = ReachOf(shape) }, first, end, ref count, Pool);
        }
        AgreedPairs.End(count, Pool);
    }

    /// <summary>Leaves the pairs of bodies what they agreed on a while ago, as all of them have found the same again.</summary>
    /// <param name="worker">The worker.</param>
    /// <param name="first">The first of the bodies that are remembered.</param>
    /// <param name="end">The one after the last.</param>
    void AgreeAsBefore(ref Worker worker, int first, int end)
    {
        ref var statics = ref worker.Statics;
        for (int i = first; i < end; ++i)
        {
            ref var agreed = ref AgreedPairs.Bodies[i];
            var body = new AgreeingBody { First = agreed.First, End = agreed.First + agreed.Count, TouchCount = agreed.Count };
            statics.Old.Count = 0;
            for (int j = body.First; j < body.End; ++j)
            {
                PrefetchWaiting(j + PrefetchDistance);
                ref var pair = ref Waiting(j);
                ref var left = ref AgreedPairs.Pairs[j];
                if (left.Count > 0)
                    left.Apply(ref ResultOf(j, pair.FirstResult).Manifold);
                if (pair.Tested.ConstraintTypeId >= 0)
                    ListOldPatch(ref statics, pair.Tested, worker.Pool);
            }
            body.OldCount = statics.Old.Count;
            Complete(ref worker, body);
        }
    }

    // Of convex shapes the results are in the order of the pairs, and about as many.
    void PrefetchWaiting(int place)
    {
        if (place >= heldCount)
            return;
        ref var note = ref order[place];
        ref var statics = ref workers[note.Worker].Statics;
        Prefetch.Read(statics.Pairs.Span.Memory + note.Index);
        var result = (byte*)(statics.Results.Span.Memory + Math.Min(note.Index, statics.Results.Count));
        Prefetch.Read(result);
        Prefetch.Read(result + 64);
    }

    // Pairs between the one that is asked for and the one that is completed.
    const int PrefetchDistance = 16;

    // All that is asked of it: its contacts are where they were.
    static void ListOldPatch(ref StaticPairs statics, in TestedPair tested, BufferPool pool) => statics.Old.Add(new()
    {
        Constraint = tested.Constraint,
        ContactCount = Constraints.ConstraintTypeIds.ContactCount(tested.ConstraintTypeId),
    }, pool);
}
