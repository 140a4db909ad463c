using System;
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;

// In no namespace, so that it comes before System.Numerics.Vector<T>, which the sources import by a using directive.

/// <summary>A stand-in of 64 bytes for System.Numerics.Vector, as wide as it is on processors with vectors of 512 bits, and for any processor.</summary>
/// <remarks>
/// The libraries' sources compile against it unchanged (-p:SixteenLanes=true), so that a machine without such vectors shows
/// that sixteen lanes give the same bits. Lane for lane each operation is the framework's, of Vector512: slow where that has
/// no hardware, never different.
/// </remarks>
public readonly struct Vector<T> : IEquatable<Vector<T>>
{
    readonly Vector512<T> bits;

    Vector(Vector512<T> bits) => this.bits = bits;

    public Vector(T value) : this(Vector512.Create(value)) { }

    public Vector(ReadOnlySpan<T> values) : this(Vector512.Create(values)) { }

    public static int Count => Vector512<T>.Count;
    public static Vector<T> Zero => Vector512<T>.Zero;
    public static Vector<T> One => Vector512<T>.One;
    public static Vector<T> AllBitsSet => Vector512<T>.AllBitsSet;
    public static Vector<T> Indices => Vector512<T>.Indices;
    public T this[int lane] => bits[lane];

    public static implicit operator Vector512<T>(Vector<T> value) => value.bits;
    public static implicit operator Vector<T>(Vector512<T> bits) => new(bits);

    public static Vector<T> operator +(Vector<T> a, Vector<T> b) => a.bits + b.bits;
    public static Vector<T> operator -(Vector<T> a, Vector<T> b) => a.bits - b.bits;
    public static Vector<T> operator *(Vector<T> a, Vector<T> b) => a.bits * b.bits;
    public static Vector<T> operator *(Vector<T> a, T b) => a.bits * b;
    public static Vector<T> operator *(T a, Vector<T> b) => a * b.bits;
    public static Vector<T> operator /(Vector<T> a, Vector<T> b) => a.bits / b.bits;
    public static Vector<T> operator /(Vector<T> a, T b) => a.bits / b;
    public static Vector<T> operator -(Vector<T> a) => -a.bits;
    public static Vector<T> operator &(Vector<T> a, Vector<T> b) => a.bits & b.bits;
    public static Vector<T> operator |(Vector<T> a, Vector<T> b) => a.bits | b.bits;
    public static Vector<T> operator ^(Vector<T> a, Vector<T> b) => a.bits ^ b.bits;
    public static Vector<T> operator ~(Vector<T> a) => ~a.bits;
    public static Vector<T> operator <<(Vector<T> a, int count) => a.bits << count;
    public static Vector<T> operator >>(Vector<T> a, int count) => a.bits >> count;
    public static Vector<T> operator >>>(Vector<T> a, int count) => a.bits >>> count;
    public static bool operator ==(Vector<T> a, Vector<T> b) => a.bits == b.bits;
    public static bool operator !=(Vector<T> a, Vector<T> b) => a.bits != b.bits;

    public void CopyTo(Span<T> destination) => bits.CopyTo(destination);
    public bool Equals(Vector<T> other) => bits.Equals(other.bits);
    public override bool Equals(object? other) => other is Vector<T> vector && Equals(vector);
    public override int GetHashCode() => bits.GetHashCode();
    public override string ToString() => bits.ToString();
}

