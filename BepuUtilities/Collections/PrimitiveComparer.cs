using System;
using System.Collections.Generic;
using System.Runtime.CompilerServices;

namespace BepuUtilities.Collections;

/// <summary>
/// Equality and hash of numbers, enumerations and handles. Integers and enumerations of up to eight bytes hash to their own bits,
/// the same on every machine; other types use their own <see cref="IEquatable{T}"/> and hash.
/// </summary>
public struct PrimitiveComparer<T> : IEqualityComparerRef<T> where T : unmanaged
{
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly int Hash(ref T item)
    {
        // The conditions are constants to the JIT: one branch is left.
        if (!IsBits)
            return EqualityComparer<T>.Default.GetHashCode(item);
        if (Unsafe.SizeOf<T>() == 1)
            return Unsafe.As<T, byte>(ref item);
        if (Unsafe.SizeOf<T>() == 2)
            return Unsafe.As<T, ushort>(ref item);
        if (Unsafe.SizeOf<T>() == 4)
            return Unsafe.As<T, int>(ref item);
        var bits = Unsafe.As<T, ulong>(ref item);
        return (int)(bits ^ (bits >> 32));
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly bool Equals(ref T a, ref T b) => EqualityComparer<T>.Default.Equals(a, b);

    static bool IsBits
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => typeof(T).IsEnum || typeof(T) == typeof(byte) || typeof(T) == typeof(sbyte) || typeof(T) == typeof(short) ||
            typeof(T) == typeof(ushort) || typeof(T) == typeof(char) || typeof(T) == typeof(bool) || typeof(T) == typeof(int) ||
            typeof(T) == typeof(uint) || typeof(T) == typeof(long) || typeof(T) == typeof(ulong);
    }
}
