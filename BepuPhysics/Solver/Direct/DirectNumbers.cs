using System;
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using System.Runtime.Intrinsics.X86;

namespace BepuPhysics.Constraints;

/// <summary>A number of double precision for each of some equal structures that are solved side by side, each in a lane.</summary>
// The equations are written once, over one structure or several. What a lane gets is the same bits either way: the same operations in the same order, and
// what one structure leaves out a lane leaves as it is.
interface INumbers<T> where T : unmanaged, INumbers<T>
{
    /// <summary>Number of structures.</summary>
    static abstract int Count { get; }

    /// <summary>A mask of all.</summary>
    static abstract T All { get; }

    /// <summary>The same number for each.</summary>
    static abstract T Of(double value);

    /// <summary>Numbers that lie side by side.</summary>
    static abstract T Read(ref double first);

    /// <summary>Numbers of single precision that lie side by side.</summary>
    static abstract T Read(ref float first);

    /// <summary>Writes them side by side, in single precision.</summary>
    void Write(ref float first);

    /// <summary>Sums.</summary>
    static abstract T operator +(T a, T b);

    /// <summary>Differences.</summary>
    static abstract T operator -(T a, T b);

    /// <summary>Products.</summary>
    static abstract T operator *(T a, T b);

    /// <summary>Quotients.</summary>
    static abstract T operator /(T a, T b);

    /// <summary>Square roots.</summary>
    static abstract T Root(T value);

    /// <summary>Mask of those above others.</summary>
    static abstract T Above(T a, T b);

    /// <summary>Mask of those that are at most others.</summary>
    static abstract T AtMost(T a, T b);

    /// <summary>Those of a mask that are of another, too.</summary>
    static abstract T operator &(T a, T b);

    /// <summary>Those of either of two masks.</summary>
    static abstract T operator |(T a, T b);

    /// <summary>Those that are not of a mask.</summary>
    static abstract T operator ~(T mask);

    /// <summary>A mask as bits.</summary>
    static abstract int Bits(T mask);

    /// <summary>Whether a mask has any.</summary>
    static virtual bool Any(T mask) => T.Bits(mask) != 0;

    /// <summary>Numbers where a mask is set, others where not. One structure alone is not asked where its mask is not set.</summary>
    static abstract T Choose(T mask, T set, T others);
}

/// <summary>A vector in space for each of these structures.</summary>
interface IVectors<T, TNumbers> where T : unmanaged, IVectors<T, TNumbers> where TNumbers : unmanaged, INumbers<TNumbers>
{
    /// <summary>How many numbers one component of a lane lies before the next.</summary>
    static abstract int Stride { get; }

    /// <summary>Sums.</summary>
    static abstract T operator +(T a, T b);

    /// <summary>Products, component by component.</summary>
    static abstract T operator *(T a, T b);

    /// <summary>Multiples.</summary>
    static abstract T operator *(T vector, TNumbers factor);

    /// <summary>Sum of the components, always in this order: x + y + (z + 0).</summary>
    static abstract TNumbers Sum(T vector);

    /// <summary>Sums of the components of two vectors, in that order.</summary>
    static abstract (TNumbers A, TNumbers B) Sums(T a, T b);

    /// <summary>Vectors where a mask is set, others where not. One structure alone is not asked where its mask is not set.</summary>
    static abstract T Choose(TNumbers mask, T set, T others);

    /// <summary>Component.</summary>
    TNumbers X { get; }

    /// <summary>Component.</summary>
    TNumbers Y { get; }

    /// <summary>Component.</summary>
    TNumbers Z { get; }
}

