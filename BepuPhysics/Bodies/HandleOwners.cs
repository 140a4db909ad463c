using System;
using System.Diagnostics.CodeAnalysis;
using System.Runtime.CompilerServices;
using BepuUtilities.Diagnostics;
using BepuUtilities.Memory;

namespace BepuPhysics;

/// <summary>Which handle each slot belongs to, so that the handles of those that had it before are known.</summary>
/// <remarks>
/// The bits of a value above the slot begin with zero and count how often the slot was given up, until they overflow and begin with zero again.
/// </remarks>
struct HandleOwners
{
    readonly int slotBits;
    readonly int valueMask;
    // Value of the handle that has the slot; of a free slot the complement of the value that comes next, which equals no value.
    Buffer<int> values;
    bool isPlain;

    internal HandleOwners(int slotBits, int valueBits, int capacity, BufferPool pool)
    {
        this.slotBits = slotBits;
        valueMask = (int)((1u << valueBits) - 1);
        EnsureCapacity(capacity, pool);
    }

    /// <summary>Whether values that are given out are slots and nothing else, and do not tell who has a slot from who had it before.</summary>
    internal bool IsPlain
    {
        readonly get => isPlain;
        set
        {
            isPlain = value;
            for (int slot = 0; value && slot < values.Length; ++slot)
            {
                if (values[slot] < 0)
                    values[slot] = ~slot;
            }
        }
    }

    /// <summary>Number of slots that are known.</summary>
    internal readonly int Capacity => values.Length;

    /// <summary>Whether a value is that of a handle that has its slot now. Any value may be asked.</summary>
    /// <param name="value">Value of a handle.</param>
    /// <param name="slot">Its slot.</param>
    internal readonly bool Has(int value, int slot) => (uint)slot < (uint)values.Length && values[slot] == value;

    /// <summary>Whether a value is that of a handle that had its slot before. False for those that have it, or never had.</summary>
    internal readonly bool IsStale(int value, int slot) => (uint)slot < (uint)values.Length && values[slot] != value && values[slot] != ~value;

    /// <summary>Whether a slot is taken.</summary>
    internal readonly bool IsTaken(int slot) => (uint)slot < (uint)values.Length && values[slot] >= 0;

    /// <summary>Value of the handle that has a slot, which is taken.</summary>
    internal readonly int ValueAt(int slot)
    {
        Check.That(IsTaken(slot));
        return values[slot];
    }

    /// <summary>Gives a free slot to a new handle and returns its value.</summary>
    internal readonly int Claim(int slot)
    {
        Check.That(!IsTaken(slot));
        return values[slot] = ~values[slot];
    }

    /// <summary>Makes a slot free; from now on its handle is stale.</summary>
    internal readonly void Release(int slot)
    {
        Check.That(IsTaken(slot));
        values[slot] = ~(isPlain ? slot : (int)(((uint)values[slot] + (1u << slotBits)) & (uint)valueMask));
    }

    /// <summary>Makes all slots free.</summary>
    internal readonly void ReleaseAll()
    {
        for (int slot = 0; slot < values.Length; ++slot)
        {
            if (values[slot] >= 0)
                Release(slot);
        }
    }

    /// <summary>What is said of a handle that names nothing.</summary>
    internal readonly ArgumentException Missing<THandle>(THandle handle, int value, int slot) =>
        new(IsStale(value, slot) ? $"There is no {handle} any more: it was removed." : $"There is no {handle}.", nameof(handle));

    /// <summary>Whether one more handle needs a slot that there is no row for yet.</summary>
    /// <param name="ids">Free slots.</param>
    /// <param name="maximumCount">Greatest number of slots.</param>
    /// <param name="kind">What the handles name, for a reader.</param>
    /// <param name="count">Number of slots that there must be then.</param>
    /// <exception cref="InvalidOperationException">There are no more slots.</exception>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static bool NeedsSlot(in IdPool ids, int maximumCount, string kind, out int count)
    {
        count = ids.HighestPossiblyClaimedId + 2;
        if (ids.AvailableIdCount > 0)
            return false;
        if (count > maximumCount)
            ThrowFull(maximumCount, kind);
        return true;
    }

    [DoesNotReturn]
    static void ThrowFull(int maximumCount, string kind) =>
        throw new InvalidOperationException($"There are {maximumCount} {kind}, as many as a simulation holds.");

    /// <summary>Makes room for a number of slots, their rows, and their return: what a removal needs is there from the beginning.</summary>
    /// <param name="count">Number of slots.</param>
    /// <param name="absent">Row of a slot that is free.</param>
    /// <param name="rows">A row for each slot.</param>
    /// <param name="ids">Free slots.</param>
    /// <param name="pool">Pool.</param>
    internal void EnsureSlots<TRow>(int count, in TRow absent, ref Buffer<TRow> rows, ref IdPool ids, BufferPool pool) where TRow : unmanaged
    {
        var previous = rows.Length;
        if (count > previous)
        {
            pool.ResizeToAtLeast(ref rows, count, previous);
            rows.AsSpan()[previous..].Fill(absent);
        }
        EnsureCapacity(rows.Length, pool);
        ids.EnsureCapacity(rows.Length, pool);
    }

    void EnsureCapacity(int capacity, BufferPool pool)
    {
        if (capacity <= values.Length)
            return;
        var previous = values.Length;
        pool.ResizeToAtLeast(ref values, capacity, previous);
        BeginFrom(previous);
    }

    // Slots that nobody ever had.
    readonly void BeginFrom(int slot)
    {
        for (; slot < values.Length; ++slot)
            values[slot] = ~slot;
    }

    internal void CopyState(StateCopy copy)
    {
        var count = copy.Rows(ref values, values.Length);
        if (copy.Restores)
            BeginFrom(count);
    }

    internal void Dispose(BufferPool pool) => pool.Return(ref values);
}
