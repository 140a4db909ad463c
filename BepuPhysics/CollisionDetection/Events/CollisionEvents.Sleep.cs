using System;
using BepuPhysics.Collidables;
using BepuUtilities.Collections;

namespace BepuPhysics.CollisionDetection;

// Pairs that sleep are in no list, so they cost no step anything. That they touched is remembered until they wake.
public sealed unsafe partial class CollisionEvents
{
    // Pairs that sleep, are listened to, and touched when they fell asleep; no memory before there is one.
    QuickDictionary<CollidablePair, byte, CollidablePairComparer> touchingAsleep;
    // Bodies that fell asleep or woke since the last step ended, once for each time.
    QuickList<BodyHandle> turned;
    QuickList<BodyHandle> slept;
    QuickList<BodyHandle> woke;
    // Whether all that is listened to sleeps, so that a step in which nobody is awake has nothing to look at.
    bool isSettled;
    int removalsSeen;

    /// <summary>Bodies that fell asleep, of those that are listened to for <see cref="EventMask.Sleep"/>, in the order of slots.</summary>
    /// <remarks>Since the step before ended: what a game puts to sleep between two steps is told after the second. One that also woke is not named.</remarks>
    public ReadOnlySpan<BodyHandle> Slept => AsSpan(slept);

    /// <summary>Bodies that woke, of those that are listened to for <see cref="EventMask.Sleep"/>, in the order of slots.</summary>
    /// <remarks>Since the step before ended: whom a game wakes between two steps is told after the second. One that fell asleep again is not named.</remarks>
    public ReadOnlySpan<BodyHandle> Woke => AsSpan(woke);

    /// <summary>Number of pairs that a step goes through.</summary>
    internal int ListedPairCount => pairs.Count;

    /// <summary>Grows whenever pairs that sleep wake.</summary>
    internal long WokenPairCount { get; private set; }

    /// <summary>Notes that a body falls asleep or wakes.</summary>
    internal void NoteTurned(int slot)
    {
        if (!IsUsed)
            return;
        var body = bodies.HandleAt(slot);
        if ((traits.Listeners[new CollidableReference(CollidableMobility.Dynamic, body)] & (byte)EventMask.Sleep) != 0)
            Add(ref turned, body);
    }

    /// <summary>Notes that contacts of a pair wake.</summary>
    internal void NoteAwake(in CollidablePair pair)
    {
        if (!IsUsed)
            return;
        ++WokenPairCount;
        var touched = touchingAsleep.Keys.Allocated && touchingAsleep.FastRemove(pair);
        // Who wakes may be about to be removed, and nothing is known of it then.
        var mask = MaskOf(pair);
        if (mask != EventMask.None)
            Add(ref added, new() { Pair = pair, Mask = mask, Touches = touched });
    }

    void RememberAsleep(in ListenedPair pair)
    {
        if (!pair.Touches || MaskOf(pair.Pair) == EventMask.None)
            return;
        if (!touchingAsleep.Keys.Allocated)
            touchingAsleep = new(64, pool);
        touchingAsleep.Add(pair.Pair, 1, pool);
    }

    // Whether nobody is awake of what a sensor has seen.
    bool Sleeps(in CollidablePair pair) => Sleeps(pair.A) && (pair.B.Mobility == CollidableMobility.Static || Sleeps(pair.B));

    bool Sleeps(CollidableReference body) => bodies.BodyExists(body.BodyHandle) && bodies.IsAsleep(body.Slot);

    // Who turned an even number of times is as before.
    void TellSleep()
    {
        if (turned.Count == 0)
            return;
        var all = turned.Span.AsSpan()[..turned.Count];
        all.Sort(static (a, b) => a.Slot != b.Slot ? a.Slot.CompareTo(b.Slot) : a.Value.CompareTo(b.Value));
        for (int i = 0, next; i < all.Length; i = next)
        {
            for (next = i + 1; next < all.Length && all[next] == all[i];)
                ++next;
            if ((next - i) % 2 != 0 && bodies.BodyExists(all[i]))
                Add(ref (bodies.IsAsleep(all[i].Slot) ? ref slept : ref woke), all[i]);
        }
        turned.Count = 0;
    }

    void ReleaseSleep()
    {
        Release(ref turned);
        Release(ref slept);
        Release(ref woke);
        if (touchingAsleep.Keys.Allocated)
            touchingAsleep.Dispose(pool);
        touchingAsleep = default;
    }

    void AbandonSleep()
    {
        turned = slept = woke = default;
        touchingAsleep = default;
    }
}