/// <summary>The number of one structure alone.</summary>
readonly struct OneNumber(double value) : INumbers<OneNumber>
{
    readonly double value = value;

    public static int Count => 1;

    // All bits set are no number, but a mask.

    public static OneNumber All => new(BitConverter.Int64BitsToDouble(-1));

    public static OneNumber Of(double value) => new(value);

    public static OneNumber Read(ref double first) => new(first);

    public static OneNumber Read(ref float first) => new(first);

    public void Write(ref float first) => first = (float)value;

    public static OneNumber operator +(OneNumber a, OneNumber b) => new(a.value + b.value);

    public static OneNumber operator -(OneNumber a, OneNumber b) => new(a.value - b.value);

    public static OneNumber operator *(OneNumber a, OneNumber b) => new(a.value * b.value);

    public static OneNumber operator /(OneNumber a, OneNumber b) => new(a.value / b.value);

    public static OneNumber Root(OneNumber value) => new(Math.Sqrt(value.value));

    public static OneNumber Above(OneNumber a, OneNumber b) => a.value > b.value ? All : default;

    public static OneNumber AtMost(OneNumber a, OneNumber b) => a.value <= b.value ? All : default;

    public static OneNumber operator &(OneNumber a, OneNumber b) => new(BitConverter.Int64BitsToDouble(a.Mask & b.Mask));

    public static OneNumber operator |(OneNumber a, OneNumber b) => new(BitConverter.Int64BitsToDouble(a.Mask | b.Mask));

    public static OneNumber operator ~(OneNumber mask) => new(BitConverter.Int64BitsToDouble(~mask.Mask));

    public static int Bits(OneNumber mask) => mask.Mask != 0 ? 1 : 0;

    public static OneNumber Choose(OneNumber mask, OneNumber set, OneNumber others) => set;

    long Mask => BitConverter.DoubleToInt64Bits(value);
}

/// <summary>The numbers of four structures side by side.</summary>
readonly struct FourNumbers(Vector256<double> values) : INumbers<FourNumbers>
{
    readonly Vector256<double> values = values;

    public static int Count => Vector256<double>.Count;

    public static FourNumbers All => new(Vector256<double>.AllBitsSet);

    public static FourNumbers Of(double value) => new(Vector256.Create(value));

    public static FourNumbers Read(ref double first) => new(Vector256.LoadUnsafe(ref first));

    public static FourNumbers Read(ref float first) => new(Vector256.WidenLower(Vector128.LoadUnsafe(ref first).ToVector256Unsafe()));

    public void Write(ref float first) => Vector128.Narrow(values.GetLower(), values.GetUpper()).StoreUnsafe(ref first);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static FourNumbers operator +(FourNumbers a, FourNumbers b) => new(a.values + b.values);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static FourNumbers operator -(FourNumbers a, FourNumbers b) => new(a.values - b.values);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static FourNumbers operator *(FourNumbers a, FourNumbers b) => new(a.values * b.values);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static FourNumbers operator /(FourNumbers a, FourNumbers b) => new(a.values / b.values);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static FourNumbers Root(FourNumbers value) => new(Vector256.Sqrt(value.values));

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static FourNumbers Above(FourNumbers a, FourNumbers b) => new(Vector256.GreaterThan(a.values, b.values));

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static FourNumbers AtMost(FourNumbers a, FourNumbers b) => new(Vector256.LessThanOrEqual(a.values, b.values));

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static FourNumbers operator &(FourNumbers a, FourNumbers b) => new(a.values & b.values);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static FourNumbers operator |(FourNumbers a, FourNumbers b) => new(a.values | b.values);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static FourNumbers operator ~(FourNumbers mask) => new(~mask.values);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static int Bits(FourNumbers mask) => (int)mask.values.ExtractMostSignificantBits();

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static FourNumbers Choose(FourNumbers mask, FourNumbers set, FourNumbers others) =>
        new(Vector256.ConditionalSelect(mask.values, set.values, others.values));
}

