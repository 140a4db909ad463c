using System;
using System.Runtime.CompilerServices;
using BepuPhysics.Constraints;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Diagnostics;

namespace BepuPhysics;

// Adding, removing and looking at constraints.
public sealed unsafe partial class Solver
{
    internal const int MaximumBodiesPerConstraint = 4;
    const int MaximumFloatsPerConstraint = 128;

    /// <summary>Adds a constraint on one body.</summary>
    /// <exception cref="ArgumentException">The body does not exist or a value cannot be simulated; nothing was changed.</exception>
    public ConstraintHandle Add<TDescription>(BodyHandle bodyHandle, in TDescription description)
        where TDescription : unmanaged, IOneBodyConstraintDescription<TDescription> => Add([bodyHandle], description);

    /// <summary>Adds a constraint between two bodies.</summary>
    /// <exception cref="ArgumentException">A body does not exist, all are kinematic, or a value cannot be simulated; nothing was changed.</exception>
    public ConstraintHandle Add<TDescription>(BodyHandle bodyHandleA, BodyHandle bodyHandleB, in TDescription description)
        where TDescription : unmanaged, ITwoBodyConstraintDescription<TDescription> => Add([bodyHandleA, bodyHandleB], description);

    /// <summary>Adds a constraint between three bodies.</summary>
    /// <exception cref="ArgumentException">A body does not exist, all are kinematic, or a value cannot be simulated; nothing was changed.</exception>
    public ConstraintHandle Add<TDescription>(BodyHandle bodyHandleA, BodyHandle bodyHandleB, BodyHandle bodyHandleC, in TDescription description)
        where TDescription : unmanaged, IThreeBodyConstraintDescription<TDescription> => Add([bodyHandleA, bodyHandleB, bodyHandleC], description);

    /// <summary>Adds a constraint between four bodies.</summary>
    /// <exception cref="ArgumentException">A body does not exist, all are kinematic, or a value cannot be simulated; nothing was changed.</exception>
    public ConstraintHandle Add<TDescription>(
        BodyHandle bodyHandleA, BodyHandle bodyHandleB, BodyHandle bodyHandleC, BodyHandle bodyHandleD, in TDescription description)
        where TDescription : unmanaged, IFourBodyConstraintDescription<TDescription> => Add([bodyHandleA, bodyHandleB, bodyHandleC, bodyHandleD], description);

    /// <summary>Adds a constraint between as many bodies as its type connects.</summary>
    /// <exception cref="ArgumentException">A body does not exist, occurs twice, all are kinematic, or a value cannot be simulated; nothing
    /// was changed.</exception>
    public ConstraintHandle Add<TDescription>(Span<BodyHandle> bodyHandles, in TDescription description)
        where TDescription : unmanaged, IConstraintDescription<TDescription>
    {
        using var change = world.Change("Solver.Add");
        if (bodyHandles.Length != TDescription.BodyCount)
            throw new ArgumentException($"{typeof(TDescription).Name} connects {TDescription.BodyCount} bodies, not {bodyHandles.Length}.",
                nameof(bodyHandles));
        CheckBodies(bodyHandles);
        EnsureRegistered<TDescription>();
        TDescription.Validate(description);
        for (int i = 0; i < bodyHandles.Length; ++i)
            awakener.Wake(bodyHandles[i]);
        var handle = AddUnwritten(bodyHandles, TDescription.ConstraintTypeId);
        NumberJoint(handle);
        WriteDescription(Locations[handle.Slot], description);
        return handle;
    }

    /// <summary>Removes a constraint and wakes its bodies.</summary>
    /// <exception cref="ArgumentException">There is no such constraint.</exception>
    public void Remove(ConstraintHandle handle)
    {
        using var change = world.Change("Solver.Remove");
        CheckHandle(handle);
        WakeBodiesOf(handle);
        RemoveConstraint(handle);
    }

    /// <summary>Removes a constraint that exists.</summary>
    internal void RemoveConstraint(ConstraintHandle handle)
    {
        if (Locations[handle.Slot].TypeId < ConstraintTypeIds.ContactTypeCount)
            contactRemoved(handle);
        RemoveWithoutNotice(handle);
    }

    /// <summary>Asks the processor to load what is needed to remove a constraint.</summary>
    internal void Prefetch(ConstraintHandle handle)
    {
        BepuUtilities.Memory.Prefetch.Read(Locations.Memory + handle.Slot);
        Edges.Prefetch(Edges.EdgeOf(handle.Slot, 0));
    }

