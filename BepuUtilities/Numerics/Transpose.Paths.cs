using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using System.Runtime.Intrinsics.Arm;
using System.Runtime.Intrinsics.X86;

namespace BepuUtilities;

// One path per width. Locals have one letter: r for rows, t for the first and u for the second step of shuffles.
public static unsafe partial class Transpose
{
    /// <summary>Eight rows of eight floats exchanged for eight columns: 24 shuffles, no memory. Its own inverse.</summary>
    // Pairs of floats, then of pairs, both inside the halves of a register, then the halves.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void Transpose8(
        ref Vector256<float> r0, ref Vector256<float> r1, ref Vector256<float> r2, ref Vector256<float> r3,
        ref Vector256<float> r4, ref Vector256<float> r5, ref Vector256<float> r6, ref Vector256<float> r7)
    {
        var t0 = Avx.UnpackLow(r0, r1);
        var t1 = Avx.UnpackHigh(r0, r1);
        var t2 = Avx.UnpackLow(r2, r3);
        var t3 = Avx.UnpackHigh(r2, r3);
        var t4 = Avx.UnpackLow(r4, r5);
        var t5 = Avx.UnpackHigh(r4, r5);
        var t6 = Avx.UnpackLow(r6, r7);
        var t7 = Avx.UnpackHigh(r6, r7);
        var u0 = Avx.Shuffle(t0, t2, 0b01_00_01_00);
        var u1 = Avx.Shuffle(t0, t2, 0b11_10_11_10);
        var u2 = Avx.Shuffle(t1, t3, 0b01_00_01_00);
        var u3 = Avx.Shuffle(t1, t3, 0b11_10_11_10);
        var u4 = Avx.Shuffle(t4, t6, 0b01_00_01_00);
        var u5 = Avx.Shuffle(t4, t6, 0b11_10_11_10);
        var u6 = Avx.Shuffle(t5, t7, 0b01_00_01_00);
        var u7 = Avx.Shuffle(t5, t7, 0b11_10_11_10);
        r0 = Avx.Permute2x128(u0, u4, 0x20);
        r1 = Avx.Permute2x128(u1, u5, 0x20);
        r2 = Avx.Permute2x128(u2, u6, 0x20);
        r3 = Avx.Permute2x128(u3, u7, 0x20);
        r4 = Avx.Permute2x128(u0, u4, 0x31);
        r5 = Avx.Permute2x128(u1, u5, 0x31);
        r6 = Avx.Permute2x128(u2, u6, 0x31);
        r7 = Avx.Permute2x128(u3, u7, 0x31);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Rows8 Gather8<TRows>(float* rows, int stride, in TRows offsets)
        where TRows : unmanaged, IRowPlaces<TRows>
    {
        GatherEight(rows, stride, offsets, 0, out var r0, out var r1, out var r2, out var r3, out var r4, out var r5, out var r6, out var r7);
        Rows8 result;
        result.R0 = r0.AsVector();
        result.R1 = r1.AsVector();
        result.R2 = r2.AsVector();
        result.R3 = r3.AsVector();
        result.R4 = r4.AsVector();
        result.R5 = r5.AsVector();
        result.R6 = r6.AsVector();
        result.R7 = r7.AsVector();
        return result;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void Scatter8<TRows>(in Rows8 values, float* rows, int stride, in TRows offsets)
        where TRows : unmanaged, IRowPlaces<TRows> => ScatterEight(
        values.R0.AsVector256(), values.R1.AsVector256(), values.R2.AsVector256(), values.R3.AsVector256(),
        values.R4.AsVector256(), values.R5.AsVector256(), values.R6.AsVector256(), values.R7.AsVector256(),
        rows, stride, offsets, TRows.Unwritten(offsets), 0);

    // Sixteen lanes: the two halves are eight lanes each.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Rows8 Gather16<TRows>(float* rows, int stride, in TRows offsets)
        where TRows : unmanaged, IRowPlaces<TRows>
    {
        GatherEight(rows, stride, offsets, 0,
            out var a0, out var a1, out var a2, out var a3, out var a4, out var a5, out var a6, out var a7);
        GatherEight(rows, stride, offsets, Vector256<float>.Count,
            out var b0, out var b1, out var b2, out var b3, out var b4, out var b5, out var b6, out var b7);
        Rows8 result;
        result.R0 = Vector512.Create(a0, b0).AsVector();
        result.R1 = Vector512.Create(a1, b1).AsVector();
        result.R2 = Vector512.Create(a2, b2).AsVector();
        result.R3 = Vector512.Create(a3, b3).AsVector();
        result.R4 = Vector512.Create(a4, b4).AsVector();
        result.R5 = Vector512.Create(a5, b5).AsVector();
        result.R6 = Vector512.Create(a6, b6).AsVector();
        result.R7 = Vector512.Create(a7, b7).AsVector();
        return result;
    }

    /// <summary>Eight lanes, or half of sixteen.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void GatherEight<TRows>(
        float* rows, int stride, in TRows offsets, int first,
        out Vector256<float> r0, out Vector256<float> r1, out Vector256<float> r2, out Vector256<float> r3,
        out Vector256<float> r4, out Vector256<float> r5, out Vector256<float> r6, out Vector256<float> r7)
        where TRows : unmanaged, IRowPlaces<TRows>
    {
        r0 = Vector256.LoadAligned(TRows.Row(offsets, rows, stride, first));
        r1 = Vector256.LoadAligned(TRows.Row(offsets, rows, stride, first + 1));
        r2 = Vector256.LoadAligned(TRows.Row(offsets, rows, stride, first + 2));
        r3 = Vector256.LoadAligned(TRows.Row(offsets, rows, stride, first + 3));
        r4 = Vector256.LoadAligned(TRows.Row(offsets, rows, stride, first + 4));
        r5 = Vector256.LoadAligned(TRows.Row(offsets, rows, stride, first + 5));
        r6 = Vector256.LoadAligned(TRows.Row(offsets, rows, stride, first + 6));
        r7 = Vector256.LoadAligned(TRows.Row(offsets, rows, stride, first + 7));
        Transpose8(ref r0, ref r1, ref r2, ref r3, ref r4, ref r5, ref r6, ref r7);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void Scatter16<TRows>(in Rows8 values, float* rows, int stride, in TRows offsets)
        where TRows : unmanaged, IRowPlaces<TRows>
    {
        var unwritten = TRows.Unwritten(offsets);
        ScatterEight(
            values.R0.AsVector512().GetLower(), values.R1.AsVector512().GetLower(), values.R2.AsVector512().GetLower(), values.R3.AsVector512().GetLower(),
            values.R4.AsVector512().GetLower(), values.R5.AsVector512().GetLower(), values.R6.AsVector512().GetLower(), values.R7.AsVector512().GetLower(),
            rows, stride, offsets, unwritten, 0);
        ScatterEight(
            values.R0.AsVector512().GetUpper(), values.R1.AsVector512().GetUpper(), values.R2.AsVector512().GetUpper(), values.R3.AsVector512().GetUpper(),
            values.R4.AsVector512().GetUpper(), values.R5.AsVector512().GetUpper(), values.R6.AsVector512().GetUpper(), values.R7.AsVector512().GetUpper(),
            rows, stride, offsets, unwritten >> Vector256<float>.Count, Vector256<float>.Count);
    }

    /// <summary>Eight lanes, or half of sixteen. Nearly all bundles write all lanes, and need no question for each.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void ScatterEight<TRows>(
        Vector256<float> r0, Vector256<float> r1, Vector256<float> r2, Vector256<float> r3,
        Vector256<float> r4, Vector256<float> r5, Vector256<float> r6, Vector256<float> r7,
        float* rows, int stride, in TRows offsets, uint unwritten, int first)
        where TRows : unmanaged, IRowPlaces<TRows>
    {
        Transpose8(ref r0, ref r1, ref r2, ref r3, ref r4, ref r5, ref r6, ref r7);
        if ((unwritten & 0xFF) == 0)
        {
            r0.StoreAligned(TRows.Row(offsets, rows, stride, first));
            r1.StoreAligned(TRows.Row(offsets, rows, stride, first + 1));
            r2.StoreAligned(TRows.Row(offsets, rows, stride, first + 2));
            r3.StoreAligned(TRows.Row(offsets, rows, stride, first + 3));
            r4.StoreAligned(TRows.Row(offsets, rows, stride, first + 4));
            r5.StoreAligned(TRows.Row(offsets, rows, stride, first + 5));
            r6.StoreAligned(TRows.Row(offsets, rows, stride, first + 6));
            r7.StoreAligned(TRows.Row(offsets, rows, stride, first + 7));
            return;
        }
        if ((unwritten & 1) == 0) r0.StoreAligned(TRows.Row(offsets, rows, stride, first));
        if ((unwritten & 2) == 0) r1.StoreAligned(TRows.Row(offsets, rows, stride, first + 1));
        if ((unwritten & 4) == 0) r2.StoreAligned(TRows.Row(offsets, rows, stride, first + 2));
        if ((unwritten & 8) == 0) r3.StoreAligned(TRows.Row(offsets, rows, stride, first + 3));
        if ((unwritten & 16) == 0) r4.StoreAligned(TRows.Row(offsets, rows, stride, first + 4));
        if ((unwritten & 32) == 0) r5.StoreAligned(TRows.Row(offsets, rows, stride, first + 5));
        if ((unwritten & 64) == 0) r6.StoreAligned(TRows.Row(offsets, rows, stride, first + 6));
        if ((unwritten & 128) == 0) r7.StoreAligned(TRows.Row(offsets, rows, stride, first + 7));
    }

    /// <summary>Four rows of four floats exchanged for four columns. Its own inverse.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void Transpose4(ref Vector128<float> r0, ref Vector128<float> r1, ref Vector128<float> r2, ref Vector128<float> r3)
    {
        var t0 = InterleaveLow(r0, r2);
        var t1 = InterleaveLow(r1, r3);
        var t2 = InterleaveHigh(r0, r2);
        var t3 = InterleaveHigh(r1, r3);
        r0 = InterleaveLow(t0, t1);
        r1 = InterleaveHigh(t0, t1);
        r2 = InterleaveLow(t2, t3);
        r3 = InterleaveHigh(t2, t3);
    }

    /// <summary>
    /// Makes the first four lanes of four points, each in the first three floats of its row. What other lanes and the fourth floats hold means nothing,
    /// but is some number of the rows or zero.
    /// </summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3Wide FourPoints(Vector128<float> r0, Vector128<float> r1, Vector128<float> r2, Vector128<float> r3)
    {
        Transpose4(ref r0, ref r1, ref r2, ref r3);
        return new(Widen(r0), Widen(r1), Widen(r2));
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<float> Widen(Vector128<float> four)
    {
        if (Vector<float>.Count == 4)
            return four.AsVector();
        return Vector<float>.Count == 8 ? four.ToVector256().AsVector() : four.ToVector256().ToVector512().AsVector();
    }

    /// <summary>a0 b0 a1 b1.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector128<float> InterleaveLow(Vector128<float> a, Vector128<float> b)
    {
        if (Sse.IsSupported)
            return Sse.UnpackLow(a, b);
        if (AdvSimd.Arm64.IsSupported)
            return AdvSimd.Arm64.ZipLow(a, b);
        return Vector128.Create(a[0], b[0], a[1], b[1]);
    }

    /// <summary>a2 b2 a3 b3.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector128<float> InterleaveHigh(Vector128<float> a, Vector128<float> b)
    {
        if (Sse.IsSupported)
            return Sse.UnpackHigh(a, b);
        if (AdvSimd.Arm64.IsSupported)
            return AdvSimd.Arm64.ZipHigh(a, b);
        return Vector128.Create(a[2], b[2], a[3], b[3]);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Rows8 Gather4<TRows>(float* rows, int stride, in TRows offsets)
        where TRows : unmanaged, IRowPlaces<TRows>
    {
        var p0 = TRows.Row(offsets, rows, stride, 0);
        var p1 = TRows.Row(offsets, rows, stride, 1);
        var p2 = TRows.Row(offsets, rows, stride, 2);
        var p3 = TRows.Row(offsets, rows, stride, 3);
        var r0 = Vector128.LoadAligned(p0);
        var r1 = Vector128.LoadAligned(p1);
        var r2 = Vector128.LoadAligned(p2);
        var r3 = Vector128.LoadAligned(p3);
        Transpose4(ref r0, ref r1, ref r2, ref r3);
        Rows8 result;
        result.R0 = r0.AsVector();
        result.R1 = r1.AsVector();
        result.R2 = r2.AsVector();
        result.R3 = r3.AsVector();
        r0 = Vector128.LoadAligned(p0 + 4);
        r1 = Vector128.LoadAligned(p1 + 4);
        r2 = Vector128.LoadAligned(p2 + 4);
        r3 = Vector128.LoadAligned(p3 + 4);
        Transpose4(ref r0, ref r1, ref r2, ref r3);
        result.R4 = r0.AsVector();
        result.R5 = r1.AsVector();
        result.R6 = r2.AsVector();
        result.R7 = r3.AsVector();
        return result;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void Scatter4<TRows>(in Rows8 values, float* rows, int stride, in TRows offsets)
        where TRows : unmanaged, IRowPlaces<TRows>
    {
        var unwritten = TRows.Unwritten(offsets);
        var r0 = values.R0.AsVector128();
        var r1 = values.R1.AsVector128();
        var r2 = values.R2.AsVector128();
        var r3 = values.R3.AsVector128();
        var r4 = values.R4.AsVector128();
        var r5 = values.R5.AsVector128();
        var r6 = values.R6.AsVector128();
        var r7 = values.R7.AsVector128();
        Transpose4(ref r0, ref r1, ref r2, ref r3);
        Transpose4(ref r4, ref r5, ref r6, ref r7);
        Store(r0, r4, rows, stride, offsets, unwritten, 0);
        Store(r1, r5, rows, stride, offsets, unwritten, 1);
        Store(r2, r6, rows, stride, offsets, unwritten, 2);
        Store(r3, r7, rows, stride, offsets, unwritten, 3);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void Store<TRows>(Vector128<float> low, Vector128<float> high, float* rows, int stride, in TRows offsets, uint unwritten, int lane)
        where TRows : unmanaged, IRowPlaces<TRows>
    {
        if ((unwritten & 1u << lane) != 0)
            return;
        var row = TRows.Row(offsets, rows, stride, lane);
        low.StoreAligned(row);
        high.StoreAligned(row + 4);
    }
}
