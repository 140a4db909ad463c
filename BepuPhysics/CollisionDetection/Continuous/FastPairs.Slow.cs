using BepuPhysics.Collidables;

namespace BepuPhysics.CollisionDetection;

// Who is thrown aside within bounds that it has already comes to nobody whom the broad phase has not found. These pairs are watched, unless they were too slow
// for that: so only bodies that are in such a pair look around then.
sealed unsafe partial class FastPairs
{
    /// <summary>Begins to note slow pairs, if there were fast ones in the last step.</summary>
    internal void BeginDetection()
    {
        slow.Count = 0;
        if (pairs.Count == 0)
            return;
        var count = Bodies.Locations.Length;
        slow.EnsureCapacity(count, pool);
        slow.Count = count;
        slow.AsSpan().Clear();
    }

    /// <summary>Notes that a marked pair is slow; by any thread.</summary>
    internal void NoteSlow(in CollidablePair pair)
    {
        if (slow.Count == 0)
            return;
        NoteSlow(pair.A);
        NoteSlow(pair.B);
    }

    void NoteSlow(CollidableReference collidable)
    {
        if (collidable.Mobility != CollidableMobility.Static)
            slow[collidable.Slot] = true;
    }

    /// <summary>Takes it that any body may be in a pair that is not watched.</summary>
    internal void KnowNoneSlow() => slow.Count = 0;

    bool MayBeSlow(BodyHandle body) => body.Slot >= slow.Count || slow[body.Slot];

    // Of two, who is not watched looks for all when it comes to be.
    void HaveOthers(int body)
    {
        if (body >= 0 && moverOf[body] is var mover && mover >= 0)
            movers[mover].MayHaveOthers = true;
    }
}
