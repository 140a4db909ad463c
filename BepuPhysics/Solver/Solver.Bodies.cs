using System;
using BepuPhysics.Constraints;
using BepuUtilities;

namespace BepuPhysics;

// From bodies to their constraints and back.
public sealed unsafe partial class Solver
{
    /// <summary>Which constraints each body has.</summary>
    internal ConstraintEdges Edges;

    /// <summary>What an edge says to a game.</summary>
    internal BodyConstraintReference ReferenceOf(int edge) => new()
    {
        ConnectingConstraintHandle = new(owners.ValueAt(Edges.ConstraintSlot(edge))),
        BodyIndexInConstraint = Edges.BodySlot(edge),
    };

    internal void EnumerateOtherBodies<TEnumerator>(in BodyConstraintReference constraint, ref TEnumerator enumerator) where TEnumerator : IForEach<BodyHandle>
    {
        ref var location = ref Locations[constraint.ConnectingConstraintHandle.Slot];
        var processor = Processor(location.TypeId);
        for (int slot = 0; slot < processor.BodiesPerConstraint; ++slot)
        {
            if (slot == constraint.BodyIndexInConstraint)
                continue;
            enumerator.LoopBody(bodies.HandleAt(BodySlotOf(location, slot)));
        }
    }

    /// <summary>Removes all constraints of a body, from the last to the first.</summary>
    internal void RemoveConstraintsOf(ref ConstraintList list)
    {
        while (list.Count > 0)
            RemoveConstraint(ReferenceOf(Edges.Previous(list.First)).ConnectingConstraintHandle);
    }

    void RemoveFromBodies(ConstraintHandle handle)
    {
        ref var location = ref Locations[handle.Slot];
        ref var typeBatch = ref TypeBatchAt(location);
        var processor = Processor(location.TypeId);
        for (int slot = 0; slot < processor.BodiesPerConstraint; ++slot)
        {
            var reference = processor.BodyReference(ref typeBatch, location.IndexInTypeBatch, slot) & EncodedBody.IndexMask;
            Edges.Remove(ref bodies.Sets[location.SetIndex].Constraints[reference], Edges.EdgeOf(handle.Slot, slot));
            if (processor.MakesHubs && KindOf(location) != BatchKind.Disabled)
                ChangeJointCount(reference, -1);
        }
    }

    /// <summary>
    /// Puts the constraints of a body into batches anew, after it became kinematic or dynamic. Impulses and descriptions stay. Constraints
    /// that are left without a dynamic body are removed.
    /// </summary>
    internal void Recolor(BodyHandle body)
    {
        ref var constraints = ref bodies.SetOf(body, out var recolored).Constraints[recolored];
        var edge = constraints.First;
        for (int i = constraints.Count; i > 0; --i)
        {
            // From the last to the first; those that follow stay where they are when one is removed.
            edge = Edges.Previous(edge);
            var handle = ReferenceOf(edge).ConnectingConstraintHandle;
            if (!TryMove(handle, IsSwept(handle) ? BatchKind.Coloured : KindOf(Locations[handle.Slot])))
                RemoveConstraint(handle);
        }
    }

    /// <summary>Whether a constraint that exists is solved by the sweeps.</summary>
    internal bool IsSwept(ConstraintHandle handle) => BatchOf(Locations[handle.Slot]).IsSwept;

    BatchKind KindOf(in ConstraintLocation location) => BatchOf(location).Kind;

    ref ConstraintBatch BatchOf(in ConstraintLocation location) => ref Sets[location.SetIndex].Batches[location.BatchIndex];

    /// <summary>
    /// Leaves a constraint that exists and is enabled out of the sweeps, or takes it in again. Whoever leaves it out solves it, by its rows
    /// (<see cref="TypeProcessor.ReadRows(ref TypeBatch, in SolverBodies, in Substep, int, Span{ConstraintRow})"/>). Impulses stay.
    /// </summary>
    internal void SetSwept(ConstraintHandle handle, bool isSwept)
    {
        if (IsSwept(handle) == isSwept)
            return;
        TryMove(handle, isSwept ? BatchKind.Coloured : BatchKind.Direct);
        // What it was added with it goes on to close.
        if (!isSwept || handle.Slot >= needs.Length || !needs[handle.Slot].Closes)
            return;
        MarkGap(Locations[handle.Slot]);
        needs[handle.Slot].Closing = 0;
    }

    // Puts a constraint into a batch anew, for what its bodies are now; false where none of them is dynamic. Coloured stands for all kinds that are swept.
    bool TryMove(ConstraintHandle handle, BatchKind kind)
    {
        Span<BodyHandle> handles = stackalloc BodyHandle[MaximumBodiesPerConstraint];
        Span<float> column = stackalloc float[MaximumFloatsPerConstraint];
        var old = Locations[handle.Slot];
        ref var set = ref bodies.Sets[old.SetIndex];
        var processor = Processor(old.TypeId);
        ref var typeBatch = ref TypeBatchAt(old);
        bool anyDynamic = false;
        for (int slot = 0; slot < processor.BodiesPerConstraint; ++slot)
        {
            var index = processor.BodyReference(ref typeBatch, old.IndexInTypeBatch, slot) & EncodedBody.IndexMask;
            handles[slot] = set.IndexToHandle[index];
            anyDynamic |= !Bodies.IsKinematic(set.LocalInertias[index]);
        }
        if (!anyDynamic)
            return false;
        processor.ReadColumn(ref typeBatch, old.IndexInTypeBatch, column);
        var hasGap = HasGap(old);
        RemoveFromBatch(old);
        var location = Allocate(handle, handles[..processor.BodiesPerConstraint], old.TypeId, kind);
        Locations[handle.Slot] = location;
        processor.WriteColumn(ref TypeBatchAt(location), location.IndexInTypeBatch, column);
        if (processor.MakesHubs)
            MarkHubs(location);
        if (hasGap && kind == BatchKind.Coloured)
            MarkGap(location);
        return true;
    }

    /// <summary>Follows a body that moved to another index of the active set.</summary>
    internal void UpdateBodyIndex(in BodySet set, int newIndex)
    {
        foreach (var constraint in new BodyConstraints(this, set.Constraints[newIndex]))
        {
            ref var location = ref Locations[constraint.ConnectingConstraintHandle.Slot];
            if (location.SetIndex != 0)
                continue;
            ref var reference = ref Processor(location.TypeId).BodyReference(ref TypeBatchAt(location), location.IndexInTypeBatch,
                constraint.BodyIndexInConstraint);
            reference = reference & ~EncodedBody.IndexMask | newIndex;
            NoteJointChange(location.TypeId);
        }
    }
}
