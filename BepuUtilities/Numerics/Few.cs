using System.Diagnostics.CodeAnalysis;
using System.Runtime.CompilerServices;

namespace BepuUtilities;

/// <summary>An array of one to four elements whose length is part of its type, so the JIT sees it as a constant.</summary>
public interface IFew<T> where T : unmanaged
{
    /// <summary>Number of elements.</summary>
    static abstract int Count { get; }

    /// <summary>Element by index, without a bounds check.</summary>
    [UnscopedRef]
    ref T this[int index] { get; }
}

/// <summary>One element.</summary>
[InlineArray(1)]
public struct Few1<T> : IFew<T> where T : unmanaged
{
    T first;

    /// <inheritdoc/>
    public static int Count => 1;

    [UnscopedRef]
    ref T IFew<T>.this[int index]
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => ref Unsafe.Add(ref first, index);
    }
}

/// <summary>Two elements.</summary>
[InlineArray(2)]
public struct Few2<T> : IFew<T> where T : unmanaged
{
    T first;

    /// <inheritdoc/>
    public static int Count => 2;

    [UnscopedRef]
    ref T IFew<T>.this[int index]
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => ref Unsafe.Add(ref first, index);
    }
}

/// <summary>Three elements.</summary>
[InlineArray(3)]
public struct Few3<T> : IFew<T> where T : unmanaged
{
    T first;

    /// <inheritdoc/>
    public static int Count => 3;

    [UnscopedRef]
    ref T IFew<T>.this[int index]
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => ref Unsafe.Add(ref first, index);
    }
}

/// <summary>Four elements.</summary>
[InlineArray(4)]
public struct Few4<T> : IFew<T> where T : unmanaged
{
    T first;

    /// <inheritdoc/>
    public static int Count => 4;

    [UnscopedRef]
    ref T IFew<T>.this[int index]
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => ref Unsafe.Add(ref first, index);
    }
}
