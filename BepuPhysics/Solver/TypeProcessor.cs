using System;
using System.Numerics;
using BepuUtilities.Diagnostics;
using BepuUtilities.Memory;

namespace BepuPhysics.Constraints;

/// <summary>Stores and solves the constraints of one type.</summary>
/// <remarks>
/// One call per type batch and stage goes through this class; everything inside a call is specialised for the type. Storing and moving
/// constraints needs no specialisation: a constraint is a column of numbers.
/// </remarks>
public abstract class TypeProcessor
{
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
    /// <summary>Applies the accumulated impulses of some bundles.</summary>
    internal abstract void WarmStart(ref TypeBatch batch, in SolverBodies bodies, in Substep substep, int startBundle, int endBundle);
    /// <summary>Solves some bundles once.</summary>
    internal abstract void Solve(ref TypeBatch batch, in SolverBodies bodies, in Substep substep, int startBundle, int endBundle);
    /// <summary>As <see cref="WarmStart"/>, for a batch in which bodies occur more than once: on split bodies.</summary>
    internal abstract void WarmStartSplit(ref TypeBatch batch, in SolverBodies bodies, in SplitBodies split, in Substep substep, int startBundle,
        int endBundle);
    /// <summary>As <see cref="Solve"/>, for a batch in which bodies occur more than once: on split bodies.</summary>
    internal abstract void SolveSplit(ref TypeBatch batch, in SolverBodies bodies, in SplitBodies split, in Substep substep, int startBundle, int endBundle);

    /// <summary>Appends a constraint with zero impulses and an unwritten description.</summary>
    /// <returns>Its index in the batch.</returns>
    internal int Allocate(ref TypeBatch batch, ConstraintHandle handle, ReadOnlySpan<int> encodedBodies, int minimumCapacity, BufferPool pool)
    {
        Check.That(encodedBodies.Length == BodiesPerConstraint);
        if (batch.ConstraintCount == batch.IndexToHandle.Length)
            Resize(ref batch, Math.Max(Math.Max(1, minimumCapacity), batch.ConstraintCount * 2), pool);
        var index = batch.ConstraintCount++;
        batch.IndexToHandle[index] = handle;
        if (index % Vector<float>.Count == 0)
            ClearBundle(ref batch, index / Vector<float>.Count);
        for (int slot = 0; slot < encodedBodies.Length; ++slot)
            BodyReference(ref batch, index, slot) = encodedBodies[slot];
        ClearColumn(ref batch.AccumulatedImpulses, ImpulseFloats, index);
        return index;
    }

    /// <summary>Removes a constraint by moving the last one into its place.</summary>
    /// <returns>Handle of the constraint that was moved; its value is -1 where none was.</returns>
    internal ConstraintHandle Remove(ref TypeBatch batch, int index)
    {
        var last = --batch.ConstraintCount;
        var moved = new ConstraintHandle(-1);
        if (index != last)
        {
            moved = batch.IndexToHandle[last];
            batch.IndexToHandle[index] = moved;
            CopyColumn(ref batch.Prestep, PrestepFloats, last, index);
            CopyColumn(ref batch.AccumulatedImpulses, ImpulseFloats, last, index);
            for (int slot = 0; slot < BodiesPerConstraint; ++slot)
                BodyReference(ref batch, index, slot) = BodyReference(ref batch, last, slot);
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

    internal static void Dispose(ref TypeBatch batch, BufferPool pool)
    {
        if (batch.IndexToHandle.Allocated)
        {
            pool.Return(ref batch.IndexToHandle);
            pool.Return(ref batch.BodyReferences);
            pool.Return(ref batch.Prestep);
            pool.Return(ref batch.AccumulatedImpulses);
        }
        batch = default;
    }

    internal void Resize(ref TypeBatch batch, int capacity, BufferPool pool)
    {
        // Whole bundles are addressed, so all buffers hold whole bundles.
        var lanes = Vector<float>.Count;
        var bundles = (capacity + lanes - 1) / lanes;
        var used = batch.BundleCount * lanes;
        ResizeExactly(ref batch.BodyReferences, bundles * lanes * BodiesPerConstraint, used * BodiesPerConstraint, pool);
        ResizeExactly(ref batch.Prestep, bundles * lanes * PrestepFloats, used * PrestepFloats, pool);
        ResizeExactly(ref batch.AccumulatedImpulses, bundles * lanes * ImpulseFloats, used * ImpulseFloats, pool);
        // It tells the capacity, so it comes last, should the system refuse memory in between.
        ResizeExactly(ref batch.IndexToHandle, bundles * lanes, batch.ConstraintCount, pool);
    }

    static void ResizeExactly<T>(ref Buffer<T> buffer, int length, int used, BufferPool pool) where T : unmanaged
    {
        pool.Take<T>(length, out var larger);
        if (buffer.Allocated)
        {
            buffer.CopyTo(0, larger, 0, used);
            pool.Return(ref buffer);
        }
        buffer = larger;
    }

    static int ColumnStart(int floats, int index) =>
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

    static void CopyColumn(ref Buffer<float> buffer, int floats, int source, int target)
    {
        var from = ColumnStart(floats, source);
        var to = ColumnStart(floats, target);
        for (int i = 0; i < floats; ++i)
            buffer[to + i * Vector<float>.Count] = buffer[from + i * Vector<float>.Count];
    }
}
