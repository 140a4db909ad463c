using System;
using BepuPhysics.Constraints;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics;

// What is remembered of joints where they may be solved at once: the order in which they were added, and where the solver itself chooses, what says how they
// are solved (JointNeed.cs). By slot, with whatever becomes of the joint: it may sleep, move in memory, be of another structure. If no joint is ever solved at
// once there is none of it.
public sealed unsafe partial class Solver
{
    // Each joint is looked at once in so many steps.
    internal const int NeedTurns = 8;

    Buffer<JointNeed> needs;
    // How many joints were numbered, and how many of them had been when the last step began.
    long numbered;
    long numberedBefore;
    // How many had been when the turns last began, and the time before.
    long numberedAtTurn;
    long numberedAtLastTurn;
    // Steps modulo the turns, whether anything is awake or not: what else there is does not decide when a joint is looked at.
    int needTurn;
    // Whether a joint that is swept over has begun to ask, or none of a structure does any more.
    bool needsChanged;

    /// <summary>Whether the solver chooses, structure by structure, how joints are solved.</summary>
    internal bool ChoosesDirectJoints => directJoints == DirectJointsMode.WhereNeeded;

    /// <summary>Whether anything is remembered of any joint but its number: nothing comes of resting otherwise.</summary>
    // Many workers write it, and all the same.
    internal bool RemembersNeeds { get; set; }

    /// <summary>Whether there are joints so new that they are looked at in each step: what falls by itself is found before it has fallen far.</summary>
    internal bool HasNewJoints => numbered > numberedAtLastTurn;

    /// <summary>Whether a joint is one of these.</summary>
    internal bool IsNew(in JointNeed joint) => joint.Number > numberedAtLastTurn;

    /// <summary>Which joints are looked at in the present step.</summary>
    internal int NeedTurn => needTurn;

    /// <summary>Whether joints may be on their way: some that are awake are solved at once, or were, or close slowly what they were added with.</summary>
    // Not what was chosen last: a restored world has to choose first.
    internal bool MayBeOnTheWay => closesGapsSlowly || (directJoints != DirectJointsMode.Off && FindBatch(ActiveSet, BatchKind.Direct) >= 0);

    /// <summary>Whether a joint is on its way from the sweeps to being solved at once, or closes a gap that it was added with.</summary>
    internal bool IsOnItsWay(int slot) => KindOf(Locations[slot]) == BatchKind.Direct
        ? needs[slot].IsUnderway
        : BatchOf(Locations[slot]).IsOfColour && HasGap(Locations[slot]);

    /// <summary>What is remembered of a joint. Only where joints may be solved at once.</summary>
    internal ref JointNeed NeedOf(ConstraintHandle joint) => ref needs[joint.Slot];

    // Whether joints have numbers. What a game takes back between two steps has not happened: nothing is forgotten before a step has left all to the sweeps.
    bool AreNumbered => directJoints != DirectJointsMode.Off || chosenMode != DirectJointsMode.Off;

    // Of a joint that was just added or enabled.
    void NumberJoint(ConstraintHandle joint)
    {
        if (AreNumbered && Locations[joint.Slot].TypeId >= ConstraintTypeIds.ContactTypeCount)
            RefOfNeed(joint.Slot) = new() { Number = ++numbered };
    }

    ref JointNeed RefOfNeed(int slot)
    {
        if (slot >= needs.Length)
        {
            var before = needs.Length;
            pool.ResizeToAtLeast(ref needs, Locations.Length, before);
            needs.Clear(before, needs.Length - before);
        }
        return ref needs[slot];
    }

    // The mode has become another one. Where the solver chooses, what is solved at once already goes on so until its load says that it need not.
    void BeginNeeds(bool areNumbered)
    {
        needsChanged = RemembersNeeds = false;
        for (int slot = 0; slot < UsedSlotCount; ++slot)
        {
            if (Locations[slot].SetIndex < 0 || Locations[slot].TypeId < ConstraintTypeIds.ContactTypeCount)
                continue;
            ref var need = ref RefOfNeed(slot);
            need = need.Renewed(need.Number > 0 ? need.Number : ++numbered);
            if (!ChoosesDirectJoints || KindOf(Locations[slot]) != BatchKind.Direct || !MayAsk(Locations[slot].TypeId))
                continue;
            need.Ask();
            RemembersNeeds = true;
        }
        numberedAtTurn = numberedAtLastTurn = numbered;
        // What had no number has been swept over for long, unless there was no step yet.
        if (!areNumbered)
            numberedBefore = stepNumber > 0 ? numbered : 0;
    }

    void ForgetNeeds()
    {
        needs.Clear(0, needs.Length);
        numbered = numberedBefore = numberedAtTurn = numberedAtLastTurn = 0;
        needsChanged = RemembersNeeds = false;
    }

    void EndNeeds()
    {
        ForgetNeeds();
        DisposeNeeds();
    }

    void DisposeNeeds()
    {
        pool.ReturnIfTaken(ref needs);
    }

    // Leaves the joints that go over from sweeps to all at once, or back, in their own order: structures come and go, and what they do to the order in memory
    // of the joints of others may not say which colours these get.
    void ChangeOver(ref QuickList<DirectCandidate> joints)
    {
        var count = 0;
        foreach (ref var joint in joints.AsSpan())
        {
            ref var need = ref needs[joint.Handle.Slot];
            if (joint.IsRefused && ChoosesDirectJoints)
                need.Refuse();
            if (joint.IsDirect != IsSwept(joint.Handle))
                continue;
            // One that the sweeps have had for a step goes over slowly. One that is new has not given way to anything, and is corrected at once.
            if (joint.IsDirect && HasGap(Locations[joint.Handle.Slot]))
                (need.Closing, need.Underway) = (float.PositiveInfinity, 0);
            else if (joint.IsDirect && need.Number <= numberedBefore)
                need.Ease();
            joints[count++] = joint;
        }
        joints.Count = count;
        joints.AsSpan().Sort(static (a, b) => a.Number.CompareTo(b.Number));
    }

    void ReadNeeds()
    {
        needTurn = (needTurn + 1) % NeedTurns;
        if (needTurn == 0)
            (numberedAtLastTurn, numberedAtTurn) = (numberedAtTurn, numbered);
        numberedBefore = numbered;
        if (!ChoosesDirectJoints)
            return;
        needsChanged |= needStage.HasChanged;
    }

    void CopyNeeds(StateCopy copy)
    {
        copy.Rows(ref needs, Math.Min(needs.Length, UsedSlotCount), absent: default);
        copy.Value(ref numbered);
        copy.Value(ref numberedBefore);
        copy.Value(ref numberedAtTurn);
        copy.Value(ref numberedAtLastTurn);
        copy.Value(ref needTurn);
        copy.Value(ref needsChanged);
        RemembersNeeds = copy.Value(RemembersNeeds);
    }

    void ValidateNeeds()
    {
        if (directJoints == DirectJointsMode.Off)
            return;
        for (int slot = 0; slot < UsedSlotCount; ++slot)
        {
            if (Locations[slot].SetIndex < 0 || Locations[slot].TypeId < ConstraintTypeIds.ContactTypeCount)
                continue;
            Invariant.Require(slot < needs.Length && needs[slot].Number > 0 && needs[slot].Number <= numbered, "number of a joint", slot);
            Invariant.Require(needs[slot].Asks >= 0 && needs[slot].Asks <= needs[slot].Period, "time for which a joint asks", slot);
        }
    }
}
