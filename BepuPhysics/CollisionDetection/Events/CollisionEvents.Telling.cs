using System.Runtime.CompilerServices;
using BepuUtilities.Collections;

namespace BepuPhysics.CollisionDetection;

// What is told when the solver has ended: at once what has changed, and what persists when somebody asks.
public sealed unsafe partial class CollisionEvents
{
    /// <summary>Tells what has happened, but for what persists. When the solver has ended.</summary>
    /// <returns>Whether something persists, or is to be shown, that <see cref="TellPersisting"/> tells.</returns>
    internal bool EndSolve(ref PairCache cache)
    {
        if (isSettled)
            return false;
        TellSleep();
        int nextHeld = 0;
        int kept = 0;
        int asleep = 0;
        int persistingCount = 0;
        var all = EventMask.None;
        for (int i = 0; i < pairs.Count; ++i)
        {
            ref var pair = ref pairs[i];
            if (pair.IsAsleep)
            {
                pair.Persists = false;
                pairs[kept++] = pair;
                ++asleep;
                continue;
            }
            var state = StateOf(pair);
            var pushes = (state & ListenedState.Pushes) != 0 || pair.Bounce > 0;
            var touches = pushes || (state & ListenedState.Overlaps) != 0 || (pair.IsSensor && (pair.Exists || pair.HasPassed));
            var kinds = touches ? pair.Touches ? EventMask.Persist : EventMask.Begin : pair.Touches ? EventMask.End : EventMask.None;
            TellHeldBefore(pair, ref nextHeld);
            var wasHeld = IsHeld(pair, nextHeld);
            if (wasHeld || (pushes && ((state & ListenedState.IsFast) != 0 || (pair.ManifoldCount == 0 && hitSpeed == 0))))
                kinds |= EventMask.Hit;
            kinds &= pair.Mask;
            all |= pair.Mask;
            if ((kinds & ~EventMask.Persist) != 0)
                Tell(ref pair, kinds & ~EventMask.Persist, ref cache, (state & ListenedState.GoesOn) != 0, wasHeld ? nextHeld : -1);
            nextHeld += wasHeld ? 1 : 0;
            pair.Persists = (kinds & EventMask.Persist) != 0;
            persistingCount += pair.Persists ? 1 : 0;
            pair.Touches = touches;
            // What has passed ends in the next step, unless it is still there.
            if (!pair.Exists && !pair.HasPassed)
                continue;
            if (kept < i)
                pairs[kept] = pair;
            ++kept;
        }
        EndHeld(nextHeld);
        pairs.Count = kept;
        isSettled = asleep == kept && held.Count == 0;
        removalsSeen = traits.RemovalCount;
        if ((all & EventMask.Persist) == 0)
            return false;
        // Whoever asks may be on another thread, which must not take memory.
        persisting.EnsureCapacity(persistingCount, pool);
        return true;
    }

    /// <summary>Tells what persists. Before anything else changes.</summary>
    // Of all that is listened to this is by far the most, and a step has no need of it: so who does not ask does not pay.
    internal void TellPersisting(ref PairCache cache)
    {
        isPersistingTold = true;
        for (int i = 0; i < pairs.Count; ++i)
        {
            ref var pair = ref pairs[i];
            // Those who hear of all are shown contacts that do not touch, too.
            if ((pair.Mask & EventMask.Persist) != 0 && !pair.IsAsleep)
                Tell(ref pair, pair.Persists ? EventMask.Persist : EventMask.None, ref cache);
        }
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    int StateOf(in ListenedPair pair)
    {
        int state = 0;
        for (int i = pair.FirstManifold; i < pair.FirstManifold + pair.ManifoldCount; ++i)
            state |= stage.StateOf(manifolds[i]);
        return state;
    }

    void Tell(ref ListenedPair pair, EventMask kinds, ref PairCache cache, bool goesOn = false, int heldIndex = -1)
    {
        var told = new ContactEvent { Pair = pair.Pair, IsSensor = pair.IsSensor };
        if (pair.Bounce > 0)
            (told.Impulse, told.FrictionImpulse) = (bounces[pair.Bounce - 1].Impulse, bounces[pair.Bounce - 1].Friction);
        if (pair.ManifoldCount > 0)
            Describe(ref pair, ref told, ref cache);
        Tell(ref ended, kinds & EventMask.End, told);
        Tell(ref persisting, kinds & EventMask.Persist, told);
        Tell(ref began, kinds & EventMask.Begin, told);
        if ((kinds & EventMask.Hit) != EventMask.None)
            TellHit(told, goesOn, heldIndex);
    }

    void Tell(ref QuickList<ContactEvent> list, EventMask kind, in ContactEvent contactEvent)
    {
        if (kind != EventMask.None)
            Add(ref list, contactEvent);
    }

    // Writes the contacts of a pair, and says which is the strongest.
    void Describe(ref ListenedPair pair, ref ContactEvent told, ref PairCache cache)
    {
        ref var place = ref places[pair.FirstManifold];
        place = stage.PlaceOf(manifolds[pair.FirstManifold]);
        told.FirstContact = manifolds[pair.FirstManifold].FirstContact;
        told.ApproachSpeed = float.NegativeInfinity;
        TryFind(ref pair, ref cache);
        var found = cache.ManifoldsOf(pair.IndexInCache);
        for (int i = pair.FirstManifold; i < pair.FirstManifold + pair.ManifoldCount; ++i)
        {
            ref var manifold = ref manifolds[i];
            while (found.MoveNext() && !(found.Current.HasConstraint && found.Current.Constraint == manifold.Constraint))
            {
            }
            stage.AddTo(ref told, manifold);
            var room = contacts.Span.AsSpan().Slice(manifold.FirstContact, manifold.ContactCount);
            stage.Describe(manifold, place.CenterOfA, found.Current.Features, found.Children, room);
            told.ContactCount += manifold.ContactCount;
        }
        var strongest = told.FirstContact;
        for (int i = strongest + 1; i < told.FirstContact + told.ContactCount; ++i)
        {
            if (IsStronger(contacts[i], contacts[strongest]))
                strongest = i;
        }
        ref var shown = ref contacts[strongest];
        (told.Position, told.Normal, told.Depth) = (shown.Position, shown.Normal, shown.Depth);
    }

    static bool IsStronger(in EventContact a, in EventContact b) => a.Impulse != b.Impulse ? a.Impulse > b.Impulse : a.Depth > b.Depth;
}
