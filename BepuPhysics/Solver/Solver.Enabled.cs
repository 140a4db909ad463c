using System;
using BepuPhysics.Constraints;

namespace BepuPhysics;

// Constraints that are there and not solved. They are in a batch of their own that no sweep goes over, with bodies and description: nothing else
// has to know of them, and where there are none nothing is asked.
public sealed unsafe partial class Solver
{
    /// <summary>Whether a constraint is solved; all are until they are disabled.</summary>
    /// <exception cref="ArgumentException">There is no such constraint.</exception>
    public bool IsEnabled(ConstraintHandle handle)
    {
        CheckHandle(handle);
        return KindOf(Locations[handle.Slot]) != BatchKind.Disabled;
    }

    /// <summary>Chooses whether a constraint is solved.</summary>
    /// <remarks>
    /// A disabled constraint keeps its bodies, description and handle, costs nothing in a step, and is removed with its bodies as all are. Its impulses are
    /// zero: what it bore before means nothing when it is enabled again. Whether its bodies collide does not depend on it
    /// (<see cref="SetCollideConnected"/>).
    /// </remarks>
    /// <param name="handle">The constraint; no contact.</param>
    /// <param name="enabled">Whether it is to be solved.</param>
    /// <exception cref="ArgumentException">There is no such constraint, or it is a contact; nothing was changed.</exception>
    public void SetEnabled(ConstraintHandle handle, bool enabled)
    {
        using var change = world.Change("Solver.SetEnabled");
        CheckJoint(handle);
        if (KindOf(Locations[handle.Slot]) != BatchKind.Disabled == enabled)
            return;
        WakeBodiesOf(handle);
        if (!enabled)
            ForgetImpulses(handle);
        // One of the bodies is dynamic, or it would have been removed.
        TryMove(handle, enabled ? BatchKind.Coloured : BatchKind.Disabled);
        CountEnabled(Locations[handle.Slot], enabled ? 1 : -1);
        if (enabled && closesGapsSlowly)
            MarkGap(Locations[handle.Slot]);
        // What it needed before means nothing either.
        NumberJoint(handle);
    }

    // What is not solved makes no hubs.
    void CountEnabled(in ConstraintLocation location, int change)
    {
        var processor = Processor(location.TypeId);
        if (!processor.MakesHubs)
            return;
        for (int slot = 0; slot < processor.BodiesPerConstraint; ++slot)
            ChangeJointCount(processor.BodyReference(ref TypeBatchAt(location), location.IndexInTypeBatch, slot) & EncodedBody.IndexMask, change);
        MarkHubs(location);
        MoveJointsOfTurned();
    }

    void CheckJoint(ConstraintHandle handle)
    {
        CheckHandle(handle);
        if (Locations[handle.Slot].TypeId < ConstraintTypeIds.ContactTypeCount)
            throw new ArgumentException($"{handle} is a contact, which is the narrow phase's to change.", nameof(handle));
    }
}
