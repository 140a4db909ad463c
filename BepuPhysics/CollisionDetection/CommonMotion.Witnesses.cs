using System.Numerics;
using BepuPhysics.Collidables;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

// Witnesses: through whom a body meets something that does not move along.
//
// A limb in a soft body, or a pusher in a heap, has hundreds of bodies around it, and mostly one of them or another meets what does not move along, in this
// step as in the last. So each body remembers a neighbour from which it is one step less to such a thing, and who they are is asked before everybody around
// them. Nothing that is remembered is believed: that they are still there, that their bounds overlap and that they do not move along, is found again.
sealed unsafe partial class CommonMotion
{
    // Per body, by its slot. The default is as good a guess as another.
    Buffer<CollidableReference> witnesses;
    // Place among the companions of who found each of those that are gone over at present, from the first of them on.
    QuickList<int> foundBy;

    /// <summary>Whether bodies remember them; else all around a body are asked in each step, to the same bits, which tests compare.</summary>
    internal bool Remembers = true;

    void ForgetWitnesses()
    {
        pool.ReturnIfTaken(ref witnesses);
        foundBy.DisposeIfTaken(pool);
    }

    void MakeRoomForWitnesses()
    {
        var slots = simulation.Bodies.Locations.Length;
        var known = witnesses.Length;
        if (known >= slots)
            return;
        pool.ResizeToAtLeast(ref witnesses, slots, known);
        witnesses.Clear(known, witnesses.Length - known);
    }

    ref CollidableReference WitnessOf(int body) => ref witnesses[Awake.IndexToHandle[body].Slot];

    // From the last of the companions to whom it remembers, and on, while these are where they were. All of them are companions then, if nobody is among
    // them who does not move along.
    void FollowWitnesses(ref Near near, int start)
    {
        for (int i = start; Remembers && i < companions.Count && near.AllMoveAlong; ++i)
        {
            near.Self = companions[i];
            if (!TryFind(WitnessOf(near.Self), BoundsOf(near.Self), out var witness))
                return;
            near.LoopBody(witness);
            NoteFound(start, i);
        }
    }

    // As it is now: a body may have become kinematic since.
    bool TryFind(CollidableReference witness, in BoundingBox bounds, out CollidableReference collidable)
    {
        collidable = default;
        var broadPhase = simulation.BroadPhase;
        int leaf;
        var isInActiveTree = false;
        if (witness.Mobility == CollidableMobility.Static)
        {
            if (!simulation.Statics.StaticExists(witness.StaticHandle))
                return false;
            leaf = simulation.Statics.StaticsBuffer[simulation.Statics.Indices[witness.Slot]].BroadPhaseIndex;
        }
        else
        {
            if (!simulation.Bodies.BodyExists(witness.BodyHandle))
                return false;
            ref var set = ref simulation.Bodies.SetOf(witness.BodyHandle, out var index);
            isInActiveTree = !set.IsAsleep;
            leaf = set.Collidables[index].BroadPhaseIndex;
        }
        if (leaf < 0)
            return false;
        Vector3* min, max;
        if (isInActiveTree)
            broadPhase.GetActiveBoundsPointers(leaf, out min, out max);
        else
            broadPhase.GetStaticBoundsPointers(leaf, out min, out max);
        collidable = isInActiveTree ? broadPhase.ActiveLeaves[leaf] : broadPhase.StaticLeaves[leaf];
        return BoundingBox.IntersectsUnsafe(bounds.Min, bounds.Max, *min, *max);
    }

    // Who has come since was found by the one at a place.
    void NoteFound(int start, int place)
    {
        while (foundBy.Count < companions.Count - start)
            foundBy.Add(place, pool);
    }

    // Each remembers who is on the way to the last of them that was asked, who has met something that does not move along.
    void Remember(in Near near, int start)
    {
        var last = start;
        for (int i = start; i < companions.Count; ++i)
        {
            if (companions[i] == near.Self)
                last = i;
            else
                WitnessOf(companions[i]) = ReferenceTo(companions[foundBy[i - start]]);
        }
        var next = near.Met;
        while (true)
        {
            WitnessOf(companions[last]) = next;
            if (last == start)
                return;
            next = ReferenceTo(companions[last]);
            last = foundBy[last - start];
        }
    }

    CollidableReference ReferenceTo(int body) => new(CollidableMobility.Dynamic, Awake.IndexToHandle[body]);
}