    /// <summary>Removes a constraint that exists and tells nobody.</summary>
    internal void RemoveWithoutNotice(ConstraintHandle handle)
    {
        Check.That(!Defers);
        ForgetOptions(handle.Slot);
        RemoveFromBodies(handle);
        RemoveFromBatch(Locations[handle.Slot]);
        Locations[handle.Slot].SetIndex = -1;
        MoveJointsOfTurned();
        owners.Release(handle.Slot);
        HandlePool.Return(handle.Slot, pool);
    }

    /// <summary>Changes the description of a constraint and wakes its bodies; its accumulated impulses stay.</summary>
    /// <exception cref="ArgumentException">There is no such constraint, it has another type, or a value cannot be simulated.</exception>
    public void ApplyDescription<TDescription>(ConstraintHandle constraintHandle, in TDescription description)
        where TDescription : unmanaged, IConstraintDescription<TDescription>
    {
        world.CheckWritable("Solver.ApplyDescription");
        CheckType<TDescription>(constraintHandle);
        TDescription.Validate(description);
        if (IsAsleep(constraintHandle.Slot))
        {
            using var change = world.Change("Solver.ApplyDescription");
            WakeBodiesOf(constraintHandle);
        }
        // Several threads may change constraints of one body: they write the same.
        ForgetRest(constraintHandle);
        WriteDescription(Locations[constraintHandle.Slot], description);
    }

    void ForgetRest(ConstraintHandle handle)
    {
        ref var location = ref Locations[handle.Slot];
        for (int i = 0; i < Processor(location.TypeId).BodiesPerConstraint; ++i)
        {
            ref var body = ref bodies.Locations[BodySlotOf(location, i)];
            bodies.SetOf(body).Activity[body.Index].Forget();
        }
    }

    void WakeBodiesOf(ConstraintHandle handle)
    {
        Span<BodyHandle> handles = stackalloc BodyHandle[MaximumBodiesPerConstraint];
        var location = Locations[handle.Slot];
        var count = Processor(location.TypeId).BodiesPerConstraint;
        for (int i = 0; i < count; ++i)
            handles[i] = bodies.HandleAt(BodySlotOf(location, i));
        for (int i = 0; i < count; ++i)
            awakener.Wake(handles[i]);
    }

    /// <summary>Changes the description of a constraint without waking its bodies.</summary>
    /// <exception cref="ArgumentException">There is no such constraint, it has another type, or a value cannot be simulated.</exception>
    public void ApplyDescriptionWithoutWaking<TDescription>(ConstraintHandle constraintHandle, in TDescription description)
        where TDescription : unmanaged, IConstraintDescription<TDescription>
    {
        world.CheckWritable("Solver.ApplyDescription");
        CheckType<TDescription>(constraintHandle);
        TDescription.Validate(description);
        WriteDescription(Locations[constraintHandle.Slot], description);
    }

    /// <summary>Reads the description of a constraint.</summary>
    /// <exception cref="ArgumentException">There is no such constraint or it has another type.</exception>
    public void GetDescription<TDescription>(ConstraintHandle handle, out TDescription description)
        where TDescription : unmanaged, IConstraintDescription<TDescription>
    {
        CheckType<TDescription>(handle);
        ref var location = ref Locations[handle.Slot];
        ref var batch = ref TypeBatchAt(location);
        var processor = Processor(location.TypeId);
        Unsafe.SkipInit(out description);
        ref var floats = ref Unsafe.As<TDescription, float>(ref description);
        for (int i = 0; i < processor.PrestepFloats; ++i)
            Unsafe.Add(ref floats, i) = processor.PrestepFloat(ref batch, location.IndexInTypeBatch, i);
    }

    /// <summary>Visits the accumulated impulses of a constraint, row by row, N s or N m s, as the last substep left them.</summary>
    /// <exception cref="ArgumentException">There is no such constraint.</exception>
    public void EnumerateAccumulatedImpulses<TEnumerator>(ConstraintHandle constraintHandle, ref TEnumerator enumerator) where TEnumerator : IForEach<float>
    {
        using var reading = world.Read("Solver.EnumerateAccumulatedImpulses");
        CheckHandle(constraintHandle);
        ref var location = ref Locations[constraintHandle.Slot];
        ref var batch = ref TypeBatchAt(location);
        var processor = Processor(location.TypeId);
        for (int i = 0; i < processor.ImpulseFloats; ++i)
            enumerator.LoopBody(processor.Impulse(ref batch, location.IndexInTypeBatch, i));
    }

