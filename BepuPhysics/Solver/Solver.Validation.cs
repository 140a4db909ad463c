using System;
using System.Numerics;
using BepuPhysics.Constraints;
using BepuUtilities.Collections;

namespace BepuPhysics;

public sealed partial class Solver
{
    /// <summary>Handles and places, bodies of constraints both ways, batches without common bodies, flags, lanes, impulses.</summary>
    internal void Validate()
    {
        int referenceCount = 0;
        for (int setIndex = 0; setIndex < Sets.Length; ++setIndex)
        {
            ref var batches = ref Sets[setIndex].Batches;
            ValidateKinds(batches);
            for (int batchIndex = 0; batchIndex < batches.Count; ++batchIndex)
                ValidateBatch(setIndex, batchIndex, ref referenceCount);
        }
        int listedCount = 0;
        int asleepOfKinematics = 0;
        for (int setIndex = 0; setIndex < bodies.Sets.Length; ++setIndex)
        {
            ref var set = ref bodies.Sets[setIndex];
            for (int i = 0; i < set.Count; ++i)
            {
                ValidateList(set, i, out var asleepCount);
                asleepOfKinematics += asleepCount;
                listedCount += set.Constraints[i].Count;
            }
        }
        Invariant.Require(asleepOfKinematics == AsleepOfKinematics, "number of sleeping constraints of kinematics", asleepOfKinematics);
        // No edge is in a list twice or in two lists, so none is missing either.
        Invariant.Require(listedCount == referenceCount, "number of constraints in the lists of bodies", listedCount, referenceCount);
        ValidateHubs();
        ValidateOptions();
        ValidateNeeds();
        Invariant.Ids(HandlePool, Locations.Length, "constraints", id => Locations[id].SetIndex >= 0);
        for (int slot = 0; slot < owners.Capacity; ++slot)
            Invariant.Require(owners.IsTaken(slot) == (slot < Locations.Length && Locations[slot].SetIndex >= 0), "owner of slot", slot);
    }

    void ValidateBatch(int setIndex, int batchIndex, ref int referenceCount)
    {
        ref var batch = ref Sets[setIndex].Batches[batchIndex];
        // Slots of dynamic bodies that were found; managed memory, so that a failure leaves no pool with a debt.
        var found = new bool[bodies.HandlePool.HighestPossiblyClaimedId + 1];
        for (int typeBatchIndex = 0; typeBatchIndex < batch.TypeBatches.Count; ++typeBatchIndex)
        {
            ref var typeBatch = ref batch.TypeBatches[typeBatchIndex];
            Invariant.Require((uint)typeBatch.TypeId < MaximumTypeCount && processors[typeBatch.TypeId] is not null, "type of type batch",
                batchIndex, typeBatchIndex);
            Invariant.Require(batch.Find(typeBatch.TypeId) == typeBatchIndex, "place of the type batch of a type", batchIndex, typeBatch.TypeId);
            Invariant.Require(typeBatch.ConstraintCount > 0, "type batch without constraints", batchIndex, typeBatch.TypeId);
            ValidateCapacity(ref typeBatch, batchIndex);
            var location = new ConstraintLocation { SetIndex = setIndex, BatchIndex = batchIndex, TypeId = typeBatch.TypeId };
            for (int index = 0; index < typeBatch.ConstraintCount; ++index)
            {
                location.IndexInTypeBatch = index;
                ValidateConstraint(ref typeBatch, location, found);
            }
            referenceCount += typeBatch.ConstraintCount * Processor(typeBatch.TypeId).BodiesPerConstraint;
            ValidateUnusedLanes(ref typeBatch, batchIndex);
        }
        if (!batch.IsOfColour)
            return;
        for (int handle = 0; handle < found.Length; ++handle)
            Invariant.Require(batch.DynamicBodies.Contains(handle) == found[handle], "bodies of batch", batchIndex, handle);
        for (int handle = found.Length; handle < batch.DynamicBodies.Capacity; ++handle)
            Invariant.Require(!batch.DynamicBodies.Contains(handle), "bodies of batch", batchIndex, handle);
    }

