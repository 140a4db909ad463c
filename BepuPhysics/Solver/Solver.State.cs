using System;
using System.Numerics;
using BepuPhysics.Constraints;
using BepuUtilities.Collections;

namespace BepuPhysics;

// Saving and restoring, and another origin of the world.
public sealed unsafe partial class Solver
{
    /// <summary>Slots of constraints that were ever in use.</summary>
    internal int UsedSlotCount => HandlePool.HighestPossiblyClaimedId + 1;

    internal void CopyState(StateCopy copy)
    {
        CopySettings(copy);
        CopyStepLengths(copy);
        owners.CopyState(copy);
        copy.Ids(ref HandlePool);
        copy.Rows(ref Locations, UsedSlotCount, new ConstraintLocation { SetIndex = -1 });
        Edges.CopyState(copy, UsedSlotCount);
        if (copy.Restores)
            EnsureSlots(Locations.Length);
        CopyOptions(copy);
        CopyNeeds(copy);
        for (int i = 0; i < Sets.Length; ++i)
            CopySet(ref Sets[i], copy);
        AsleepOfKinematics = copy.Value(AsleepOfKinematics);
        copy.Value(ref stepNumber);
        copy.Value(ref jointsToShuffle);
        copy.Value(ref chosenMode);
        if (!copy.Restores)
            return;
        // Which joints are solved at once is found again from where they are, and so is what they connect.
        directStage.Replace(default);
        ++jointVersion;
    }

    /// <summary>Moves the places of the world that descriptions of constraints hold to where they are seen from a new origin.</summary>
    internal void ShiftOrigin(Vector3 shift)
    {
        foreach (ref var set in Sets.AsSpan())
        {
            foreach (ref var batch in set.Batches.AsSpan())
            {
                foreach (ref var typeBatch in batch.TypeBatches.AsSpan())
                    Processor(typeBatch.TypeId).ShiftOrigin(ref typeBatch, shift);
            }
        }
    }

    void CopySettings(StateCopy copy)
    {
        copy.Value(ref velocityIterationCount);
        copy.Value(ref substepCount);
        copy.Value(ref relaxationIterationCount);
        copy.Value(ref loadPath);
        copy.Value(ref directJoints);
        copy.Value(ref stopsImpacts);
        copy.Value(ref closesGapsSlowly);
        copy.Value(ref contactFrequency);
        copy.Value(ref hasFixedSubstepCount);
        var isGoverned = copy.Value(governor.HasValue);
        var settings = copy.Value(governor.GetValueOrDefault());
        governor = isGoverned ? settings : null;
    }

    void CopyStepLengths(StateCopy copy)
    {
        copy.Value(ref previousSubstepDt);
        copy.Value(ref usualDt);
        copy.Value(ref usualSubstepDt);
        copy.Value(ref stepsSeen);
        copy.Value(ref governedCount);
        copy.Value(ref recentError);
        LastSubstepCount = copy.Value(LastSubstepCount);
        LastConstraintError = copy.Value(LastConstraintError);
    }

    void CopyOptions(StateCopy copy)
    {
        copy.Rows(ref apart.Flags, apart.Flags.Length, absent: 0ul);
        copy.Value(ref apartCount);
        copy.List(ref breakable);
        copy.Rows(ref breakablePlaces, breakablePlaces.Length, absent: 0);
        if (!copy.Restores)
            return;
        // What broke in the last step is told of that step alone.
        broken.Count = 0;
        if (breakable.Count > 0)
            MakeRoomForBroken();
    }

    void CopySet(ref ConstraintSet set, StateCopy copy)
    {
        var count = copy.Value(set.Batches.Count);
        if (copy.Restores)
        {
            for (int i = 0; i < set.Batches.Count; ++i)
                DisposeBatch(ref set.Batches[i]);
            set.Batches.Count = 0;
            if (!set.Batches.Span.Allocated && count > 0)
                set.Batches = new QuickList<ConstraintBatch>(count, pool);
            for (int i = 0; i < count; ++i)
                set.Batches.Add(default, pool);
        }
        for (int i = 0; i < count; ++i)
            CopyBatch(ref set.Batches[i], copy);
    }

    void CopyBatch(ref ConstraintBatch batch, StateCopy copy)
    {
        copy.Value(ref batch.Kind);
        copy.Rows(ref batch.DynamicBodies.Flags, batch.DynamicBodies.Flags.Length, absent: 0ul);
        var count = copy.Value(batch.TypeBatches.Count);
        if (copy.Restores)
            batch.TypeBatches = new QuickList<TypeBatch>(Math.Max(1, count), pool);
        for (int i = 0; i < count; ++i)
        {
            var typeId = copy.Value(copy.Restores ? 0 : batch.TypeBatches[i].TypeId);
            Processor(typeId).CopyState(ref batch.FindOrCreate(typeId, pool), minimumCapacityPerTypeBatch, copy);
        }
    }

    /// <summary>Lists the types of all constraints, with what they consist of.</summary>
    internal void CountTypes(ref QuickList<ConstraintLayout> types)
    {
        for (int typeId = 0; typeId < MaximumTypeCount; ++typeId)
        {
            for (int i = 0; i < Sets.Length; ++i)
            {
                if (HasConstraints(Sets[i], typeId))
                {
                    types.Add(LayoutOf(typeId), pool);
                    break;
                }
            }
        }
    }

    static bool HasConstraints(in ConstraintSet set, int typeId)
    {
        for (int i = 0; i < set.Batches.Count; ++i)
        {
            if (set.Batches[i].Find(typeId) >= 0)
                return true;
        }
        return false;
    }

    ConstraintLayout LayoutOf(int typeId) => processors[typeId] is { } processor
        ? new(typeId, processor.BodiesPerConstraint, processor.PrestepFloats, processor.ImpulseFloats)
        : new(typeId, 0, 0, 0);

    /// <summary>Refuses constraints of types that are not registered, or that consist of something else.</summary>
    internal void CheckTypes(in QuickList<ConstraintLayout> types)
    {
        foreach (ref var type in types.AsSpan())
        {
            if ((uint)type.TypeId >= MaximumTypeCount || LayoutOf(type.TypeId) != type)
            {
                throw new InvalidOperationException(
                    $"The snapshot has constraints of type {type.TypeId}, which is not registered with the solver, or as another one. Nothing was changed.");
            }
        }
    }
}

/// <summary>What a constraint of a type consists of.</summary>
readonly record struct ConstraintLayout(int TypeId, int BodyCount, int PrestepFloats, int ImpulseFloats);
