using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using System.Runtime.Intrinsics.X86;

namespace BepuUtilities;

/// <summary>Lane-wise scalar helpers whose results are identical on every CPU and for every vector width.</summary>
public static partial class Wide
{
    // Where a CPU has an instruction with exactly the result of compare and select, that is used: x86's maximum and minimum return the second
    // operand for NaN and for two zeros, as the comparison does. (Vector.Max follows IEEE 754:2019 and costs seven instructions there.)

    /// <summary>Larger of two values per lane; <paramref name="b"/> when either is NaN or both are zeros of any sign.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector<float> Max(Vector<float> a, Vector<float> b)
    {
        if (Vector<float>.Count == 8 && Avx.IsSupported)
            return Avx.Max(a.AsVector256(), b.AsVector256()).AsVector();
        if (Vector<float>.Count == 4 && Sse.IsSupported)
            return Sse.Max(a.AsVector128(), b.AsVector128()).AsVector();
        return Vector.ConditionalSelect(Vector.GreaterThan(a, b), a, b);
    }

    /// <summary>Smaller of two values per lane; <paramref name="b"/> when either is NaN or both are zeros of any sign.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector<float> Min(Vector<float> a, Vector<float> b)
    {
        if (Vector<float>.Count == 8 && Avx.IsSupported)
            return Avx.Min(a.AsVector256(), b.AsVector256()).AsVector();
        if (Vector<float>.Count == 4 && Sse.IsSupported)
            return Sse.Min(a.AsVector128(), b.AsVector128()).AsVector();
        return Vector.ConditionalSelect(Vector.LessThan(a, b), a, b);
    }

    /// <summary>Larger of two integers per lane.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector<int> Max(Vector<int> a, Vector<int> b) => Vector.ConditionalSelect(Vector.GreaterThan(a, b), a, b);

    /// <summary>Smaller of two integers per lane.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector<int> Min(Vector<int> a, Vector<int> b) => Vector.ConditionalSelect(Vector.LessThan(a, b), a, b);

    /// <summary>Limits a value to an interval per lane; NaN stays NaN.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector<float> Clamp(Vector<float> value, Vector<float> minimum, Vector<float> maximum) => Min(maximum, Max(minimum, value));

    /// <summary>Value without its sign, per lane.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector<float> Abs(Vector<float> value) => Vector.Abs(value);

    /// <summary>Picks <paramref name="a"/> where the mask is set, <paramref name="b"/> elsewhere; each mask lane is all ones or zero.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    // A mask that is used more than once makes the JIT choose three bitwise instructions for Vector.ConditionalSelect; the blend is one.
    public static Vector<float> Select(Vector<int> mask, Vector<float> a, Vector<float> b) => Vector<float>.Count == 8 && Avx.IsSupported
        ? Avx.BlendVariable(b.AsVector256(), a.AsVector256(), mask.AsVector256().AsSingle()).AsVector()
        : Vector.ConditionalSelect(mask, a, b);

    /// <summary>Picks <paramref name="a"/> where the mask is set, <paramref name="b"/> elsewhere; each mask lane is all ones or zero.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector<int> Select(Vector<int> mask, Vector<int> a, Vector<int> b) => Vector.ConditionalSelect(mask, a, b);

    /// <summary>Keeps the value where the mask is set, zero elsewhere.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector<float> Mask(Vector<int> mask, Vector<float> value) => Vector.AsVectorSingle(mask & Vector.AsVectorInt32(value));

    /// <summary>Magnitude of the first operand with the sign bit of the second.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector<float> CopySign(Vector<float> magnitude, Vector<float> sign)
    {
        var signBit = new Vector<int>(int.MinValue);
        return Vector.AsVectorSingle(
            Vector.AndNot(Vector.AsVectorInt32(magnitude), signBit) | (Vector.AsVectorInt32(sign) & signBit));
    }

