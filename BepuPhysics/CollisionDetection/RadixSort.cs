using System;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>The number that an element is sorted by.</summary>
interface ISortKey<T> where T : unmanaged
{
    static abstract ulong Of(in T element);
}

/// <summary>Sorts many elements by a number, stably: digit by digit, the lowest first, leaving out digits in which all agree.</summary>
/// <remarks>
/// Each element is moved once per digit, however many there are: for some thousand elements a fifth of what comparing takes. For some hundreds it is not worth
/// its tables.
/// </remarks>
static unsafe class RadixSort<T, TKey> where T : unmanaged where TKey : struct, ISortKey<T>
{
    const int DigitBits = 11;
    const int DigitCount = (64 + DigitBits - 1) / DigitBits;
    const int Base = 1 << DigitBits;

    /// <summary>For fewer elements <see cref="BepuUtilities.Collections.QuickSort"/> does without its tables.</summary>
    internal const int LeastCount = 1024;

    /// <summary>Sorts in ascending order of the keys; elements with equal keys stay in their order.</summary>
    /// <param name="elements">The elements.</param>
    /// <param name="pool">Source of memory for the time of the call.</param>
    internal static void Sort(Span<T> elements, BufferPool pool)
    {
        pool.Take<T>(Math.Max(1, elements.Length), out var room);
        pool.Take<int>(DigitCount * Base, out var counts);
        fixed (T* memory = elements)
        {
            var source = memory;
            var target = room.Memory;
            var common = CountDigits(source, elements.Length, counts);
            for (int digit = 0; digit < DigitCount; ++digit)
            {
                if ((common >> digit & 1) != 0)
                    continue;
                Move(source, target, elements.Length, digit * DigitBits, counts.Memory + digit * Base);
                var moved = target;
                target = source;
                source = moved;
            }
            if (source != memory)
                new Span<T>(source, elements.Length).CopyTo(elements);
        }
        pool.Return(ref counts);
        pool.Return(ref room);
    }

    // How often each value of each digit occurs. One bit per digit is set in the result where it is the same in all keys.
    static int CountDigits(T* elements, int count, Buffer<int> counts)
    {
        counts.Clear(0, counts.Length);
        ulong all = ulong.MaxValue, any = 0;
        for (int i = 0; i < count; ++i)
        {
            var key = TKey.Of(elements[i]);
            all &= key;
            any |= key;
            for (int digit = 0; digit < DigitCount; ++digit)
                ++counts.Memory[digit * Base + (int)(key >> digit * DigitBits & (Base - 1))];
        }
        int common = 0;
        for (int digit = 0; digit < DigitCount; ++digit)
        {
            if (((all ^ any) >> digit * DigitBits & (Base - 1)) == 0)
                common |= 1 << digit;
        }
        return common;
    }

    // Counts become places.
    static void Move(T* source, T* target, int count, int shift, int* counts)
    {
        int place = 0;
        for (int i = 0; i < Base; ++i)
        {
            var next = place + counts[i];
            counts[i] = place;
            place = next;
        }
        for (int i = 0; i < count; ++i)
            target[counts[(int)(TKey.Of(source[i]) >> shift & (Base - 1))]++] = source[i];
    }
}
