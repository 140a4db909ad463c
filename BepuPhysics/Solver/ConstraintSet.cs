using System.Diagnostics;
using BepuPhysics.Constraints;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics;

/// <summary>Where a constraint is stored.</summary>
public struct ConstraintLocation
{
    /// <summary>Set of the constraint; 0 is the active one, -1 says that there is no such constraint.</summary>
    public int SetIndex;
    /// <summary>Batch within the set.</summary>
    public int BatchIndex;
    /// <summary>Type batch within the batch.</summary>
    public int TypeBatchIndex;
    /// <summary>Index within the type batch.</summary>
    public int IndexInTypeBatch;
    /// <summary>Id of the constraint's type.</summary>
    public int TypeId;
}

/// <summary>Constraints that can be solved at the same time: no dynamic body occurs in two of them (except in the fallback batch).</summary>
public struct ConstraintBatch
{
    /// <summary>The constraints, by type.</summary>
    public QuickList<TypeBatch> TypeBatches;
    /// <summary>Slots of the dynamic bodies that occur in the batch; not kept for the fallback batch.</summary>
    public IndexSet DynamicBodies;

    /// <summary>Number of constraints of all types.</summary>
    public readonly int CountConstraints()
    {
        int count = 0;
        for (int i = 0; i < TypeBatches.Count; ++i)
            count += TypeBatches[i].ConstraintCount;
        return count;
    }

    /// <summary>Index of the type batch of a type; -1 if there is none.</summary>
    internal readonly int Find(int typeId)
    {
        for (int i = 0; i < TypeBatches.Count; ++i)
        {
            if (TypeBatches[i].TypeId == typeId)
                return i;
        }
        return -1;
    }

    /// <summary>Index of the type batch of a type, created if there is none.</summary>
    internal int FindOrCreate(int typeId, BufferPool pool)
    {
        var index = Find(typeId);
        if (index >= 0)
            return index;
        TypeBatches.Add(new TypeBatch { TypeId = typeId }, pool);
        return TypeBatches.Count - 1;
    }
}

/// <summary>A set of constraints that are active or asleep together.</summary>
public struct ConstraintSet
{
    /// <summary>Batches in the order in which they are solved.</summary>
    public QuickList<ConstraintBatch> Batches;

    /// <summary>Number of constraints in all batches.</summary>
    public readonly int CountConstraints()
    {
        int count = 0;
        for (int i = 0; i < Batches.Count; ++i)
            count += Batches[i].CountConstraints();
        return count;
    }
}

/// <summary>Where a constraint is, for looking at it from outside.</summary>
[DebuggerDisplay("{IndexInTypeBatch}")]
public unsafe readonly struct ConstraintReference
{
    internal readonly TypeBatch* TypeBatchPointer;
    /// <summary>Index of the constraint in its type batch.</summary>
    public readonly int IndexInTypeBatch;

    internal ConstraintReference(TypeBatch* typeBatch, int indexInTypeBatch)
    {
        TypeBatchPointer = typeBatch;
        IndexInTypeBatch = indexInTypeBatch;
    }

    /// <summary>The type batch that holds the constraint; valid until constraints are added or removed.</summary>
    public ref TypeBatch TypeBatch => ref *TypeBatchPointer;
}
