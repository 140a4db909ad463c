using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using BepuPhysics.Constraints.Contact;
using BepuUtilities;
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
    // Of the manifolds that the stage sums up.
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
        stage.Manifolds.Count = contacts.Count = 0;
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
        Merge(ref cache);
        added.Count = 0;
    }

    void Merge(ref PairCache cache)
    {
        spare.Count = 0;
        int known = 0;
        int fresh = 0;
        while (known < pairs.Count || fresh < added.Count)
        {
            var order = known == pairs.Count ? 1 : fresh == added.Count ? -1 : ListenedPair.Compare(pairs[known], added[fresh]);
            var pair = order <= 0 ? pairs[known++] : added[fresh];
            var isNoted = order >= 0;
            var isSensed = false;
            pair.MayPass = pair.HasPassed = false;
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
            pair.BounceImpulse = 0;
            pair.FirstManifold = stage.Manifolds.Count;
            pair.IsAsleep = pair.IsSensor && !isNoted && Sleeps(pair.Pair);
            pair.Exists = pair.IsAsleep || (pair.IsSensor ? isSensed : ListContacts(ref pair, ref cache));
            pair.ManifoldCount = stage.Manifolds.Count - pair.FirstManifold;
            if (pair.Exists || pair.MayPass)
                pair.Mask = MaskOf(pair.Pair);
            if (pair.Mask != EventMask.None && (pair.Exists || pair.MayPass || pair.Touches))
                Add(ref spare, pair);
        }
        (pairs, spare) = (spare, pairs);
    }

    // Lists the contacts that a pair has, if it still is one.
    bool ListContacts(ref ListenedPair pair, ref PairCache cache)
    {
        var index = cache.Pairs.IndexOf(pair.Pair);
        if (index < 0)
            return false;
        var start = stage.Manifolds.Count;
        ref var set = ref bodies.SetOf(pair.Pair.A.BodyHandle, out var indexA);
        pair.CenterOfA = set.MotionStates[indexA].Pose.Position;
        for (var manifolds = cache.ManifoldsOf(index); manifolds.MoveNext();)
        {
            ref var manifold = ref manifolds.Current;
            if (!manifold.HasConstraint)
                continue;
            var count = ConstraintTypeIds.ContactCount(manifold.ConstraintTypeId);
            Add(ref stage.Manifolds, new() { Constraint = manifold.Constraint, ContactCount = count, FirstContact = contacts.Count });
            var rows = new ContactRows(solver, bodies, manifold.Constraint, count);
            pair.OffsetB = rows.OffsetB;
            // There the constraint may have the place of friction.
            if (pair.Pair.B.Mobility == CollidableMobility.Kinematic)
                pair.OffsetB = bodies.SetOf(pair.Pair.B.BodyHandle, out var indexB).MotionStates[indexB].Pose.Position - pair.CenterOfA;
            for (int i = 0; i < count; ++i)
            {
                Add(ref contacts, new()
                {
                    Position = pair.CenterOfA + rows.Arm(i),
                    Normal = rows.Normal,
                    Depth = rows.Depth(i),
                    FeatureId = manifold.Features[i],
                    ChildA = manifolds.Children.A,
                    ChildB = manifolds.Children.B,
                });
            }
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
            var described = Describe(pair, out var touches);
            if (pair.Touches && !touches)
                Tell(ref ended, EventMask.End, pair, described);
            else if (pair.Touches)
                Tell(ref persisting, EventMask.Persist, pair, described);
            else if (touches)
                Tell(ref began, EventMask.Begin, pair, described);
            if (described.Impulse > 0 && described.ApproachSpeed >= hitSpeed)
                Tell(ref hits, EventMask.Hit, pair, described);
            pair.Touches = touches;
            // What has passed ends in the next step, unless it is still there.
            if (pair.Exists || pair.HasPassed)
                pairs[kept++] = pair;
        }
        pairs.Count = kept;
        isSettled = asleep == kept;
        removalsSeen = traits.RemovalCount;
    }

    void Tell(ref QuickList<ContactEvent> list, EventMask kind, in ListenedPair pair, in ContactEvent contactEvent)
    {
        if ((pair.Mask & kind) != 0)
            Add(ref list, contactEvent);
    }

    ContactEvent Describe(in ListenedPair pair, out bool touches)
    {
        var result = new ContactEvent { Pair = pair.Pair, IsSensor = pair.IsSensor, Impulse = pair.BounceImpulse, ApproachSpeed = float.NegativeInfinity };
        touches = pair.BounceImpulse > 0 || (pair.IsSensor && (pair.Exists || pair.HasPassed));
        if (pair.ManifoldCount == 0)
        {
            result.ApproachSpeed = 0;
            return result;
        }
        result.FirstContact = stage.Manifolds[pair.FirstManifold].FirstContact;
        var strongest = result.FirstContact;
        for (int i = 0; i < pair.ManifoldCount; ++i)
        {
            ref var manifold = ref stage.Manifolds[pair.FirstManifold + i];
            result.FrictionImpulse += manifold.Friction;
            result.ApproachSpeed = MathHelper.Max(result.ApproachSpeed, manifold.ApproachSpeed);
            result.ContactCount += manifold.ContactCount;
            for (int j = manifold.FirstContact; j < manifold.FirstContact + manifold.ContactCount; ++j)
            {
                ref var contact = ref contacts[j];
                contact.Impulse = manifold.Normals[j - manifold.FirstContact];
                result.Impulse += contact.Impulse;
                touches |= contact.Depth > 0 || contact.Impulse > 0;
                if (IsStronger(contact, contacts[strongest]))
                    strongest = j;
            }
        }
        result.Position = contacts[strongest].Position;
        result.Normal = contacts[strongest].Normal;
        result.Depth = contacts[strongest].Depth;
        return result;
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
        contacts = default;
    }
}
