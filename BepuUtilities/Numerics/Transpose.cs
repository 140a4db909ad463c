using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using System.Runtime.Intrinsics.X86;
using BepuUtilities.Diagnostics;

namespace BepuUtilities;

/// <summary>
/// Moves rows of eight floats, one per lane, between memory (one object after the other) and wide values (one component after the
/// other). Body poses, velocities and inertias are such rows.
/// </summary>
/// <remarks>
/// <para>
/// A bundle of constraints refers to its bodies by index. Fetching each float by itself costs one scalar load and one insert per
/// float; loading a lane's whole 32-byte row and transposing rows in registers costs one load per lane and three shuffles per
/// component:
/// </para>
/// <code>
///   lane 0: a0 a1 a2 a3 a4 a5 a6 a7        R0: a0 b0 c0 d0 ...
///   lane 1: b0 b1 b2 b3 b4 b5 b6 b7   ->   R1: a1 b1 c1 d1 ...
///   lane 2: c0 c1 c2 c3 c4 c5 c6 c7        R2: a2 b2 c2 d2 ...
/// </code>
/// <para>
/// Everything moves bits only, so all paths agree to the bit; the lane loops are the fallback for other widths and the test oracle.
/// Indices may carry flags: bits 30 and 31 are no part of a row's number. A negative index marks an empty lane: it reads row 0 (whose
/// values must only be harmless) and writes nothing. Bit 30 marks a row that is read but not written.
/// </para>
/// </remarks>
public static unsafe partial class Transpose
{
    /// <summary>The bits of an index that number a row.</summary>
    public const int RowMask = (1 << 30) - 1;

    /// <summary>
    /// Reads eight floats per lane, at <c>rows + index * strideInFloats</c>. The base must be aligned to 32 bytes and the stride a
    /// multiple of eight floats; row 0 must exist if any lane is empty.
    /// </summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Rows8 Gather(float* rows, int strideInFloats, Vector<int> rowIndices) => Gather(rows, strideInFloats, new RowOffsets(rowIndices));

    /// <summary>As <see cref="Gather(float*, int, Vector{int})"/>, where several rows are read by the same indices.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Rows8 Gather<TRows>(float* rows, int strideInFloats, in TRows offsets)
        where TRows : unmanaged, IRowPlaces<TRows>
    {
        Check.That(((nuint)rows & 31) == 0 && (strideInFloats & 7) == 0);
        if (Vector<float>.Count == 8 && Avx.IsSupported)
            return Gather8(rows, strideInFloats, offsets);
        if (Vector<float>.Count == 4 && Vector128.IsHardwareAccelerated)
            return Gather4(rows, strideInFloats, offsets);
        if (Vector<float>.Count == 16 && Avx.IsSupported)
            return Gather16(rows, strideInFloats, offsets);
        return GatherByLanes(rows, strideInFloats, TRows.Indices(offsets));
    }

    /// <summary>
    /// Writes eight floats per lane, at <c>rows + index * strideInFloats</c>; lanes whose index is negative or has bit 30 set write
    /// nothing. Alignment as for <see cref="Gather(float*, int, Vector{int})"/>; of two lanes with the same index either may win.
    /// </summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Scatter(in Rows8 values, float* rows, int strideInFloats, Vector<int> rowIndices) =>
        Scatter(values, rows, strideInFloats, new RowOffsets(rowIndices));

    /// <summary>As <see cref="Scatter(in Rows8, float*, int, Vector{int})"/>, where several rows are read or written by the same indices.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Scatter<TRows>(in Rows8 values, float* rows, int strideInFloats, in TRows offsets)
        where TRows : unmanaged, IRowPlaces<TRows>
    {
        Check.That(((nuint)rows & 31) == 0 && (strideInFloats & 7) == 0);
        if (Vector<float>.Count == 8 && Avx.IsSupported)
            Scatter8(values, rows, strideInFloats, offsets);
        else if (Vector<float>.Count == 4 && Vector128.IsHardwareAccelerated)
            Scatter4(values, rows, strideInFloats, offsets);
        else if (Vector<float>.Count == 16 && Avx.IsSupported)
            Scatter16(values, rows, strideInFloats, offsets);
        else
            ScatterByLanes(values, rows, strideInFloats, TRows.Indices(offsets));
    }

    /// <summary>Whether all bits of the rows of eight floats that <see cref="Gather{TRows}(float*, int, in TRows)"/> would read are zero.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static bool AreZero<TRows>(float* rows, in TRows offsets)
        where TRows : unmanaged, IRowPlaces<TRows>
    {
        Check.That(((nuint)rows & 31) == 0);
        var bits = Vector256<int>.Zero;
        for (int lane = 0; lane < Vector<float>.Count; lane += 4)
        {
            bits |= (Vector256.LoadAligned((int*)TRows.Row(offsets, rows, Rows8.Count, lane)) |
                Vector256.LoadAligned((int*)TRows.Row(offsets, rows, Rows8.Count, lane + 1))) |
                (Vector256.LoadAligned((int*)TRows.Row(offsets, rows, Rows8.Count, lane + 2)) |
                Vector256.LoadAligned((int*)TRows.Row(offsets, rows, Rows8.Count, lane + 3)));
        }
        return bits == Vector256<int>.Zero;
    }

    /// <summary>Whether a lane with this index is written: no flag is set.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static bool IsWritten(int rowIndex) => (uint)rowIndex <= RowMask;

    /// <summary>The definition of gathers, one float at a time.</summary>
    internal static Rows8 GatherByLanes(float* rows, int strideInFloats, Vector<int> rowIndices)
    {
        Unsafe.SkipInit(out Rows8 result);
        var target = (float*)&result;
        for (int lane = 0; lane < Vector<float>.Count; ++lane)
        {
            var index = rowIndices[lane] < 0 ? 0 : rowIndices[lane] & RowMask;
            for (int i = 0; i < Rows8.Count; ++i)
                target[i * Vector<float>.Count + lane] = rows[(nint)index * strideInFloats + i];
        }
        return result;
    }

    /// <summary>The definition of scatters, one float at a time.</summary>
    internal static void ScatterByLanes(Rows8 values, float* rows, int strideInFloats, Vector<int> rowIndices)
    {
        var source = (float*)&values;
        for (int lane = 0; lane < Vector<float>.Count; ++lane)
        {
            if (!IsWritten(rowIndices[lane]))
                continue;
            for (int i = 0; i < Rows8.Count; ++i)
                rows[(nint)rowIndices[lane] * strideInFloats + i] = source[i * Vector<float>.Count + lane];
        }
    }
}