    /// <summary>Square of the Euclidean length of a constraint's accumulated impulses over its rows.</summary>
    public float GetAccumulatedImpulseMagnitudeSquared(ConstraintHandle constraintHandle)
    {
        var sum = new SumOfSquares();
        EnumerateAccumulatedImpulses(constraintHandle, ref sum);
        return sum.Sum;
    }

    /// <summary>Euclidean length of a constraint's accumulated impulses over its rows.</summary>
    public float GetAccumulatedImpulseMagnitude(ConstraintHandle constraintHandle) => MathF.Sqrt(GetAccumulatedImpulseMagnitudeSquared(constraintHandle));

    struct SumOfSquares : IForEach<float>
    {
        public float Sum;

        public void LoopBody(float i) => Sum += i * i;
    }

    /// <summary>Adds a constraint of a registered type; the caller writes its description.</summary>
    internal ConstraintHandle AddUnwritten(ReadOnlySpan<BodyHandle> bodyHandles, int typeId)
    {
        if (HandleOwners.NeedsSlot(HandlePool, MaximumCount, "constraints", out var slotCount))
            EnsureSlots(slotCount);
        Check.That(!Defers);
        Edges.EnsureBodiesPerConstraint(bodyHandles.Length, bodies.Sets, pool);
        var handle = new ConstraintHandle(owners.Claim(HandlePool.Take()));
        Locations[handle.Slot] = Allocate(handle, bodyHandles, typeId);
        for (int i = 0; i < bodyHandles.Length; ++i)
            Edges.Add(ref bodies.SetOf(bodyHandles[i], out var index).Constraints[index], Edges.EdgeOf(handle.Slot, i));
        if (Processor(typeId).CarriesPointLoad)
            bodies.ActiveSet.EnsureStiffness(pool);
        if (Processor(typeId).MakesHubs)
            CountJoint(handle, bodyHandles);
        if (closesGapsSlowly)
            MarkGap(Locations[handle.Slot]);
        return handle;
    }

    // Coloured stands for all kinds that are swept over.
    ConstraintLocation Allocate(ConstraintHandle handle, ReadOnlySpan<BodyHandle> bodyHandles, int typeId, BatchKind kind = BatchKind.Coloured)
    {
        Span<int> encoded = stackalloc int[MaximumBodiesPerConstraint];
        Span<int> dynamics = stackalloc int[MaximumBodiesPerConstraint];
        int dynamicCount = 0;
        var isShuffled = false;
        for (int i = 0; i < bodyHandles.Length; ++i)
        {
            var kinematic = Bodies.IsKinematic(bodies.SetOf(bodyHandles[i], out var bodyIndex).LocalInertias[bodyIndex]);
            encoded[i] = kinematic ? bodyIndex | EncodedBody.KinematicFlag : bodyIndex;
            if (kinematic)
                continue;
            dynamics[dynamicCount++] = bodyHandles[i].Slot;
            isShuffled |= typeId >= ConstraintTypeIds.ContactTypeCount && IsShuffled(bodyIndex);
        }
        var batchIndex = kind == BatchKind.Coloured
            ? FindBatch(dynamics[..dynamicCount], isShuffled ? BatchKind.Shuffled : BatchKind.Coloured)
            : FindOrCreateBatch(ref ActiveSet, kind);
        ref var batch = ref ActiveSet.Batches[batchIndex];
        if (batch.IsOfColour)
        {
            for (int i = 0; i < dynamicCount; ++i)
                batch.DynamicBodies.Add(dynamics[i], pool);
        }
        ref var typeBatch = ref batch.FindOrCreate(typeId, pool);
        var index = Processor(typeId).Allocate(ref typeBatch, handle, encoded[..bodyHandles.Length], MinimumCapacityPerTypeBatch, pool);
        NoteJointChange(typeId);
        return new() { SetIndex = 0, BatchIndex = batchIndex, TypeId = typeId, IndexInTypeBatch = index };
    }

    int FindBatch(Span<int> dynamics, BatchKind kind)
    {
        ref var batches = ref ActiveSet.Batches;
        var colours = 0;
        for (int i = 0; i < batches.Count; ++i)
        {
            if (batches[i].Kind != kind)
                continue;
            if (batches[i].DynamicBodies.CanFit(dynamics))
                return i;
            ++colours;
        }
        return colours < FallbackBatchThreshold ? AddBatch(ref ActiveSet, kind) : FindOrCreateBatch(ref ActiveSet, BatchKind.Fallback);
    }

