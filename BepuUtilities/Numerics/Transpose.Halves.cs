using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using System.Runtime.Intrinsics.X86;
using BepuUtilities.Diagnostics;

namespace BepuUtilities;

// Half a row is as much as a body's orientation, its linear or its angular velocity: what needs one of them need not move the other.
public static unsafe partial class Transpose
{
    /// <summary>Floats of half a row.</summary>
    public const int FloatsPerHalf = Rows8.Count / 2;

    /// <summary>
    /// Reads four floats per lane, at <c>rows + index * strideInFloats</c>: the first half of its row, or the second where the pointer is that much
    /// further. The base must be aligned to 16 bytes; all else is as for <see cref="Gather{TRows}(float*, int, in TRows)"/>.
    /// </summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector4Wide GatherHalf<TRows>(float* rows, int strideInFloats, in TRows offsets)
        where TRows : unmanaged, IRowPlaces<TRows>
    {
        Check.That(((nuint)rows & 15) == 0 && (strideInFloats & 7) == 0);
        if (Vector<float>.Count == 8 && Avx.IsSupported)
            return GatherHalf8(rows, strideInFloats, offsets);
        if (Vector<float>.Count == 4 && Vector128.IsHardwareAccelerated)
            return GatherHalf4(rows, strideInFloats, offsets);
        if (Vector<float>.Count == 16 && Avx512F.IsSupported)
            return GatherHalf16(rows, strideInFloats, offsets);
        return GatherHalfByLanes(rows, strideInFloats, TRows.Indices(offsets));
    }

    /// <summary>
    /// Writes four floats per lane; addresses as for <see cref="GatherHalf"/>, lanes as for <see cref="Scatter{TRows}(in Rows8, float*, int, in TRows)"/>.
    /// </summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void ScatterHalf<TRows>(in Vector4Wide values, float* rows, int strideInFloats, in TRows offsets)
        where TRows : unmanaged, IRowPlaces<TRows>
    {
        Check.That(((nuint)rows & 15) == 0 && (strideInFloats & 7) == 0);
        if (Vector<float>.Count == 8 && Avx.IsSupported)
            ScatterHalf8(values, rows, strideInFloats, offsets);
        else if (Vector<float>.Count == 4 && Vector128.IsHardwareAccelerated)
            ScatterHalf4(values, rows, strideInFloats, offsets);
        else if (Vector<float>.Count == 16 && Avx512F.IsSupported)
            ScatterHalf16(values, rows, strideInFloats, offsets);
        else
            ScatterHalfByLanes(values, rows, strideInFloats, TRows.Indices(offsets));
    }

    /// <summary>The definition of gathers of halves, one float at a time.</summary>
    internal static Vector4Wide GatherHalfByLanes(float* rows, int strideInFloats, Vector<int> rowIndices)
    {
        Unsafe.SkipInit(out Vector4Wide result);
        var target = (float*)&result;
        for (int lane = 0; lane < Vector<float>.Count; ++lane)
        {
            var index = rowIndices[lane] < 0 ? 0 : rowIndices[lane] & RowMask;
            for (int i = 0; i < FloatsPerHalf; ++i)
                target[i * Vector<float>.Count + lane] = rows[(nint)index * strideInFloats + i];
        }
        return result;
    }

    /// <summary>The definition of scatters of halves, one float at a time.</summary>
    internal static void ScatterHalfByLanes(Vector4Wide values, float* rows, int strideInFloats, Vector<int> rowIndices)
    {
        var source = (float*)&values;
        for (int lane = 0; lane < Vector<float>.Count; ++lane)
        {
            if (!IsWritten(rowIndices[lane]))
                continue;
            for (int i = 0; i < FloatsPerHalf; ++i)
                rows[(nint)rowIndices[lane] * strideInFloats + i] = source[i * Vector<float>.Count + lane];
        }
    }