    /// <summary>1 where the value is positive or zero, -1 where it is negative (by comparison: -0 counts as zero).</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector<float> Sign(Vector<float> value) =>
        Vector.ConditionalSelect(Vector.LessThan(value, Vector<float>.Zero), new Vector<float>(-1f), Vector<float>.One);

    /// <summary>Quotient, or zero where the divisor is zero (of any sign); overflow still gives infinity.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector<float> DivideOrZero(Vector<float> dividend, Vector<float> divisor) =>
        Mask(~Vector.Equals(divisor, Vector<float>.Zero), dividend / divisor);

    /// <summary>Square root; zero where the value is negative.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector<float> SquareRootOrZero(Vector<float> value) => Vector.SquareRoot(Max(Vector<float>.Zero, value));

    /// <summary>
    /// The power of two that brings a positive value into [1, 2): exact to multiply with. 2^127 for zero and subnormal values.
    /// </summary>
    // Matrices are scaled by it before they are inverted: the determinant of the inverse inertia of a 0.5 mm cube overflows a float,
    // that of a 1 km cube underflows. Two integer instructions, and no rounding in between.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static Vector<float> NormalizingPowerOfTwo(Vector<float> value) =>
        Vector.AsVectorSingle(new Vector<int>(254 << 23) - (Vector.AsVectorInt32(value) & new Vector<int>(0xFF << 23)));

    /// <summary>The greatest of all lanes, in all lanes. Of zeros of both signs either may be it.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector<float> SpreadGreatest(Vector<float> v)
    {
        if (Vector<float>.Count == 8)
        {
            var all = v.AsVector256();
            v = Max(v, Vector256.Create(all.GetUpper(), all.GetLower()).AsVector());
            v = Max(v, Vector256.Shuffle(v.AsVector256(), Vector256.Create(2, 3, 0, 1, 6, 7, 4, 5)).AsVector());
            return Max(v, Vector256.Shuffle(v.AsVector256(), Vector256.Create(1, 0, 3, 2, 5, 4, 7, 6)).AsVector());
        }
        if (Vector<float>.Count == 4)
        {
            v = Max(v, Vector128.Shuffle(v.AsVector128(), Vector128.Create(2, 3, 0, 1)).AsVector());
            return Max(v, Vector128.Shuffle(v.AsVector128(), Vector128.Create(1, 0, 3, 2)).AsVector());
        }
        var greatest = v[0];
        for (int i = 1; i < Vector<float>.Count; ++i)
            greatest = v[i] > greatest ? v[i] : greatest;
        return new(greatest);
    }

    /// <summary>One lane in all lanes.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector<float> Broadcast(in Vector<float> vector, int lane) => new(GatherScatter.Get(ref Unsafe.AsRef(in vector), lane));

    /// <summary>The lane with the greatest value; of equally great ones that with the least number, and of these the first. Lane 0 for NaN.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static int LaneOfGreatest(Vector<float> values, Vector<int> numbers)
    {
        var bits = Bits(Vector.Equals(values, SpreadGreatest(values)));
        if (bits == 0)
            return 0;
        var lane = BitOperations.TrailingZeroCount(bits);
        for (bits &= bits - 1; bits != 0; bits &= bits - 1)
        {
            var other = BitOperations.TrailingZeroCount(bits);
            if (GatherScatter.Get(ref numbers, other) < GatherScatter.Get(ref numbers, lane))
                lane = other;
        }
        return lane;
    }

    /// <summary>A bit for each lane that is negative, as those of a mask are that are set; lane 0 the lowest.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static uint Bits(Vector<int> mask)
    {
        if (Vector<int>.Count == 16)
            return (uint)mask.AsVector512().ExtractMostSignificantBits();
        if (Vector<int>.Count == 8)
            return mask.AsVector256().ExtractMostSignificantBits();
        if (Vector<int>.Count == 4)
            return mask.AsVector128().ExtractMostSignificantBits();
        uint bits = 0;
        for (int i = 0; i < Vector<int>.Count; ++i)
            bits |= mask[i] < 0 ? 1u << i : 0;
        return bits;
    }
}
