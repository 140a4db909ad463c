using System;
using System.Diagnostics.CodeAnalysis;
using System.Runtime.CompilerServices;
using BepuUtilities.Memory;

namespace BepuPhysics;

/// <summary>A row for each slot of a kind of handle, found by the value of a handle or by its slot.</summary>
/// <remarks>
/// A view, valid until something is added. It does not tell handles of one slot from each other: whether a handle is that of something
/// that exists, <see cref="Bodies.BodyExists"/> and the like say.
/// </remarks>
/// <typeparam name="T">Type of the rows.</typeparam>
public readonly unsafe struct HandleTable<T> where T : unmanaged
{
    readonly T* rows;
    readonly int slotMask;

    internal HandleTable(in Buffer<T> rows, int slotMask)
    {
        this.rows = rows.Memory;
        Length = rows.Length;
        this.slotMask = slotMask;
    }

    /// <summary>Number of rows.</summary>
    public int Length { get; }

    /// <summary>Row of a handle.</summary>
    /// <param name="handleValue">Value of the handle, or its slot.</param>
    /// <exception cref="ArgumentOutOfRangeException">No handle of that slot was ever given out.</exception>
    public ref T this[int handleValue]
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get
        {
            var slot = handleValue & slotMask;
            if ((uint)slot >= (uint)Length)
                ThrowOutOfRange(handleValue);
            return ref rows[slot];
        }
    }

    [DoesNotReturn]
    static void ThrowOutOfRange(int handleValue) =>
        throw new ArgumentOutOfRangeException(nameof(handleValue), handleValue, "No handle of that slot was ever given out.");
}