    // The halves of two rows side by side. The second is read into its place: no shuffle puts them together.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector256<float> Pair<TRows>(float* rows, int stride, in TRows offsets, int low)
        where TRows : unmanaged, IRowPlaces<TRows> => Vector256.Create(
        Vector128.LoadAligned(TRows.Row(offsets, rows, stride, low)), Vector128.LoadAligned(TRows.Row(offsets, rows, stride, low + 4)));

    // In each part of four lanes, four rows of four floats exchanged for four columns. Its own inverse.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void Transpose4(ref Vector256<float> r0, ref Vector256<float> r1, ref Vector256<float> r2, ref Vector256<float> r3)
    {
        var t0 = Avx.UnpackLow(r0, r1);
        var t1 = Avx.UnpackHigh(r0, r1);
        var t2 = Avx.UnpackLow(r2, r3);
        var t3 = Avx.UnpackHigh(r2, r3);
        r0 = Avx.Shuffle(t0, t2, 0b01_00_01_00);
        r1 = Avx.Shuffle(t0, t2, 0b11_10_11_10);
        r2 = Avx.Shuffle(t1, t3, 0b01_00_01_00);
        r3 = Avx.Shuffle(t1, t3, 0b11_10_11_10);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void Transpose4(ref Vector512<float> r0, ref Vector512<float> r1, ref Vector512<float> r2, ref Vector512<float> r3)
    {
        var t0 = Avx512F.UnpackLow(r0, r1);
        var t1 = Avx512F.UnpackHigh(r0, r1);
        var t2 = Avx512F.UnpackLow(r2, r3);
        var t3 = Avx512F.UnpackHigh(r2, r3);
        r0 = Avx512F.Shuffle(t0, t2, 0b01_00_01_00);
        r1 = Avx512F.Shuffle(t0, t2, 0b11_10_11_10);
        r2 = Avx512F.Shuffle(t1, t3, 0b01_00_01_00);
        r3 = Avx512F.Shuffle(t1, t3, 0b11_10_11_10);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector4Wide GatherHalf4<TRows>(float* rows, int stride, in TRows offsets)
        where TRows : unmanaged, IRowPlaces<TRows>
    {
        var r0 = Vector128.LoadAligned(TRows.Row(offsets, rows, stride, 0));
        var r1 = Vector128.LoadAligned(TRows.Row(offsets, rows, stride, 1));
        var r2 = Vector128.LoadAligned(TRows.Row(offsets, rows, stride, 2));
        var r3 = Vector128.LoadAligned(TRows.Row(offsets, rows, stride, 3));
        Transpose4(ref r0, ref r1, ref r2, ref r3);
        return new(r0.AsVector(), r1.AsVector(), r2.AsVector(), r3.AsVector());
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector4Wide GatherHalf8<TRows>(float* rows, int stride, in TRows offsets)
        where TRows : unmanaged, IRowPlaces<TRows>
    {
        var r0 = Pair(rows, stride, offsets, 0);
        var r1 = Pair(rows, stride, offsets, 1);
        var r2 = Pair(rows, stride, offsets, 2);
        var r3 = Pair(rows, stride, offsets, 3);
        Transpose4(ref r0, ref r1, ref r2, ref r3);
        return new(r0.AsVector(), r1.AsVector(), r2.AsVector(), r3.AsVector());
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector4Wide GatherHalf16<TRows>(float* rows, int stride, in TRows offsets)
        where TRows : unmanaged, IRowPlaces<TRows>
    {
        var r0 = Vector512.Create(Pair(rows, stride, offsets, 0), Pair(rows, stride, offsets, 8));
        var r1 = Vector512.Create(Pair(rows, stride, offsets, 1), Pair(rows, stride, offsets, 9));
        var r2 = Vector512.Create(Pair(rows, stride, offsets, 2), Pair(rows, stride, offsets, 10));
        var r3 = Vector512.Create(Pair(rows, stride, offsets, 3), Pair(rows, stride, offsets, 11));
        Transpose4(ref r0, ref r1, ref r2, ref r3);
        return new(r0.AsVector(), r1.AsVector(), r2.AsVector(), r3.AsVector());
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void ScatterHalf4<TRows>(in Vector4Wide values, float* rows, int stride, in TRows offsets)
        where TRows : unmanaged, IRowPlaces<TRows>
    {
        var r0 = values.X.AsVector128();
        var r1 = values.Y.AsVector128();
        var r2 = values.Z.AsVector128();
        var r3 = values.W.AsVector128();
        Transpose4(ref r0, ref r1, ref r2, ref r3);
        StoreFour(r0, r1, r2, r3, rows, stride, offsets, TRows.Unwritten(offsets), 0);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void ScatterHalf8<TRows>(in Vector4Wide values, float* rows, int stride, in TRows offsets)
        where TRows : unmanaged, IRowPlaces<TRows>
    {
        var r0 = values.X.AsVector256();
        var r1 = values.Y.AsVector256();
        var r2 = values.Z.AsVector256();
        var r3 = values.W.AsVector256();
        Transpose4(ref r0, ref r1, ref r2, ref r3);
        var unwritten = TRows.Unwritten(offsets);
        StoreFour(r0.GetLower(), r1.GetLower(), r2.GetLower(), r3.GetLower(), rows, stride, offsets, unwritten, 0);
        StoreFour(r0.GetUpper(), r1.GetUpper(), r2.GetUpper(), r3.GetUpper(), rows, stride, offsets, unwritten, 4);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void ScatterHalf16<TRows>(in Vector4Wide values, float* rows, int stride, in TRows offsets)
        where TRows : unmanaged, IRowPlaces<TRows>
    {
        var r0 = values.X.AsVector512();
        var r1 = values.Y.AsVector512();
        var r2 = values.Z.AsVector512();
        var r3 = values.W.AsVector512();
        Transpose4(ref r0, ref r1, ref r2, ref r3);
        var unwritten = TRows.Unwritten(offsets);
        StoreFour(
            r0.GetLower().GetLower(), r1.GetLower().GetLower(), r2.GetLower().GetLower(), r3.GetLower().GetLower(), rows, stride, offsets, unwritten, 0);
        StoreFour(
            r0.GetLower().GetUpper(), r1.GetLower().GetUpper(), r2.GetLower().GetUpper(), r3.GetLower().GetUpper(), rows, stride, offsets, unwritten, 4);
        StoreFour(
            r0.GetUpper().GetLower(), r1.GetUpper().GetLower(), r2.GetUpper().GetLower(), r3.GetUpper().GetLower(), rows, stride, offsets, unwritten, 8);
        StoreFour(
            r0.GetUpper().GetUpper(), r1.GetUpper().GetUpper(), r2.GetUpper().GetUpper(), r3.GetUpper().GetUpper(), rows, stride, offsets, unwritten, 12);
    }

    // Nearly all bundles write all lanes, and need no question for each.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void StoreFour<TRows>(
        Vector128<float> r0, Vector128<float> r1, Vector128<float> r2, Vector128<float> r3, float* rows, int stride, in TRows offsets,
        uint unwritten, int first)
        where TRows : unmanaged, IRowPlaces<TRows>
    {
        if ((unwritten >> first & 15) == 0)
        {
            r0.StoreAligned(TRows.Row(offsets, rows, stride, first));
            r1.StoreAligned(TRows.Row(offsets, rows, stride, first + 1));
            r2.StoreAligned(TRows.Row(offsets, rows, stride, first + 2));
            r3.StoreAligned(TRows.Row(offsets, rows, stride, first + 3));
            return;
        }
        if ((unwritten & 1u << first) == 0) r0.StoreAligned(TRows.Row(offsets, rows, stride, first));
        if ((unwritten & 2u << first) == 0) r1.StoreAligned(TRows.Row(offsets, rows, stride, first + 1));
        if ((unwritten & 4u << first) == 0) r2.StoreAligned(TRows.Row(offsets, rows, stride, first + 2));
        if ((unwritten & 8u << first) == 0) r3.StoreAligned(TRows.Row(offsets, rows, stride, first + 3));
    }
}
