using System.Runtime.CompilerServices;
using BepuPhysics.Constraints;
using BepuUtilities.Collections;

namespace BepuPhysics.CollisionDetection;

// What is done in a step: pairs are noted by the flush, merged before the solver, and told of when it has ended.
public sealed unsafe partial class CollisionEvents
{
    // Pairs whose contacts are new, and those that sensors see in this step.
    QuickList<ListenedPair> added;
    QuickList<ListenedPair> sensed;
    // In the order of pairs. The second takes the result of the next merge.
    QuickList<ListenedPair> pairs;
    QuickList<ListenedPair> spare;
    // Of all manifolds of the pairs; those of a pair are written where something is told of it.
    QuickList<EventContact> contacts;
    QuickList<ContactEvent> began;
    QuickList<ContactEvent> ended;
    QuickList<ContactEvent> hits;
    QuickList<ContactEvent> persisting;

    /// <summary>Notes that a pair has a new contact constraint.</summary>
    internal void NoteContacts(in CollidablePair pair)
    {
        if (MaskOf(pair) != EventMask.None)
            Add(ref added, new() { Pair = pair });
    }

    /// <summary>Forgets what sensors have seen in the last step.</summary>
    internal void BeginDetection() => sensed.Count = 0;

    /// <summary>Notes that a sensor sees the other of its pair in this step.</summary>
    internal void NoteSensed(in CollidablePair pair) => Add(ref sensed, new() { Pair = pair, IsSensor = true });

    /// <summary>Notes that the way of the other of a sensor's pair is swept in this step. Before the solver runs.</summary>
    internal void NoteSwept(in CollidablePair pair) => Add(ref added, new() { Pair = pair, IsSensor = true, MayPass = true });

    /// <summary>Finds the pairs to tell of, and the contacts to be summed up. Before the solver runs.</summary>
    internal void BeginSolve(ref PairCache cache, bool isAtRest)
    {
        began.Count = ended.Count = hits.Count = persisting.Count = slept.Count = woke.Count = 0;
        stage.Manifolds.Count = stage.Pairs.Count = contacts.Count = 0;
        isSettled &= isAtRest && added.Count == 0 && turned.Count == 0 && removalsSeen == traits.RemovalCount;
        if (isSettled)
            return;
        if (hasNewListener)
        {
            for (int i = 0; i < cache.Pairs.Count; ++i)
                NoteContacts(cache.Pairs.Keys[i]);
        }
        hasNewListener = false;
        for (int i = 0; i < sensed.Count; ++i)
            Add(ref added, sensed[i]);
        if (added.Count > 1)
        {
            var order = new ListenedPair.Order();
            QuickSort.Sort(added.Span, added.Count, ref order);
        }
        var contactCount = Merge(ref cache);
        added.Count = 0;
        (stage.Pairs, stage.HitSpeed) = (pairs, hitSpeed);
        if (contactCount == 0)
            return;
        if (!contacts.Span.Allocated)
            contacts = new QuickList<EventContact>(contactCount, pool);
        contacts.EnsureCapacity(contactCount, pool);
        contacts.Count = contactCount;
    }

    // Returns the number of contacts.
    int Merge(ref PairCache cache)
    {
        spare.Count = 0;
        int contactCount = 0;
        int known = 0;
        int fresh = 0;
        while (known < pairs.Count || fresh < added.Count)
        {
            var order = known == pairs.Count ? 1 : fresh == added.Count ? -1 : ListenedPair.Compare(pairs[known], added[fresh]);
            var pair = order <= 0 ? pairs[known++] : added[fresh];
            var isNoted = order >= 0;
            var isSensed = false;
            pair.MayPass = pair.HasPassed = pair.Overlaps = pair.IsMeasured = false;
            // A pair is noted for each of its constraints.
            for (; isNoted && fresh < added.Count && ListenedPair.Compare(pair, added[fresh]) == 0; ++fresh)
            {
                pair.Touches |= added[fresh].Touches;
                pair.MayPass |= added[fresh].MayPass;
                isSensed |= !added[fresh].MayPass;
            }
            if (!pair.IsSensor && cache.IsAsleep(pair.Pair))
            {
                RememberAsleep(pair);
                continue;
            }
            pair.BounceImpulse = pair.ApproachSpeed = 0;
            pair.FirstManifold = stage.Manifolds.Count;
            pair.IsAsleep = pair.IsSensor && !isNoted && Sleeps(pair.Pair);
            pair.Exists = pair.IsAsleep || (pair.IsSensor ? isSensed : ListManifolds(ref pair, ref cache, ref contactCount));
            pair.ManifoldCount = stage.Manifolds.Count - pair.FirstManifold;
            if (pair.Exists || pair.MayPass)
                pair.Mask = MaskOf(pair.Pair);
            if (pair.Mask != EventMask.None && (pair.Exists || pair.MayPass || pair.Touches))
                Add(ref spare, pair);
        }
        (pairs, spare) = (spare, pairs);
        return contactCount;
    }

    // Lists the manifolds that a pair has, if it still is one, and counts their contacts.
    bool ListManifolds(ref ListenedPair pair, ref PairCache cache, ref int contactCount)
    {
        var guess = pair.IndexInCache;
        pair.IndexInCache = guess < cache.Pairs.Count ? cache.IndexOf(pair.Pair, guess) : cache.Pairs.IndexOf(pair.Pair);
        if (pair.IndexInCache < 0)
            return false;
        var start = stage.Manifolds.Count;
        for (var manifolds = cache.ManifoldsOf(pair.IndexInCache); manifolds.MoveNext();)
        {
            ref var manifold = ref manifolds.Current;
            if (!manifold.HasConstraint)
                continue;
            var count = ConstraintTypeIds.ContactCount(manifold.ConstraintTypeId);
            Add(ref stage.Manifolds, new()
            {
                Constraint = manifold.Constraint,
                Cached = (CachedManifold*)Unsafe.AsPointer(ref manifold),
                Children = manifolds.Children,
                ContactCount = count,
                FirstContact = contactCount,
            });
            contactCount += count;
        }
        return stage.Manifolds.Count > start;
    }