/// <summary>What the libraries ask of System.Numerics.Vector, and the views of narrower vectors that paths for other widths take.</summary>
public static class Vector
{
    public static Vector<int> LessThan(Vector<float> a, Vector<float> b) => Vector512.LessThan<float>(a, b).AsInt32();
    public static Vector<int> LessThan(Vector<int> a, Vector<int> b) => Vector512.LessThan<int>(a, b);
    public static Vector<int> LessThanOrEqual(Vector<float> a, Vector<float> b) => Vector512.LessThanOrEqual<float>(a, b).AsInt32();
    public static Vector<int> LessThanOrEqual(Vector<int> a, Vector<int> b) => Vector512.LessThanOrEqual<int>(a, b);
    public static Vector<int> GreaterThan(Vector<float> a, Vector<float> b) => Vector512.GreaterThan<float>(a, b).AsInt32();
    public static Vector<int> GreaterThan(Vector<int> a, Vector<int> b) => Vector512.GreaterThan<int>(a, b);
    public static Vector<int> GreaterThanOrEqual(Vector<float> a, Vector<float> b) => Vector512.GreaterThanOrEqual<float>(a, b).AsInt32();
    public static Vector<int> GreaterThanOrEqual(Vector<int> a, Vector<int> b) => Vector512.GreaterThanOrEqual<int>(a, b);
    public static Vector<int> Equals(Vector<float> a, Vector<float> b) => Vector512.Equals<float>(a, b).AsInt32();
    public static Vector<int> Equals(Vector<int> a, Vector<int> b) => Vector512.Equals<int>(a, b);
    public static bool EqualsAll<T>(Vector<T> a, Vector<T> b) => Vector512.EqualsAll<T>(a, b);
    public static bool EqualsAny<T>(Vector<T> a, Vector<T> b) => Vector512.EqualsAny<T>(a, b);
    public static bool LessThanAll<T>(Vector<T> a, Vector<T> b) => Vector512.LessThanAll<T>(a, b);
    public static bool LessThanAny<T>(Vector<T> a, Vector<T> b) => Vector512.LessThanAny<T>(a, b);

    public static Vector<T> ConditionalSelect<T>(Vector<T> mask, Vector<T> a, Vector<T> b) => Vector512.ConditionalSelect<T>(mask, a, b);
    public static Vector<float> ConditionalSelect(Vector<int> mask, Vector<float> a, Vector<float> b) =>
        Vector512.ConditionalSelect<float>(((Vector512<int>)mask).AsSingle(), a, b);

    public static Vector<T> AndNot<T>(Vector<T> a, Vector<T> b) => Vector512.AndNot<T>(a, b);
    public static Vector<T> OnesComplement<T>(Vector<T> a) => ~a;
    public static Vector<int> ShiftRightLogical(Vector<int> a, int count) => a >>> count;
    public static Vector<T> Abs<T>(Vector<T> a) => Vector512.Abs<T>(a);
    public static Vector<T> Max<T>(Vector<T> a, Vector<T> b) => Vector512.Max<T>(a, b);
    public static Vector<float> SquareRoot(Vector<float> a) => Vector512.Sqrt<float>(a);
    public static Vector<float> Floor(Vector<float> a) => Vector512.Floor(a);
    public static Vector<float> ConvertToSingle(Vector<int> a) => Vector512.ConvertToSingle((Vector512<int>)a);
    public static Vector<int> ConvertToInt32(Vector<float> a) => Vector512.ConvertToInt32(a);
    public static Vector<int> ConvertToInt32Native(Vector<float> a) => Vector512.ConvertToInt32Native(a);
    public static Vector<int> AsVectorInt32(Vector<float> a) => ((Vector512<float>)a).AsInt32();
    public static Vector<float> AsVectorSingle(Vector<int> a) => ((Vector512<int>)a).AsSingle();

    public static T ToScalar<T>(this Vector<T> a) => a[0];
    public static Vector<T> WithElement<T>(this Vector<T> a, int lane, T value) => a.AsVector512().WithElement(lane, value);
    public static Vector512<T> AsVector512<T>(this Vector<T> a) => a;
    public static Vector<T> AsVector<T>(this Vector512<T> a) => a;

    // For paths that are compiled and never taken with sixteen lanes.
    public static Vector256<T> AsVector256<T>(this Vector<T> a) => a.AsVector512().GetLower();
    public static Vector128<T> AsVector128<T>(this Vector<T> a) => a.AsVector256().GetLower();
    public static Vector<T> AsVector<T>(this Vector256<T> a) => a.ToVector512();
    public static Vector<T> AsVector<T>(this Vector128<T> a) => a.ToVector256().AsVector();
}
