using System.Numerics;
using System.Runtime.CompilerServices;

namespace BepuUtilities;

/// <summary>Where the rows of a bundle's lanes begin, from their indices, for all gathers and scatters by the same indices.</summary>
/// <remarks>
/// The lanes of a register can be taken out of it one by one, at two or three instructions each; from memory each is one load, which the
/// processor forwards from the store of the whole register. So this is a local that has an address, and lives on the stack.
/// </remarks>
public readonly unsafe struct RowOffsets : IRowPlaces<RowOffsets>
{
    // Rows of eight floats are 32 bytes each; a longer row is a multiple of one, which costs no instruction where it is the double.
    const int Shift = 5;

    /// <summary>Number of rows of which each can be found: 4 GiB of rows of eight floats.</summary>
    public const int MaximumRowCount = 1 << 32 - Shift;

    readonly Vector<int> bytes;
    readonly Vector<int> indices;

    /// <summary>Takes the indices of rows, with flags as <see cref="Transpose"/> knows them, below <see cref="MaximumRowCount"/>.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public RowOffsets(Vector<int> rowIndices)
    {
        indices = rowIndices;
        var places = Vector.AndNot(rowIndices & new Vector<int>(Transpose.RowMask), Vector.LessThan(rowIndices, Vector<int>.Zero));
        bytes = places << Shift;
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static float* Row(in RowOffsets places, float* rows, int strideInFloats, int lane) => (float*)((byte*)rows +
        (nint)Unsafe.Add(ref Unsafe.As<Vector<int>, uint>(ref Unsafe.AsRef(in places.bytes)), lane) * (strideInFloats / Rows8.Count));

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static uint Unwritten(in RowOffsets places) => Wide.Bits(places.indices | places.indices << 1);

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector<int> Indices(in RowOffsets places) => places.indices;
}
