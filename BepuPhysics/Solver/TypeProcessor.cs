using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;
using BepuUtilities.Diagnostics;
using BepuUtilities.Memory;

namespace BepuPhysics.Constraints;

/// <summary>Stores and solves the constraints of one type.</summary>
/// <remarks>
/// One call per type batch and stage goes through this class; everything inside a call is specialised for the type. Storing and moving
/// constraints needs no specialisation: a constraint is a column of numbers.
/// </remarks>
public abstract partial class TypeProcessor
{
    /// <summary>Ids of types are below this.</summary>
    internal const int MaximumTypeCount = 128;

    /// <summary>Id of the type; set when the type is registered with a solver, -1 before.</summary>
    public int TypeId { get; internal set; } = -1;
    /// <summary>Number of bodies that a constraint of this type connects.</summary>
    public int BodiesPerConstraint { get; }
    /// <summary>Number of floats of a description.</summary>
    public int PrestepFloats { get; }
    /// <summary>Number of floats of the accumulated impulses.</summary>
    public int ImpulseFloats { get; }

    private protected TypeProcessor(int bodiesPerConstraint, int prestepFloats, int impulseFloats)
    {
        BodiesPerConstraint = bodiesPerConstraint;
        PrestepFloats = prestepFloats;
        ImpulseFloats = impulseFloats;
    }

    internal bool IsRegistered => TypeId >= 0;

    /// <summary>Whether constraints of this type stiffen the rotation of their bodies by their load.</summary>
    internal abstract bool CarriesPointLoad { get; }
    /// <summary>Whether several constraints of this type on one body make it a hub.</summary>
    internal abstract bool MakesHubs { get; }
    /// <summary>Whether constraints of this type close slowly a gap that they are added with.</summary>
    internal abstract bool ClosesGaps { get; }
    /// <summary>Applies the accumulated impulses of some bundles.</summary>
    internal abstract void WarmStart(ref TypeBatch batch, in SolverBodies bodies, in Substep substep, int startBundle, int endBundle);
    /// <summary>Solves some bundles once.</summary>
    internal abstract void Solve(ref TypeBatch batch, in SolverBodies bodies, in Substep substep, int startBundle, int endBundle);
    /// <summary>As <see cref="WarmStart"/>, for a batch in which bodies occur more than once: on split bodies.</summary>
    internal abstract void WarmStartSplit(ref TypeBatch batch, in SolverBodies bodies, in SplitBodies split, in Substep substep, int startBundle,
        int endBundle);
    /// <summary>As <see cref="Solve"/>, for a batch in which bodies occur more than once: on split bodies.</summary>
    internal abstract void SolveSplit(ref TypeBatch batch, in SolverBodies bodies, in SplitBodies split, in Substep substep, int startBundle, int endBundle);

    /// <summary>Moves the places of the world that descriptions hold to where they are seen from a new origin.</summary>
    internal abstract void ShiftOrigin(ref TypeBatch batch, Vector3 shift);

    /// <summary>Appends a constraint with zero impulses and an unwritten description.</summary>
    /// <param name="batch">The batch.</param>
    /// <param name="handle">Its handle.</param>
    /// <param name="encodedBodies">References to its bodies.</param>
    /// <param name="minimumCapacity">Constraints that a new batch has room for.</param>
    /// <param name="pool">Source of memory.</param>
    /// <returns>Its index in the batch.</returns>
    internal int Allocate(ref TypeBatch batch, ConstraintHandle handle, ReadOnlySpan<int> encodedBodies, int minimumCapacity, BufferPool pool)
    {
        Check.That(encodedBodies.Length == BodiesPerConstraint);
        MakeRoomForOne(ref batch, minimumCapacity, pool);
        var index = batch.ConstraintCount++;
        batch.IndexToHandle[index] = handle;
        if (index % Vector<float>.Count == 0)
            ClearBundle(ref batch, index / Vector<float>.Count);
        for (int slot = 0; slot < encodedBodies.Length; ++slot)
            BodyReference(ref batch, index, slot) = encodedBodies[slot];
        ClearColumn(ref batch.AccumulatedImpulses, ImpulseFloats, index);
        return index;
    }

