using System;
using BepuPhysics.Constraints;
using BepuUtilities.Collections;

namespace BepuPhysics;

// Constraints that sleep. All of them lie in one set beside the active one, in columns like all constraints, but have no colours: a batch for those
// that the sweeps solve, and one for each kind of those that they leave out. There they refer to bodies by slots, so that nothing has to follow the
// bodies in memory. A constraint sleeps if its dynamic bodies do; a kinematic body may be awake while some that it holds sleep.
public sealed unsafe partial class Solver
{
    /// <summary>Set of the constraints that sleep.</summary>
    internal const int AsleepSet = 1;

    /// <summary>Number of constraints that sleep, for each of their kinematic bodies.</summary>
    internal int AsleepOfKinematics { get; private set; }

    /// <summary>Whether a constraint that exists sleeps.</summary>
    internal bool IsAsleep(int slot) => Locations[slot].SetIndex == AsleepSet;

    /// <summary>Slot of a body of a constraint that exists.</summary>
    internal int BodySlotOf(in ConstraintLocation location, int bodySlot)
    {
        var reference = EncodedBody.IndexMask &
            Processor(location.TypeId).BodyReference(ref TypeBatchAt(location), location.IndexInTypeBatch, bodySlot);
        return location.SetIndex == AsleepSet ? reference : bodies.Awake.IndexToHandle[reference].Slot;
    }

    /// <summary>Moves a constraint of the active set among those that sleep. Before its bodies.</summary>
    internal void PutToSleep(int constraint)
    {
        Span<float> column = stackalloc float[MaximumFloatsPerConstraint];
        Span<int> encoded = stackalloc int[MaximumBodiesPerConstraint];
        var handle = TakeOut(constraint, 1, column, encoded, out var processor, out var kind);
        kind = kind is BatchKind.Coloured or BatchKind.Shuffled ? BatchKind.Fallback : kind;
        ref var set = ref Sets[AsleepSet];
        if (!set.Batches.Span.Allocated)
            set.Batches = new QuickList<ConstraintBatch>(2, pool);
        var batchIndex = FindOrCreateBatch(ref set, kind);
        ref var typeBatch = ref set.Batches[batchIndex].FindOrCreate(processor.TypeId, pool);
        var index = processor.Allocate(ref typeBatch, handle, encoded[..processor.BodiesPerConstraint], MinimumCapacityPerTypeBatch, pool);
        Locations[constraint] = new() { SetIndex = AsleepSet, BatchIndex = batchIndex, TypeId = processor.TypeId, IndexInTypeBatch = index };
        processor.WriteColumn(ref typeBatch, index, column);
    }

    /// <summary>Moves a constraint that sleeps into the active set, with its impulses. After its bodies.</summary>
    internal void Awaken(int constraint)
    {
        Span<float> column = stackalloc float[MaximumFloatsPerConstraint];
        Span<int> encoded = stackalloc int[MaximumBodiesPerConstraint];
        Span<BodyHandle> handles = stackalloc BodyHandle[MaximumBodiesPerConstraint];
        var handle = TakeOut(constraint, -1, column, encoded, out var processor, out var kind);
        for (int i = 0; i < processor.BodiesPerConstraint; ++i)
            handles[i] = bodies.HandleAt(encoded[i] & EncodedBody.IndexMask);
        // While it slept, the game may have left all joints to the sweeps.
        if (kind == BatchKind.Fallback || kind == BatchKind.Direct && directJoints == DirectJointsMode.Off)
            kind = BatchKind.Coloured;
        var location = Allocate(handle, handles[..processor.BodiesPerConstraint], processor.TypeId, kind);
        Locations[constraint] = location;
        processor.WriteColumn(ref TypeBatchAt(location), location.IndexInTypeBatch, column);
        if (processor.MakesHubs && kind != BatchKind.Disabled)
            MarkHubs(location);
        if (kind == BatchKind.Coloured && (encoded[0] & EncodedBody.GapMask) != 0)
            MarkGap(location);
    }

    /// <summary>Takes a constraint out of its batch, with all that it holds.</summary>
    /// <param name="constraint">The constraint.</param>
    /// <param name="asleepChange">What is added to the number of sleeping constraints of its kinematic bodies.</param>
    /// <param name="column">Receives description and impulses.</param>
    /// <param name="encoded">Receives the slots of its bodies, with the mark of kinematic ones, and that of a gap.</param>
    /// <param name="processor">Its processor.</param>
    /// <param name="kind">Kind of the batch that it was in.</param>
    ConstraintHandle TakeOut(int constraint, int asleepChange, Span<float> column, Span<int> encoded, out TypeProcessor processor, out BatchKind kind)
    {
        var old = Locations[constraint];
        processor = Processor(old.TypeId);
        ref var typeBatch = ref TypeBatchAt(old);
        var handle = typeBatch.IndexToHandle[old.IndexInTypeBatch];
        for (int i = 0; i < processor.BodiesPerConstraint; ++i)
        {
            var slot = BodySlotOf(old, i);
            var marks = processor.BodyReference(ref typeBatch, old.IndexInTypeBatch, i) & (EncodedBody.KinematicFlag | EncodedBody.GapMask);
            encoded[i] = slot | marks;
            if ((marks & EncodedBody.KinematicFlag) != 0)
                CountAsleep(slot, asleepChange);
        }
        processor.ReadColumn(ref typeBatch, old.IndexInTypeBatch, column);
        kind = KindOf(old);
        RemoveFromBatch(old);
        return handle;
    }

    void CountAsleep(int kinematic, int change)
    {
        AsleepOfKinematics += change;
        bodies.SetOf(bodies.Locations[kinematic]).Constraints[bodies.Locations[kinematic].Index].AsleepCount += change;
    }
}