    /// <summary>Adds what a bounce has pushed to the pair, if it is listened to.</summary>
    internal void AddBounce(in CollidablePair pair, float impulse)
    {
        var index = IndexOf(new() { Pair = pair });
        if (index >= 0)
            pairs[index].BounceImpulse += impulse;
    }

    /// <summary>Notes that the way of the other of a pair has met its sensor.</summary>
    internal void AddPassed(in CollidablePair pair)
    {
        var index = IndexOf(new() { Pair = pair, IsSensor = true });
        if (index >= 0)
            pairs[index].HasPassed = true;
    }

    int IndexOf(in ListenedPair wanted)
    {
        int low = 0;
        int high = pairs.Count;
        while (low < high)
        {
            var middle = (low + high) >>> 1;
            if (ListenedPair.Compare(pairs[middle], wanted) < 0)
                low = middle + 1;
            else
                high = middle;
        }
        return low < pairs.Count && ListenedPair.Compare(pairs[low], wanted) == 0 ? low : -1;
    }

    /// <summary>Tells what has happened. When the solver has ended.</summary>
    internal void EndSolve()
    {
        if (isSettled)
            return;
        TellSleep();
        int kept = 0;
        int asleep = 0;
        for (int i = 0; i < pairs.Count; ++i)
        {
            ref var pair = ref pairs[i];
            if (pair.IsAsleep)
            {
                pairs[kept++] = pair;
                ++asleep;
                continue;
            }
            var told = new ContactEvent { Pair = pair.Pair, IsSensor = pair.IsSensor, Impulse = pair.BounceImpulse, ApproachSpeed = pair.ApproachSpeed };
            Sum(pair, ref told);
            var touches = told.Impulse > 0 || pair.Overlaps || (pair.IsSensor && (pair.Exists || pair.HasPassed));
            var kinds = (pair.Touches, touches) switch
            {
                (true, false) => EventMask.End,
                (true, true) => EventMask.Persist,
                (false, true) => EventMask.Begin,
                _ => EventMask.None,
            };
            if (told.Impulse > 0 && told.ApproachSpeed >= hitSpeed)
                kinds |= EventMask.Hit;
            kinds &= pair.Mask;
            // Those who hear of all are shown contacts that do not touch, too.
            if (kinds != EventMask.None || (pair.Mask & EventMask.Persist) != 0)
                Describe(pair, ref told);
            Tell(ref ended, kinds & EventMask.End, told);
            Tell(ref persisting, kinds & EventMask.Persist, told);
            Tell(ref began, kinds & EventMask.Begin, told);
            Tell(ref hits, kinds & EventMask.Hit, told);
            pair.Touches = touches;
            // What has passed ends in the next step, unless it is still there.
            if (pair.Exists || pair.HasPassed)
                pairs[kept++] = pair;
        }
        pairs.Count = kept;
        isSettled = asleep == kept;
        removalsSeen = traits.RemovalCount;
    }

    void Tell(ref QuickList<ContactEvent> list, EventMask kind, in ContactEvent contactEvent)
    {
        if (kind != EventMask.None)
            Add(ref list, contactEvent);
    }

    // Adds up what the manifolds of a pair pushed.
    void Sum(in ListenedPair pair, ref ContactEvent told)
    {
        if (!pair.IsMeasured)
            return;
        for (int i = pair.FirstManifold; i < pair.FirstManifold + pair.ManifoldCount; ++i)
        {
            ref var manifold = ref stage.Manifolds[i];
            told.FrictionImpulse += manifold.Friction;
            for (int j = 0; j < manifold.ContactCount; ++j)
                told.Impulse += manifold.Normals[j];
        }
    }

    // Writes the contacts of a pair, and says which is the strongest.
    void Describe(in ListenedPair pair, ref ContactEvent told)
    {
        if (pair.ManifoldCount == 0)
            return;
        told.FirstContact = stage.Manifolds[pair.FirstManifold].FirstContact;
        for (int i = pair.FirstManifold; i < pair.FirstManifold + pair.ManifoldCount; ++i)
        {
            ref var manifold = ref stage.Manifolds[i];
            stage.Describe(pair, manifold, contacts.Span.AsSpan().Slice(manifold.FirstContact, manifold.ContactCount));
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

    void Add<T>(ref QuickList<T> list, in T item) where T : unmanaged
    {
        if (!list.Span.Allocated)
            list = new QuickList<T>(64, pool);
        list.Add(item, pool);
    }

    void ReleaseLists()
    {
        Release(ref added);
        Release(ref sensed);
        Release(ref pairs);
        Release(ref spare);
        Release(ref began);
        Release(ref ended);
        Release(ref hits);
        Release(ref persisting);
        ReleaseSleep();
        Release(ref stage.Manifolds);
        stage.Pairs = default;
        Release(ref contacts);
    }

    void Release<T>(ref QuickList<T> list) where T : unmanaged
    {
        if (list.Span.Allocated)
            list.Dispose(pool);
        list = default;
    }

    void AbandonLists()
    {
        added = sensed = pairs = spare = default;
        began = ended = hits = persisting = default;
        AbandonSleep();
        stage.Manifolds = default;
        stage.Pairs = default;
        contacts = default;
    }
}
