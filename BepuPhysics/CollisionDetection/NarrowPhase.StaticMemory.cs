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
            AgreedPairs.Pairs[i] = default;
    }

    /// <summary>Takes down what the pairs of a body have found, before they agree.</summary>
    void NoteFound(in AgreeingBody body)
    {
        Simulation.GetPoseAndShape(Waiting(body.First).Tested.Pair.A, out var pose, out var shape);
        var reach = ReachOf(shape);
        for (int i = body.First; i < body.End; ++i)
        {
            ref var pair = ref Waiting(i);
            if (!pair.IsTouching && !pair.IsOfChildren)
                continue;
            ref var agreed = ref AgreedPairs.Pairs[i];
            agreed.Key = order[i].Key;
            agreed.Remaining = RetestBound.Lifetime;
            if (pair.IsTouching)
                agreed.Find(ResultOf(i, pair.FirstResult).Manifold, pose.Orientation, reach);
        }
    }

    /// <summary>Takes down what is left to the pairs of a body, if all of that is a part of what they had found.</summary>
    void NoteLeft(in AgreeingBody body)
    {
        for (int i = body.First; i < body.End; ++i)
        {
            if (AgreedPairs.Pairs[i].Count == 0 || AgreedPairs.Pairs[i].Leave(ResultOf(i, Waiting(i).FirstResult).Manifold))
                continue;
            RememberNothing(body);
            return;
        }
    }

    /// <summary>Leaves the pairs of bodies what they agreed on a while ago, as all of them have found the same again.</summary>
    void AgreeAsBefore(ref Worker worker, int first, int end)
    {
        ref var statics = ref worker.Statics;
        while (first < end)
        {
            var body = new AgreeingBody { First = first, End = first + AgreedPairs.Pairs[first].PairCount, TouchCount = 2 };
            statics.Old.Count = 0;
            for (int i = body.First; i < body.End; ++i)
            {
                ref var pair = ref Waiting(i);
                if (AgreedPairs.Pairs[i].Count > 0)
                    AgreedPairs.Pairs[i].Apply(ref ResultOf(i, pair.FirstResult).Manifold);
                if (pair.Tested.ConstraintTypeId >= 0)
                    ListOldPatch(ref statics, pair.Tested, worker.Pool);
            }
            body.OldCount = statics.Old.Count;
            Complete(ref worker, body);
            first = body.End;
        }
    }

    // All that is asked of it: its contacts are where they were.
    static void ListOldPatch(ref StaticPairs statics, in TestedPair tested, BufferPool pool) => statics.Old.Add(new()
    {
        Constraint = tested.Constraint,
        ContactCount = Constraints.ConstraintTypeIds.ContactCount(tested.ConstraintTypeId),
    }, pool);
}
