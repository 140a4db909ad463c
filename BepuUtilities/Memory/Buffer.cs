using System;
using System.Runtime.CompilerServices;
using BepuUtilities.Diagnostics;

namespace BepuUtilities.Memory;

/// <summary>
/// A view of unmanaged memory: a pointer, a length, and the id under which a pool lent it. Copies of a buffer look at the
/// same memory; exactly one of them is to be returned. Element access is checked in validating builds only.
/// </summary>
public unsafe partial struct Buffer<T> where T : unmanaged
{
    /// <summary>First element, or null when there is no memory.</summary>
    public T* Memory;
    /// <summary>Number of elements.</summary>
    public int Length;
    /// <summary>Id of the block within the pool that lent it; -1 when no pool did.</summary>
    public int Id;

    /// <summary>Wraps memory that stays where it is for as long as the buffer is used.</summary>
    /// <param name="memory">First element.</param>
    /// <param name="length">Number of elements.</param>
    /// <param name="id">Id of the block within its pool; -1 when no pool lent it.</param>
    public Buffer(void* memory, int length, int id = -1)
    {
        ArgumentOutOfRangeException.ThrowIfNegative(length);
        Memory = (T*)memory;
        Length = length;
        Id = id;
    }

    /// <summary>Takes a buffer of exactly the given length from a pool.</summary>
    public Buffer(int length, IUnmanagedMemoryPool pool)
    {
        ArgumentNullException.ThrowIfNull(pool);
        pool.Take(length, out this);
    }

    /// <summary>Whether there is memory behind the buffer.</summary>
    public readonly bool Allocated
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => Memory != null;
    }

    /// <summary>Element at an index in [0, Length).</summary>
    public readonly ref T this[int index]
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get
        {
            Check.That((uint)index < (uint)Length);
            // Widening as unsigned spares the sign extension; a negative index is out of range anyway.
            return ref Memory[(uint)index];
        }
    }

    /// <summary>Element at an index in [0, Length).</summary>
    public readonly ref T this[uint index]
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get
        {
            Check.That(index < (uint)Length);
            return ref Memory[index];
        }
    }

    /// <summary>Element at an index that may be counted from the end: <c>buffer[^1]</c> is the last one.</summary>
    public readonly ref T this[Index index]
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => ref this[index.GetOffset(Length)];
    }

    /// <summary>View of a part of the buffer, <c>buffer[2..5]</c> or <c>buffer[..count]</c>; it keeps the id of the whole.</summary>
    public readonly Buffer<T> this[Range range]
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get
        {
            var start = range.Start.GetOffset(Length);
            return Slice(start, range.End.GetOffset(Length) - start);
        }
    }

    /// <summary>Address of the element at an index in [0, Length).</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly T* GetPointer(int index)
    {
        Check.That((uint)index < (uint)Length);
        return Memory + (uint)index;
    }

    /// <summary>View of a part of the buffer; it keeps the id of the whole.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly Buffer<T> Slice(int start, int count)
    {
        Check.That(start >= 0 && count >= 0 && start <= Length - count);
        Buffer<T> slice;
        slice.Memory = Memory + (uint)start;
        slice.Length = count;
        slice.Id = Id;
        return slice;
    }

    /// <summary>View of the first elements of the buffer; it keeps the id of the whole.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly Buffer<T> Slice(int count) => Slice(0, count);

    /// <summary>View of a part of the buffer; it keeps the id of the whole.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly void Slice(int start, int count, out Buffer<T> sliced) => sliced = Slice(start, count);

    /// <summary>View of the first elements of the buffer; it keeps the id of the whole.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly void Slice(int count, out Buffer<T> sliced) => sliced = Slice(0, count);

    /// <summary>The same bytes as elements of another type; bytes at the end that fill no element are left out.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly Buffer<TCast> As<TCast>() where TCast : unmanaged
    {
        var count = (long)Length * sizeof(T) / sizeof(TCast);
        Check.That(count <= int.MaxValue);
        Buffer<TCast> cast;
        cast.Memory = (TCast*)Memory;
        cast.Length = (int)count;
        cast.Id = Id;
        return cast;
    }

    /// <summary>Gives the memory back to the pool that lent it and resets this variable.</summary>
    public void Dispose(IUnmanagedMemoryPool pool)
    {
        ArgumentNullException.ThrowIfNull(pool);
        PoolCalls.Return(pool, ref this);
    }

    /// <summary>The elements as a span.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly Span<T> AsSpan() => new(Memory, Length);

    /// <summary>The elements as a span.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static implicit operator Span<T>(in Buffer<T> buffer) => new(buffer.Memory, buffer.Length);

    /// <summary>The elements as a read-only span.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static implicit operator ReadOnlySpan<T>(in Buffer<T> buffer) => new(buffer.Memory, buffer.Length);

    /// <inheritdoc/>
    public override readonly string ToString() => Allocated ? $"{typeof(T).Name}[{Length}], id {Id}" : "no memory";
}
