using System;
using BepuUtilities.Collections;

namespace BepuPhysics;

// What a game may say of single constraints beyond their description. It is kept by slot, apart from the constraints, and goes with them.
public sealed unsafe partial class Solver
{
    // Slots of the constraints whose bodies do not collide.
    IndexSet apart;
    int apartCount;

    /// <summary>Whether there are bodies that do not collide because a constraint connects them.</summary>
    internal bool HasApart => apartCount > 0;

    /// <summary>Whether the bodies of a constraint may collide with each other; they may until it was said that they may not.</summary>
    /// <exception cref="ArgumentException">There is no such constraint.</exception>
    public bool GetCollideConnected(ConstraintHandle handle)
    {
        CheckHandle(handle);
        return !apart.Contains(handle.Slot);
    }

    /// <summary>Chooses whether the bodies of a constraint may collide with each other.</summary>
    /// <remarks>
    /// One constraint that says no is enough for two bodies, whatever others say, and so it is while it is disabled. From the next step on; no callback
    /// is asked about such a pair. Where a scene has such a constraint, each pair of bodies that may touch looks through the constraints of the one that
    /// has fewer. Wakes the bodies where it changes something: what they touch is no longer what it was.
    /// </remarks>
    /// <param name="handle">The constraint; no contact.</param>
    /// <param name="collide">Whether its bodies may collide.</param>
    /// <exception cref="ArgumentException">There is no such constraint, or it is a contact; nothing was changed.</exception>
    public void SetCollideConnected(ConstraintHandle handle, bool collide)
    {
        using var change = world.Change("Solver.SetCollideConnected");
        CheckJoint(handle);
        if (apart.Contains(handle.Slot) != collide)
            return;
        WakeBodiesOf(handle);
        if (collide)
            ForgetApart(handle.Slot);
        else
        {
            apart.Set(handle.Slot, pool);
            ++apartCount;
        }
    }

    /// <summary>Whether a constraint says that two bodies do not collide.</summary>
    internal bool KeepsApart(BodyHandle a, BodyHandle b)
    {
        ref readonly var ofA = ref ConstraintsOf(a);
        ref readonly var ofB = ref ConstraintsOf(b);
        var (list, other) = ofA.Count <= ofB.Count ? (ofA, b) : (ofB, a);
        var edge = list.First;
        for (int i = list.Count; i > 0; --i, edge = Edges.Next(edge))
        {
            var slot = Edges.ConstraintSlot(edge);
            if (apart.Contains(slot) && Connects(Locations[slot], other))
                return true;
        }
        return false;
    }

    ref readonly ConstraintList ConstraintsOf(BodyHandle body)
    {
        ref var location = ref bodies.Locations[body.Slot];
        return ref bodies.SetOf(location).Constraints[location.Index];
    }

    bool Connects(in ConstraintLocation location, BodyHandle body)
    {
        for (int i = 0; i < Processor(location.TypeId).BodiesPerConstraint; ++i)
        {
            if (BodySlotOf(location, i) == body.Slot)
                return true;
        }
        return false;
    }

    void ForgetApart(int slot)
    {
        apart.Remove(slot);
        --apartCount;
    }

    // Of a constraint that is about to be removed.
    void ForgetOptions(int slot)
    {
        if (apartCount > 0 && apart.Contains(slot))
            ForgetApart(slot);
        if (breakable.Count > 0)
            ForgetBreakable(slot);
    }

    void ForgetOptions()
    {
        if (apartCount > 0)
            apart.Clear();
        apartCount = 0;
        while (breakable.Count > 0)
            ForgetBreakable(breakable[breakable.Count - 1].Handle.Slot);
        broken.Count = 0;
    }

    void DisposeOptions()
    {
        if (apart.Flags.Allocated)
            apart.Dispose(pool);
        breakable.DisposeIfTaken(pool);
        broken.DisposeIfTaken(pool);
        pool.ReturnIfTaken(ref breakablePlaces);
    }

    void AbandonOptions()
    {
        apart = default;
        apartCount = 0;
        breakable = default;
        broken = default;
        breakablePlaces = default;
    }

    void ValidateOptions()
    {
        int count = 0;
        for (int slot = 0; slot < Locations.Length; ++slot)
        {
            if (!apart.Contains(slot))
                continue;
            Invariant.Require(Locations[slot].SetIndex >= 0, "constraint whose bodies do not collide", slot);
            ++count;
        }
        Invariant.Require(count == apartCount, "number of constraints whose bodies do not collide", count, apartCount);
        for (int i = 0; i < breakable.Count; ++i)
        {
            Invariant.Require(ConstraintExists(breakable[i].Handle), "constraint that may break", i);
            Invariant.Require(breakablePlaces[breakable[i].Handle.Slot] == i + 1, "place of a constraint that may break", i);
        }
    }
}