    int FindOrCreateBatch(ref ConstraintSet set, BatchKind kind) => FindBatch(set, kind) is >= 0 and var index ? index : AddBatch(ref set, kind);

    /// <summary>Index of the batch of a kind of which there is one; -1 where there is none yet.</summary>
    internal static int FindBatch(in ConstraintSet set, BatchKind kind)
    {
        ref readonly var batches = ref set.Batches;
        for (int i = batches.Count - 1; i >= 0; --i)
        {
            if (batches[i].Kind == kind)
                return i;
        }
        return -1;
    }

    int AddBatch(ref ConstraintSet set, BatchKind kind)
    {
        ref var batches = ref set.Batches;
        var batch = new ConstraintBatch { Kind = kind, TypeBatches = new QuickList<TypeBatch>(4, pool) };
        if (batch.IsOfColour)
            batch.DynamicBodies = new IndexSet(pool, Math.Max(64, bodies.ActiveSet.Count));
        batches.Add(batch, pool);
        return batches.Count - 1;
    }

    /// <summary>Takes a constraint out of its batch; type batches, and batches at the end, that have none left go too.</summary>
    void RemoveFromBatch(in ConstraintLocation location)
    {
        ref var batches = ref Sets[location.SetIndex].Batches;
        ref var batch = ref batches[location.BatchIndex];
        ref var typeBatch = ref TypeBatchAt(location);
        var processor = Processor(location.TypeId);
        if (batch.IsOfColour)
        {
            for (int slot = 0; slot < processor.BodiesPerConstraint; ++slot)
            {
                var reference = processor.BodyReference(ref typeBatch, location.IndexInTypeBatch, slot);
                if ((reference & EncodedBody.KinematicFlag) == 0)
                    batch.DynamicBodies.Remove(bodies.Sets[location.SetIndex].IndexToHandle[reference & EncodedBody.IndexMask].Slot);
            }
        }
        NoteJointChange(location.TypeId);
        var index = location.IndexInTypeBatch;
        var moved = processor.Remove(ref typeBatch, index);
        if (moved.Value >= 0)
            Locations[moved.Slot].IndexInTypeBatch = index;
        if (typeBatch.ConstraintCount == 0)
            GiveUp(ref batches, ref batch, processor);
    }

    // A type batch that is empty.
    void GiveUp(ref QuickList<ConstraintBatch> batches, ref ConstraintBatch batch, TypeProcessor processor)
    {
        batch.RemoveTypeBatch(processor, pool);
        // The batches before keep their indices, which tell colours.
        while (batches.Count > 0 && batches[batches.Count - 1].TypeBatches.Count == 0)
        {
            DisposeBatch(ref batches[batches.Count - 1]);
            batches.Count -= 1;
        }
    }

    void WriteDescription<TDescription>(in ConstraintLocation location, in TDescription description) where TDescription : unmanaged
    {
        ref var batch = ref TypeBatchAt(location);
        var processor = Processor(location.TypeId);
        ref var floats = ref Unsafe.As<TDescription, float>(ref Unsafe.AsRef(in description));
        for (int i = 0; i < processor.PrestepFloats; ++i)
            processor.PrestepFloat(ref batch, location.IndexInTypeBatch, i) = Unsafe.Add(ref floats, i);
    }

    void CheckType<TDescription>(ConstraintHandle handle) where TDescription : unmanaged, IConstraintDescription<TDescription>
    {
        CheckHandle(handle);
        if (Locations[handle.Slot].TypeId != TDescription.ConstraintTypeId || !IsRegistered(TDescription.ConstraintTypeId, typeof(TDescription)))
            throw new ArgumentException($"{handle} is no {typeof(TDescription).Name}.", nameof(handle));
    }

    void CheckBodies(ReadOnlySpan<BodyHandle> handles)
    {
        bool anyDynamic = false;
        for (int i = 0; i < handles.Length; ++i)
        {
            bodies.CheckHandle(handles[i]);
            anyDynamic |= !Bodies.IsKinematic(bodies.SetOf(handles[i], out var index).LocalInertias[index]);
            for (int j = 0; j < i; ++j)
            {
                if (handles[i] == handles[j])
                    throw new ArgumentException($"A constraint cannot connect {handles[i]} to itself.", nameof(handles));
            }
        }
        if (!anyDynamic)
            throw new ArgumentException("A constraint needs at least one dynamic body; nothing moves a kinematic one.", nameof(handles));
    }
}