    // As many coloured batches as there may be, and one of each other kind.
    void ValidateKinds(in QuickList<ConstraintBatch> batches)
    {
        Span<int> counts = stackalloc int[5];
        counts.Clear();
        for (int i = 0; i < batches.Count; ++i)
            ++counts[(int)batches[i].Kind];
        Invariant.Require(counts[(int)BatchKind.Coloured] <= FallbackBatchThreshold && counts[(int)BatchKind.Shuffled] <= FallbackBatchThreshold,
            "number of batches", batches.Count);
        Invariant.Require(counts[(int)BatchKind.Fallback] <= 1 && counts[(int)BatchKind.Direct] <= 1 &&
            counts[(int)BatchKind.Disabled] <= 1, "number of batches of a kind", batches.Count);
    }

    void ValidateCapacity(ref TypeBatch typeBatch, int batchIndex)
    {
        var processor = Processor(typeBatch.TypeId);
        var used = typeBatch.BundleCount * Vector<float>.Count;
        Invariant.Require(
            typeBatch.IndexToHandle.Length >= used && typeBatch.BodyReferences.Length >= used * processor.BodiesPerConstraint &&
            typeBatch.Prestep.Length >= used * processor.PrestepFloats && typeBatch.AccumulatedImpulses.Length >= used * processor.ImpulseFloats,
            "capacity of a type batch", batchIndex, typeBatch.TypeId);
    }

    void ValidateConstraint(ref TypeBatch typeBatch, in ConstraintLocation location, bool[] found)
    {
        var handle = typeBatch.IndexToHandle[location.IndexInTypeBatch];
        Invariant.Require(ConstraintExists(handle), "handle of a constraint of type", location.TypeId, location.IndexInTypeBatch);
        ref var known = ref Locations[handle.Slot];
        Invariant.Require(
            known.SetIndex == location.SetIndex && known.BatchIndex == location.BatchIndex &&
            known.IndexInTypeBatch == location.IndexInTypeBatch && known.TypeId == location.TypeId, "location of constraint", handle.Slot);
        var processor = Processor(location.TypeId);
        bool anyDynamic = false;
        for (int slot = 0; slot < processor.BodiesPerConstraint; ++slot)
        {
            var reference = processor.BodyReference(ref typeBatch, location.IndexInTypeBatch, slot);
            var bodyIndex = reference & EncodedBody.IndexMask;
            var isAsleep = location.SetIndex == AsleepSet;
            Invariant.Require(reference >= 0 && (isAsleep ? bodies.TryGetHandle(bodyIndex, out _) : bodyIndex < bodies.ActiveSet.Count),
                "body of constraint", handle.Slot, slot);
            var kinematic = (reference & EncodedBody.KinematicFlag) != 0;
            var body = BodySlotOf(location, slot);
            ref var set = ref bodies.SetOf(bodies.HandleAt(body), out var row);
            Invariant.Require(kinematic == Bodies.IsKinematic(set.LocalInertias[row]), "kinematic flag of constraint", handle.Slot, slot);
            // Only a kinematic body may be awake while constraints of it sleep, and none sleeps while one of them is awake.
            Invariant.Require(kinematic ? isAsleep || !set.IsAsleep : isAsleep == set.IsAsleep, "sleep of a body of constraint", handle.Slot, slot);
            for (int other = 0; other < slot; ++other)
            {
                var otherReference = processor.BodyReference(ref typeBatch, location.IndexInTypeBatch, other);
                Invariant.Require((otherReference & EncodedBody.IndexMask) != bodyIndex, "second mention of a body by constraint", handle.Slot, slot);
            }
            if (kinematic)
                continue;
            anyDynamic = true;
            ref var isFound = ref found[body];
            Invariant.Require(!isFound || !BatchOf(location).IsOfColour,
                "second constraint in its batch of the body of constraint", handle.Slot, slot);
            isFound = true;
        }
        Invariant.Require(anyDynamic, "constraint without dynamic bodies", handle.Slot);
        for (int i = 0; i < processor.ImpulseFloats; ++i)
            Invariant.Require(float.IsFinite(processor.Impulse(ref typeBatch, location.IndexInTypeBatch, i)), "impulse of constraint", handle.Slot, i);
    }

