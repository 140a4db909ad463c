using System.Diagnostics;
using System.Runtime.CompilerServices;
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
    /// <summary>Id of the constraint's type, which tells the type batch within the batch.</summary>
    public int TypeId;
    /// <summary>Index within the type batch.</summary>
    public int IndexInTypeBatch;
}

/// <summary>How the constraints of a batch are solved.</summary>
public enum BatchKind
{
    /// <summary>In the sweeps, all at the same time: no dynamic body occurs in two of them.</summary>
    Coloured,
    /// <summary>In the sweeps, on split bodies: a body may occur any number of times.</summary>
    Fallback,
    /// <summary>Not in the sweeps, but by a stage that was asked to: a body may occur any number of times.</summary>
    Direct,
    /// <summary>Not at all, until they are enabled again: a body may occur any number of times.</summary>
    Disabled,
    /// <summary>As coloured ones, but in a random order, before all others: joints of bodies with so many that a fixed order is not stable.</summary>
    Shuffled,
}

/// <summary>Constraints that can be solved at the same time: no dynamic body occurs in two of them, unless the batch is of another kind.</summary>
public struct ConstraintBatch
{
    /// <summary>How the constraints are solved.</summary>
    public BatchKind Kind;
    /// <summary>The constraints, by type; none of them is empty. In no particular order.</summary>
    public QuickList<TypeBatch> TypeBatches;
    // One more than the place of each type in the list; 0 where the batch has none of it.
    TypePlaces places;
    /// <summary>Slots of the dynamic bodies that occur in the batch; kept where none may occur twice.</summary>
    public IndexSet DynamicBodies;

    /// <summary>Whether no dynamic body may occur twice.</summary>
    internal readonly bool IsOfColour => Kind is BatchKind.Coloured or BatchKind.Shuffled;

    /// <summary>Whether the sweeps go over it.</summary>
    internal readonly bool IsSwept => Kind is BatchKind.Coloured or BatchKind.Shuffled or BatchKind.Fallback;

    /// <summary>Number of constraints of all types.</summary>
    public readonly int CountConstraints()
    {
        int count = 0;
        for (int i = 0; i < TypeBatches.Count; ++i)
            count += TypeBatches[i].ConstraintCount;
        return count;
    }

    /// <summary>Index of the type batch of a type; -1 if there is none.</summary>
    internal readonly int Find(int typeId) => places[typeId] - 1;

    /// <summary>The type batch of a type, created if there is none.</summary>
    internal ref TypeBatch FindOrCreate(int typeId, BufferPool pool)
    {
        if (places[typeId] == 0)
        {
            TypeBatches.Add(new TypeBatch { TypeId = typeId }, pool);
            places[typeId] = (byte)TypeBatches.Count;
        }
        return ref TypeBatches[Find(typeId)];
    }

    /// <summary>Gives up a type batch; the last one takes its place.</summary>
    internal void RemoveTypeBatch(TypeProcessor processor, BufferPool pool)
    {
        var index = Find(processor.TypeId);
        var last = TypeBatches.Count - 1;
        places[TypeBatches[last].TypeId] = (byte)(index + 1);
        places[processor.TypeId] = 0;
        processor.Dispose(ref TypeBatches[index], pool);
        TypeBatches[index] = TypeBatches[last];
        TypeBatches.Count = last;
    }
}

/// <summary>A small number per constraint type.</summary>
[InlineArray(TypeProcessor.MaximumTypeCount)]
struct TypePlaces
{
    byte first;
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
    readonly Solver solver;
    readonly ConstraintHandle handle;
    internal readonly TypeBatch* TypeBatchPointer;
    /// <summary>Index of the constraint in its type batch.</summary>
    public readonly int IndexInTypeBatch;

    internal ConstraintReference(Solver solver, ConstraintHandle handle, TypeBatch* typeBatch, int indexInTypeBatch)
    {
        this.solver = solver;
        this.handle = handle;
        TypeBatchPointer = typeBatch;
        IndexInTypeBatch = indexInTypeBatch;
    }

    /// <summary>
    /// Whether the constraint is solved. Written, it is <see cref="Solver.SetEnabled"/>, after which the constraint is in another type batch: get
    /// another reference.
    /// </summary>
    /// <exception cref="System.ArgumentException">The constraint does not exist any more, or is a contact.</exception>
    public bool Enabled
    {
        get => solver.IsEnabled(handle);
        set => solver.SetEnabled(handle, value);
    }

    /// <summary>The type batch that holds the constraint; valid until constraints are added or removed.</summary>
    public ref TypeBatch TypeBatch => ref *TypeBatchPointer;
}
