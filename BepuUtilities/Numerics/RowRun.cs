using System.Numerics;
using System.Runtime.CompilerServices;

namespace BepuUtilities;

/// <summary>Rows one after the other, one for each lane: where the first of them is says where all are, so that no lane asks memory for it.</summary>
[method: MethodImpl(MethodImplOptions.AggressiveInlining)]
public readonly unsafe struct RowRun(int first) : IRowPlaces<RowRun>
{
    readonly nint first = first;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static float* Row(in RowRun places, float* rows, int strideInFloats, int lane) =>
        rows + places.first * strideInFloats + (nint)lane * strideInFloats;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static uint Unwritten(in RowRun places) => 0;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector<int> Indices(in RowRun places) => new Vector<int>((int)places.first) + Vector<int>.Indices;
}