    /// <summary>Makes room for one more constraint.</summary>
    internal void MakeRoomForOne(ref TypeBatch batch, int minimumCapacity, BufferPool pool)
    {
        if (batch.ConstraintCount == batch.IndexToHandle.Length)
            Resize(ref batch, Math.Max(Math.Max(1, minimumCapacity), batch.ConstraintCount * 2), pool);
    }

    /// <summary>Removes a constraint by moving the last one into its place.</summary>
    /// <param name="batch">The batch.</param>
    /// <param name="index">The constraint's index.</param>
    /// <returns>Handle of the constraint that was moved; its value is -1 where none was.</returns>
    internal ConstraintHandle Remove(ref TypeBatch batch, int index)
    {
        var last = --batch.ConstraintCount;
        var moved = new ConstraintHandle(-1);
        if (index != last)
        {
            moved = batch.IndexToHandle[last];
            Move(ref batch, last, index);
        }
        for (int slot = 0; slot < BodiesPerConstraint; ++slot)
            BodyReference(ref batch, last, slot) = EncodedBody.Empty;
        return moved;
    }

    /// <summary>Encoded reference of a constraint to one of its bodies.</summary>
    internal ref int BodyReference(ref TypeBatch batch, int index, int slot) =>
        ref batch.BodyReferences[ColumnStart(BodiesPerConstraint, index) + slot * Vector<float>.Count];

    /// <summary>A number of a constraint's description.</summary>
    internal ref float PrestepFloat(ref TypeBatch batch, int index, int field) =>
        ref batch.Prestep[ColumnStart(PrestepFloats, index) + field * Vector<float>.Count];

    /// <summary>An accumulated impulse of a constraint.</summary>
    internal ref float Impulse(ref TypeBatch batch, int index, int row) =>
        ref batch.AccumulatedImpulses[ColumnStart(ImpulseFloats, index) + row * Vector<float>.Count];

    /// <summary>Reads the description and the impulses of a constraint.</summary>
    internal void ReadColumn(ref TypeBatch batch, int index, Span<float> column)
    {
        for (int i = 0; i < PrestepFloats; ++i)
            column[i] = PrestepFloat(ref batch, index, i);
        for (int i = 0; i < ImpulseFloats; ++i)
            column[PrestepFloats + i] = Impulse(ref batch, index, i);
    }

    /// <summary>Writes the description and the impulses of a constraint.</summary>
    internal void WriteColumn(ref TypeBatch batch, int index, ReadOnlySpan<float> column)
    {
        for (int i = 0; i < PrestepFloats; ++i)
            PrestepFloat(ref batch, index, i) = column[i];
        for (int i = 0; i < ImpulseFloats; ++i)
            Impulse(ref batch, index, i) = column[PrestepFloats + i];
    }

    /// <summary>Every column of a type batch, in one place, with the number of values that a constraint has in it.</summary>
    // The handles tell the capacity, so they come last, should the system refuse memory in between.
    [MethodImpl(MethodImplOptions.NoInlining)]
    void VisitColumns<TVisitor>(ref TypeBatch batch, ref TVisitor visitor) where TVisitor : struct, IColumnVisitor
    {
        visitor.Visit(ref batch.Prestep, PrestepFloats);
        visitor.Visit(ref batch.AccumulatedImpulses, ImpulseFloats);
        visitor.Visit(ref batch.BodyReferences, BodiesPerConstraint);
        visitor.Visit(ref batch.IndexToHandle, 1);
    }

    /// <summary>Copies a constraint to the place of another one.</summary>
    internal void Move(ref TypeBatch batch, int from, int to)
    {
        var move = new MoveInBundles(from, to);
        VisitColumns(ref batch, ref move);
    }

