using System;
using BepuPhysics.Collidables;

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
            AgreedPairs.Now[i] = new() { Key = order[i].Key };
    }

    /// <summary>Leaves the pairs of a body what they agreed on a while ago, if all of them have found the same again.</summary>
    bool TryAgreeAsBefore(in AgreeingBody body)
    {
        var before = AgreedBefore(body);
        if (before.Length == 0 || !HoldsAll(body, before))
            return false;
        var next = 0;
        for (int i = body.First; i < body.End; ++i)
        {
            if (!Waiting(i).IsTouching)
                continue;
            next = NextWithContacts(before, next);
            before[next].Apply(ref ResultOf(i, Waiting(i).FirstResult).Manifold);
            AgreedPairs.Now[i] = before[next++];
            --AgreedPairs.Now[i].Remaining;
        }
        return true;
    }

    bool HoldsAll(in AgreeingBody body, Span<AgreedPair> before)
    {
        Simulation.GetPoseAndShape(Waiting(body.First).Tested.Pair.A, out var pose, out var shape);
        var reach = ReachOf(shape);
        var next = 0;
        for (int i = body.First; i < body.End; ++i)
        {
            if (!Waiting(i).IsTouching)
                continue;
            next = NextWithContacts(before, next);
            if (next == before.Length || before[next].Key != order[i].Key ||
                !before[next++].Holds(ResultOf(i, Waiting(i).FirstResult).Manifold, pose.Orientation, reach))
            {
                return false;
            }
        }
        // Nothing that was touched is missing.
        return NextWithContacts(before, next) == before.Length;
    }

    static int NextWithContacts(Span<AgreedPair> pairs, int index)
    {
        while (index < pairs.Length && pairs[index].Count == 0)
            ++index;
        return index;
    }

    // The pairs that a body had in the last step.
    Span<AgreedPair> AgreedBefore(in AgreeingBody body)
    {
        var before = AgreedPairs.Before;
        var handle = BodyOf(body.First);
        var key = new NoteKey { Key = (ulong)handle << 32 };
        var comparer = new ByKey();
        var (first, high) = (0, before.Length);
        while (first < high)
        {
            var middle = (first + high) >>> 1;
            var other = new NoteKey { Key = before[middle].Key };
            if (comparer.Compare(ref other, ref key) < 0)
                first = middle + 1;
            else
                high = middle;
        }
        var end = first;
        while (end < before.Length && (uint)(before[end].Key >> 32) == handle)
            ++end;
        return before[first..end];
    }

    /// <summary>Takes down what the pairs of a body have found, before they agree.</summary>
    void NoteFound(in AgreeingBody body)
    {
        Simulation.GetPoseAndShape(Waiting(body.First).Tested.Pair.A, out var pose, out _);
        for (int i = body.First; i < body.End; ++i)
        {
            if (Waiting(i).IsTouching)
                AgreedPairs.Now[i].Find(ResultOf(i, Waiting(i).FirstResult).Manifold, pose.Orientation);
        }
    }

    /// <summary>Takes down what is left to the pairs of a body, if all of that is a part of what they had found.</summary>
    void NoteLeft(in AgreeingBody body)
    {
        for (int i = body.First; i < body.End; ++i)
        {
            if (AgreedPairs.Now[i].Count == 0 || AgreedPairs.Now[i].Leave(ResultOf(i, Waiting(i).FirstResult).Manifold))
                continue;
            RememberNothing(body);
            return;
        }
    }
}