/// <summary>The numbers of eight structures side by side.</summary>
readonly struct EightNumbers(Vector512<double> values) : INumbers<EightNumbers>
{
    readonly Vector512<double> values = values;

    public static int Count => Vector512<double>.Count;

    public static EightNumbers All => new(Vector512<double>.AllBitsSet);

    public static EightNumbers Of(double value) => new(Vector512.Create(value));

    public static EightNumbers Read(ref double first) => new(Vector512.LoadUnsafe(ref first));

    public static EightNumbers Read(ref float first) => new(Vector512.WidenLower(Vector256.LoadUnsafe(ref first).ToVector512Unsafe()));

    public void Write(ref float first) => Vector256.Narrow(values.GetLower(), values.GetUpper()).StoreUnsafe(ref first);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static EightNumbers operator +(EightNumbers a, EightNumbers b) => new(a.values + b.values);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static EightNumbers operator -(EightNumbers a, EightNumbers b) => new(a.values - b.values);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static EightNumbers operator *(EightNumbers a, EightNumbers b) => new(a.values * b.values);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static EightNumbers operator /(EightNumbers a, EightNumbers b) => new(a.values / b.values);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static EightNumbers Root(EightNumbers value) => new(Vector512.Sqrt(value.values));

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static EightNumbers Above(EightNumbers a, EightNumbers b) => new(Vector512.GreaterThan(a.values, b.values));

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static EightNumbers AtMost(EightNumbers a, EightNumbers b) => new(Vector512.LessThanOrEqual(a.values, b.values));

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static EightNumbers operator &(EightNumbers a, EightNumbers b) => new(a.values & b.values);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static EightNumbers operator |(EightNumbers a, EightNumbers b) => new(a.values | b.values);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static EightNumbers operator ~(EightNumbers mask) => new(~mask.values);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static int Bits(EightNumbers mask) => (int)mask.values.ExtractMostSignificantBits();

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static EightNumbers Choose(EightNumbers mask, EightNumbers set, EightNumbers others) =>
        new(Vector512.ConditionalSelect(mask.values, set.values, others.values));
}

/// <summary>The vector of one structure alone; the fourth number is zero.</summary>
readonly struct OneVector(Vector256<double> components) : IVectors<OneVector, OneNumber>
{
    readonly Vector256<double> components = components;

    public static int Stride => 1;

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static OneVector operator +(OneVector a, OneVector b) => new(a.components + b.components);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static OneVector operator *(OneVector a, OneVector b) => new(a.components * b.components);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static OneVector operator *(OneVector vector, OneNumber factor) => new(vector.components * Unsafe.BitCast<OneNumber, double>(factor));

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static OneNumber Sum(OneVector vector) => new(
        vector.components[0] + vector.components[1] + (vector.components[2] + vector.components[3]));

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static (OneNumber A, OneNumber B) Sums(OneVector a, OneVector b)
    {
        if (!Avx.IsSupported)
            return (Sum(a), Sum(b));
        var halves = Avx.HorizontalAdd(a.components, b.components);
        var sums = halves.GetLower() + halves.GetUpper();
        return (new(sums[0]), new(sums[1]));
    }

    public static OneVector Choose(OneNumber mask, OneVector set, OneVector others) => set;

    public OneNumber X => new(components[0]);

    public OneNumber Y => new(components[1]);

    public OneNumber Z => new(components[2]);
}

/// <summary>The vectors of several structures.</summary>
readonly struct ManyVectors<TNumbers>(TNumbers x, TNumbers y, TNumbers z) : IVectors<ManyVectors<TNumbers>, TNumbers>
    where TNumbers : unmanaged, INumbers<TNumbers>
{
    readonly TNumbers x = x;
    readonly TNumbers y = y;
    readonly TNumbers z = z;

    public static int Stride => TNumbers.Count;

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static ManyVectors<TNumbers> operator +(ManyVectors<TNumbers> a, ManyVectors<TNumbers> b) => new(a.x + b.x, a.y + b.y, a.z + b.z);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static ManyVectors<TNumbers> operator *(ManyVectors<TNumbers> a, ManyVectors<TNumbers> b) => new(a.x * b.x, a.y * b.y, a.z * b.z);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static ManyVectors<TNumbers> operator *(ManyVectors<TNumbers> vector, TNumbers factor) =>
        new(vector.x * factor, vector.y * factor, vector.z * factor);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static TNumbers Sum(ManyVectors<TNumbers> vector) => vector.x + vector.y + (vector.z + default(TNumbers));

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static (TNumbers A, TNumbers B) Sums(ManyVectors<TNumbers> a, ManyVectors<TNumbers> b) => (Sum(a), Sum(b));

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static ManyVectors<TNumbers> Choose(TNumbers mask, ManyVectors<TNumbers> set, ManyVectors<TNumbers> others) => new(
        TNumbers.Choose(mask, set.x, others.x), TNumbers.Choose(mask, set.y, others.y), TNumbers.Choose(mask, set.z, others.z));

    public TNumbers X => x;

    public TNumbers Y => y;

    public TNumbers Z => z;
}