    /// <summary>Exchanges the places of two constraints.</summary>
    internal void Exchange(ref TypeBatch batch, int a, int b)
    {
        var exchange = new ExchangeInBundles(a, b);
        VisitColumns(ref batch, ref exchange);
    }

    /// <summary>Says who a constraint is, on one body or two, and nothing else.</summary>
    internal void WriteNames(ref TypeBatch batch, int index, ConstraintHandle handle, int referenceA, int referenceB)
    {
        batch.IndexToHandle[index] = handle;
        ref var reference = ref BodyReference(ref batch, index, 0);
        reference = referenceA;
        if (BodiesPerConstraint > 1)
            Unsafe.Add(ref reference, Vector<float>.Count) = referenceB;
    }

    /// <summary>Clears what is in the lanes of the last bundle that have no constraint.</summary>
    /// <param name="batch">The type batch.</param>
    /// <param name="usedBundles">Number of bundles that have been in use before: in these there is no number that none may be.</param>
    internal void ClearUnusedLanes(ref TypeBatch batch, int usedBundles)
    {
        for (int index = batch.ConstraintCount; index % Vector<float>.Count != 0; ++index)
        {
            for (int slot = 0; slot < BodiesPerConstraint; ++slot)
                BodyReference(ref batch, index, slot) = EncodedBody.Empty;
            if (batch.BundleCount <= usedBundles)
                continue;
            ClearColumn(ref batch.Prestep, PrestepFloats, index);
            ClearColumn(ref batch.AccumulatedImpulses, ImpulseFloats, index);
        }
    }

    internal void Dispose(ref TypeBatch batch, BufferPool pool)
    {
        var dispose = new ReturnColumns(pool);
        if (batch.IndexToHandle.Allocated)
            VisitColumns(ref batch, ref dispose);
        batch = default;
    }

    internal void Resize(ref TypeBatch batch, int capacity, BufferPool pool)
    {
        // Whole bundles are addressed, so all columns hold whole bundles. What is not written yet is not copied, nor touched: a type batch that doubles
        // many times in a flush costs one of its sizes.
        var written = batch.Pending.IsListed ? BundleIndexing.GetBundleCount(batch.Pending.ConstraintCount) : batch.BundleCount;
        var resize = new ResizeBundles(BundleIndexing.GetBundleCount(capacity), written, pool);
        VisitColumns(ref batch, ref resize);
    }

    /// <summary>Copies all constraints out of a type batch, or others into one that is empty.</summary>
    internal void CopyState(ref TypeBatch batch, int minimumCapacity, StateCopy copy)
    {
        var count = copy.Value(batch.ConstraintCount);
        if (copy.Restores)
            Resize(ref batch, Math.Max(minimumCapacity, count), copy.Pool);
        batch.ConstraintCount = count;
        var bundles = new CopyColumns(copy, batch.BundleCount * Vector<float>.Count);
        VisitColumns(ref batch, ref bundles);
    }

    internal static int ColumnStart(int floats, int index) =>
        index / Vector<float>.Count * floats * Vector<float>.Count + index % Vector<float>.Count;

    // Unused lanes are computed with and never stored. Zeros keep them from being slow denormals or from trapping in a checked build.
    void ClearBundle(ref TypeBatch batch, int bundle)
    {
        var lanes = Vector<float>.Count;
        batch.Prestep.Clear(bundle * lanes * PrestepFloats, lanes * PrestepFloats);
        batch.AccumulatedImpulses.Clear(bundle * lanes * ImpulseFloats, lanes * ImpulseFloats);
        for (int i = 0; i < lanes * BodiesPerConstraint; ++i)
            batch.BodyReferences[bundle * lanes * BodiesPerConstraint + i] = EncodedBody.Empty;
    }

    static void ClearColumn(ref Buffer<float> buffer, int floats, int index)
    {
        var start = ColumnStart(floats, index);
        for (int i = 0; i < floats; ++i)
            buffer[start + i * Vector<float>.Count] = 0;
    }
}
