using System;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

// What a body's contacts with several statics carried, where these have come, gone or gone over from one static to another.
public sealed unsafe partial class NarrowPhase<TCallbacks>
{
    void HandOver(ref StaticPairs statics, in AgreeingBody body, BufferPool pool)
    {
        if (!AreOthers(statics, body))
            return;
        ref var transfer = ref statics.Transfer;
        transfer.Begin();
        foreach (ref var old in statics.OldOf(body))
        {
            if (old.IsWritten)
                continue;
            new ContactConstraint(Simulation.Solver, old.Constraint, old.ContactCount).ReadPatch(old.Features, out var patch);
            old.Source = transfer.AddSource(patch, pool);
        }
        for (int i = body.First; i < body.End; ++i)
        {
            ref var pair = ref Waiting(i);
            for (int j = pair.Start; j < pair.End; ++j)
            {
                ref var result = ref ResultOf(i, j);
                if (result.Manifold.Count > 0)
                    transfer.AddHeir(result.Manifold, SourceOf(statics.OldOf(body), i, result.Children), pool);
            }
        }
        if (!transfer.Run())
            return;
        var heir = 0;
        for (int i = body.First; i < body.End; ++i)
        {
            ref var pair = ref Waiting(i);
            for (int j = pair.Start; j < pair.End; ++j)
            {
                ref var result = ref ResultOf(i, j);
                if (result.Manifold.Count > 0 && transfer.TryGet(heir++, out var load))
                    statics.Inheritances.Add(new() { Pair = pair.Tested.Pair, Children = result.Children, Load = load }, pool);
            }
        }
    }

    static int SourceOf(Span<OldPatch> patches, int place, ChildIds children)
    {
        foreach (ref var old in patches)
        {
            if (old.Pair == place && old.Children == children)
                return old.Source;
        }
        return StaticPairs.Nothing;
    }

    // Whether a contact is gone that others may take over from. Of a body with one pair, the pair sees to it itself.
    bool AreOthers(in StaticPairs statics, in AgreeingBody body)
    {
        var resultCount = 0;
        for (int i = body.First; i < body.End; ++i)
        {
            ref var pair = ref Waiting(i);
            for (int j = pair.Start; j < pair.End; ++j)
                resultCount += ResultOf(i, j).Manifold.Count > 0 ? 1 : 0;
        }
        if (resultCount == 0)
            return false;
        foreach (ref var old in statics.OldOf(body))
        {
            if (!old.IsWritten && HasLost(old, resultCount > 1))
                return true;
        }
        return false;
    }

    bool HasLost(in OldPatch old, bool hasSeveral)
    {
        if (old.Pair < 0)
            return true;
        ref var pair = ref Waiting(old.Pair);
        for (int i = pair.Start; i < pair.End; ++i)
        {
            ref var result = ref ResultOf(old.Pair, i);
            if (result.Children == old.Children && result.Manifold.Count > 0)
                return hasSeveral && HasLost(old, result.Manifold);
        }
        return true;
    }

    static bool HasLost(in OldPatch old, in ConvexContactManifold manifold)
    {
        for (int i = 0; i < old.ContactCount; ++i)
        {
            var isThere = false;
            for (int j = 0; j < manifold.Count; ++j)
                isThere |= manifold.GetFeatureId(j) == old.Features[i];
            if (!isThere)
                return true;
        }
        return false;
    }
}
