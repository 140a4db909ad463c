using BepuUtilities;
using BepuUtilities.Collections;

namespace BepuPhysics.CollisionDetection;

// Hits that a step ends in the midst of. They are told of in the next one, once and with what both have pushed: two events with a part each would be two
// sounds, and damage that stays below its threshold.
public sealed unsafe partial class CollisionEvents
{
    // In the order of pairs, and without contacts: those of the step before, and those of this one.
    QuickList<ContactEvent> held;
    QuickList<ContactEvent> holding;

    // Before the solver: what held pairs push is asked for, however slow they are by now.
    void MeasureHeld()
    {
        for (int i = 0; i < held.Count; ++i)
        {
            var index = IndexOf(new() { Pair = held[i].Pair });
            if (index < 0)
                continue;
            ref var pair = ref pairs[index];
            for (int j = pair.FirstManifold; j < pair.FirstManifold + pair.ManifoldCount; ++j)
                stage.Measure(manifolds[j]);
        }
    }

    bool IsHeld(in ListenedPair pair, int index) => index < held.Count && ListenedPair.Compare(new() { Pair = held[index].Pair }, pair) == 0;

    // Tells of held pairs that come before this one and are none any more: they parted, fell asleep, or one of the two was removed.
    void TellHeldBefore(in ListenedPair pair, ref int next)
    {
        while (next < held.Count && ListenedPair.Compare(new() { Pair = held[next].Pair }, pair) < 0)
            Add(ref hits, held[next++]);
    }

    // Tells of those that are left, and keeps those of this step.
    void EndHeld(int next)
    {
        while (next < held.Count)
            Add(ref hits, held[next++]);
        (held, holding) = (holding, held);
        holding.Count = 0;
    }

    // A hit is held once: what is still pushed together after two steps is told of every second one.
    void TellHit(ContactEvent told, bool goesOn, int heldIndex)
    {
        if (heldIndex >= 0)
        {
            ref var before = ref held[heldIndex];
            told.Impulse += before.Impulse;
            told.FrictionImpulse += before.FrictionImpulse;
            told.ApproachSpeed = MathHelper.Max(told.ApproachSpeed, before.ApproachSpeed);
            (told.Position, told.Normal, told.Depth) = (before.Position, before.Normal, before.Depth);
        }
        else if (goesOn)
        {
            told.FirstContact = told.ContactCount = 0;
            Add(ref holding, told);
            return;
        }
        Add(ref hits, told);
    }
}