    // The list is a ring, both ways, of as many edges as it says, each of a constraint that has the body in the place that the edge says.
    void ValidateList(in BodySet set, int index, out int asleepCount)
    {
        var list = set.Constraints[index];
        var bodyIndex = set.IndexToHandle[index].Slot;
        var edge = list.First;
        int asleep = 0;
        for (int i = 0; i < list.Count; ++i)
        {
            Invariant.Require(i == 0 || edge != list.First, "length of the list of constraints of body", bodyIndex, list.Count);
            Invariant.Require(Edges.Contains(edge) && Edges.Contains(Edges.Next(edge)) && Edges.Previous(Edges.Next(edge)) == edge,
                "list of constraints of body", bodyIndex, i);
            var slot = Edges.ConstraintSlot(edge);
            Invariant.Require(slot < Locations.Length && Locations[slot].SetIndex >= 0, "listed constraint of body", bodyIndex, i);
            ref var location = ref Locations[slot];
            var processor = Processor(location.TypeId);
            var bodySlot = Edges.BodySlot(edge);
            Invariant.Require(bodySlot < processor.BodiesPerConstraint && bodyIndex == BodySlotOf(location, bodySlot),
                "body of a listed constraint of body", bodyIndex, i);
            asleep += location.SetIndex == AsleepSet ? 1 : 0;
            edge = Edges.Next(edge);
        }
        Invariant.Require(list.Count == 0 || edge == list.First, "end of the list of constraints of body", bodyIndex);
        asleepCount = Bodies.IsKinematic(set.LocalInertias[index]) ? asleep : 0;
        Invariant.Require(list.AsleepCount == asleepCount, "number of sleeping constraints of body", bodyIndex, list.AsleepCount);
    }

    void ValidateHubs()
    {
        for (int i = 0; bodies.ActiveSet.JointCounts.Allocated && i < bodies.ActiveSet.Count; ++i)
        {
            int joints = 0;
            foreach (var constraint in new BodyConstraints(this, bodies.ActiveSet.Constraints[i]))
            {
                ref var location = ref Locations[constraint.ConnectingConstraintHandle.Slot];
                var reference = Processor(location.TypeId).BodyReference(
                    ref TypeBatchAt(location), location.IndexInTypeBatch, constraint.BodyIndexInConstraint);
                var makesHubs = Processor(location.TypeId).MakesHubs && KindOf(location) != BatchKind.Disabled;
                joints += makesHubs ? 1 : 0;
                var isHub = makesHubs && Degree(i) >= JointsOfHub;
                Invariant.Require((reference & EncodedBody.HubFlag) != 0 == isHub, "flag of a hub of body", i, location.TypeId);
                if (location.SetIndex == 0 && BatchOf(location).IsOfColour)
                    Invariant.Require(KindOf(location) == BatchKind.Shuffled == (location.TypeId >= ConstraintTypeIds.ContactTypeCount &&
                        HasShuffledBody(location)), "kind of the batch of a constraint of body", i, location.TypeId);
            }
            Invariant.Require(bodies.ActiveSet.JointCounts[i] == joints, "number of joints of body", i, joints);
        }
        Invariant.Require(turned.Count == 0, "number of bodies whose joints are to be moved", turned.Count);
    }

    // Unused lanes are gathered from and scattered to: only an empty reference keeps them from touching a body.
    void ValidateUnusedLanes(ref TypeBatch typeBatch, int batchIndex)
    {
        var processor = Processor(typeBatch.TypeId);
        for (int index = typeBatch.ConstraintCount; index < typeBatch.BundleCount * Vector<float>.Count; ++index)
        {
            for (int slot = 0; slot < processor.BodiesPerConstraint; ++slot)
                Invariant.Require(processor.BodyReference(ref typeBatch, index, slot) == EncodedBody.Empty, "unused lane of a type batch",
                    batchIndex, typeBatch.TypeId);
        }
    }
}
