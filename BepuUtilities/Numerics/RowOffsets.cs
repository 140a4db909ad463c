using System.Numerics;
using System.Runtime.CompilerServices;

namespace BepuUtilities;

/// <summary>Where the rows of a bundle's lanes begin, from their indices, for all gathers and scatters by the same indices.</summary>
/// <remarks>
/// The lanes of a register can be taken out of it one by one, at two or three instructions each; from memory each is one load, which the
/// processor forwards from the store of the whole register. So this is a local that has an address, and lives on the stack.
/// </remarks>
public readonly unsafe struct RowOffsets
{
    // Rows of eight floats are 32 bytes each; a longer row is a multiple of one, which costs no instruction where it is the double.
    const int Shift = 5;

    /// <summary>Number of rows of which each can be found: 4 GiB of rows of eight floats.</summary>
    public const int MaximumRowCount = 1 << 32 - Shift;

    readonly Vector<int> bytes;
    internal readonly Vector<int> Indices;

    /// <summary>Takes the indices of rows, with flags as <see cref="Transpose"/> knows them, below <see cref="MaximumRowCount"/>.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public RowOffsets(Vector<int> rowIndices)
    {
        Indices = rowIndices;
        var places = Vector.AndNot(rowIndices & new Vector<int>(Transpose.RowMask), Vector.LessThan(rowIndices, Vector<int>.Zero));
        bytes = places << Shift;
    }

    /// <summary>Row of a lane; row 0 for an empty one.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal float* Row(float* rows, int strideInFloats, int lane) =>
        (float*)((byte*)rows + (nint)Unsafe.Add(ref Unsafe.As<Vector<int>, uint>(ref Unsafe.AsRef(in bytes)), lane) * (strideInFloats / Rows8.Count));

    /// <summary>One bit per lane, set where nothing is written: empty lanes, and those of rows that are only read.</summary>
    internal uint Unwritten
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => Wide.Bits(Indices | Indices << 1);
    }
}
