using System.Numerics;
using System.Runtime.CompilerServices;
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
    // Those of the pairs, and what takes those of the next merge.
    QuickList<ListenedManifold> manifolds;
    QuickList<ListenedManifold> spareManifolds;
    // Of the first manifold of each pair that something is told of.
    QuickList<ListenedPlace> places;
    // Of all manifolds of the pairs; those of a pair are written where something is told of it.
    QuickList<EventContact> contacts;
    // Of those of the pairs that had any in this step.
    QuickList<ListenedBounce> bounces;
    QuickList<ContactEvent> began;
    QuickList<ContactEvent> ended;
    QuickList<ContactEvent> hits;
    QuickList<ContactEvent> persisting;
    // Whether somebody has asked for what persists, or a change has come before.
    bool isPersistingTold;
    // Whether manifolds are none of the pairs', as after a restore.
    bool isStale;
    // Whether sensors are among the pairs: what they see is noted anew in each step.
    bool hasSensors;

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
        contacts.Count = bounces.Count = 0;
        isPersistingTold = false;
        isSettled &= isAtRest && added.Count == 0 && turned.Count == 0 && removalsSeen == traits.RemovalCount;
        if (isSettled)
        {
            stage.Forget();
            return;
        }
        if (hasNewListener)
        {
            for (int i = 0; i < cache.Pairs.Count; ++i)
                NoteContacts(cache.Pairs.Keys[i]);
        }
        for (int i = 0; i < sensed.Count; ++i)
            Add(ref added, sensed[i]);
        stage.HitSpeed = hitSpeed;
        // What nothing has come to or gone from since the last step is as it was.
        var isChanged = isStale || hasSensors || hasNewListener || added.Count > 0 || removalsSeen != traits.RemovalCount;
        hasNewListener = false;
        if (isChanged || !TryPlace(out var contactCount))
            contactCount = Merge(ref cache);
        isStale = false;
        added.Count = 0;
        MeasureHeld();
        stage.EndPlaces();
        if (contactCount == 0)
            return;
        contacts.EnsureCapacity(contactCount, pool);
        contacts.Count = contactCount;
        places.EnsureCapacity(manifolds.Count, pool);
        places.Count = manifolds.Count;
    }

    // Whether all manifolds have the constraints that they had.
    bool TryPlace(out int contactCount)
    {
        contactCount = 0;
        stage.BeginPlaces();
        for (int i = 0; i < pairs.Count; ++i)
        {
            ref var pair = ref pairs[i];
            pair.Bounce = 0;
            if (!TryPlace(pair, ref manifolds, ref contactCount))
                return false;
        }
        return true;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    bool TryPlace(in ListenedPair pair, ref QuickList<ListenedManifold> list, ref int contactCount)
    {
        // What touches already is told of for its impulses only where somebody asks for these.
        var isMeasured = !pair.Touches || (pair.Mask & EventMask.Persist) != 0;
        for (int i = pair.FirstManifold; i < pair.FirstManifold + pair.ManifoldCount; ++i)
        {
            ref var manifold = ref list[i];
            if (!stage.Place(ref manifold, isMeasured))
                return false;
            manifold.FirstContact = contactCount;
            contactCount += manifold.ContactCount;
        }
        return true;
    }

    // Returns the number of contacts.
    int Merge(ref PairCache cache)
    {
        if (added.Count > 1)
        {
            var order = new ListenedPair.Order();
            QuickSort.Sort(added.Span, added.Count, ref order);
        }
        stage.BeginPlaces();
        spare.Count = spareManifolds.Count = 0;
        hasSensors = false;
        int contactCount = 0;
        int known = 0;
        int fresh = 0;
        while (known < pairs.Count || fresh < added.Count)
        {
            var order = known == pairs.Count ? 1 : fresh == added.Count ? -1 : ListenedPair.Compare(pairs[known], added[fresh]);
            var pair = order <= 0 ? pairs[known++] : added[fresh];
            var isNoted = order >= 0;
            var isSensed = false;
            pair.MayPass = pair.HasPassed = false;
            pair.Bounce = 0;
            // A pair is noted for each of its constraints.
            for (; isNoted && fresh < added.Count && ListenedPair.Compare(pair, added[fresh]) == 0; ++fresh)
            {
                pair.Touches |= added[fresh].Touches;
                pair.MayPass |= added[fresh].MayPass;
                isSensed |= !added[fresh].MayPass;
            }
            if (isNoted || !TryKeep(ref pair, ref contactCount))
            {
                if (!pair.IsSensor && cache.IsAsleep(pair.Pair))
                {
                    RememberAsleep(pair);
                    continue;
                }
                ListManifolds(ref pair, ref cache, ref contactCount);
            }
            pair.IsAsleep = pair.IsSensor && !isNoted && Sleeps(pair.Pair);
            pair.Exists = pair.IsAsleep || (pair.IsSensor ? isSensed : pair.ManifoldCount > 0);
            if (pair.Exists || pair.MayPass)
                pair.Mask = MaskOf(pair.Pair);
            if (pair.Mask != EventMask.None && (pair.Exists || pair.MayPass || pair.Touches))
                Add(ref spare, pair);
            else
                spareManifolds.Count = pair.FirstManifold;
            hasSensors |= pair.IsSensor;
        }
        (pairs, spare) = (spare, pairs);
        (manifolds, spareManifolds) = (spareManifolds, manifolds);
        return contactCount;
    }

    // Takes over the manifolds of a pair, if they have the constraints that they had.
    bool TryKeep(ref ListenedPair pair, ref int contactCount)
    {
        if (pair.IsSensor || isStale)
            return false;
        var (first, contactsBefore) = (pair.FirstManifold, contactCount);
        for (int i = 0; i < pair.ManifoldCount; ++i)
            Add(ref spareManifolds, manifolds[first + i]);
        pair.FirstManifold = spareManifolds.Count - pair.ManifoldCount;
        if (pair.ManifoldCount > 0 && TryPlace(pair, ref spareManifolds, ref contactCount))
            return true;
        spareManifolds.Count = pair.FirstManifold;
        contactCount = contactsBefore;
        return false;
    }

    // Lists the manifolds that a pair has, if it still is one.
    void ListManifolds(ref ListenedPair pair, ref PairCache cache, ref int contactCount)
    {
        (pair.FirstManifold, pair.ManifoldCount) = (spareManifolds.Count, 0);
        if (pair.IsSensor || !TryFind(ref pair, ref cache))
            return;
        for (var found = cache.ManifoldsOf(pair.IndexInCache); found.MoveNext();)
        {
            if (found.Current.HasConstraint)
                Add(ref spareManifolds, new() { Constraint = found.Current.Constraint });
        }
        pair.ManifoldCount = spareManifolds.Count - pair.FirstManifold;
        TryPlace(pair, ref spareManifolds, ref contactCount);
    }

    static bool TryFind(ref ListenedPair pair, ref PairCache cache)
    {
        var guess = pair.IndexInCache;
        pair.IndexInCache = guess < cache.Pairs.Count ? cache.IndexOf(pair.Pair, guess) : cache.Pairs.IndexOf(pair.Pair);
        return pair.IndexInCache >= 0;
    }

    /// <summary>Adds what a bounce has pushed to the pair, if it is listened to.</summary>
    internal void AddBounce(in CollidablePair pair, float impulse, Vector3 friction)
    {
        var index = IndexOf(new() { Pair = pair });
        if (index < 0)
            return;
        if (pairs[index].Bounce == 0)
        {
            Add(ref bounces, default);
            pairs[index].Bounce = bounces.Count;
        }
        ref var bounce = ref bounces[pairs[index].Bounce - 1];
        bounce.Impulse += impulse;
        bounce.Friction += friction;
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
        Release(ref bounces);
        Release(ref began);
        Release(ref ended);
        Release(ref hits);
        Release(ref persisting);
        Release(ref held);
        Release(ref holding);
        ReleaseSleep();
        Release(ref manifolds);
        Release(ref spareManifolds);
        Release(ref places);
        Release(ref contacts);
        stage.Release();
    }

    void Release<T>(ref QuickList<T> list) where T : unmanaged
    {
        list.DisposeIfTaken(pool);
        list = default;
    }

    void AbandonLists()
    {
        added = sensed = pairs = spare = default;
        bounces = default;
        began = ended = hits = persisting = default;
        held = holding = default;
        AbandonSleep();
        manifolds = spareManifolds = default;
        places = default;
        contacts = default;
        stage.Abandon();
    }
}
