using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;

namespace BepuPhysics.Constraints.Contact;

/// <summary>A number for each row of a patch of a column, and one that is not used; elementwise.</summary>
readonly unsafe struct RowDoubles(Vector256<double> first, Vector256<double> last)
{
    /// <summary>Numbers of it.</summary>
    internal const int Count = 8;

    readonly Vector256<double> first = first, last = last;

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static RowDoubles Load(double* numbers) => new(Vector256.Load(numbers), Vector256.Load(numbers + 4));

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal void Store(double* numbers)
    {
        first.Store(numbers);
        last.Store(numbers + 4);
    }

    /// <summary>All bits set for each row of which the bit is set.</summary>
    internal static RowDoubles Mask(int rows)
    {
        var bits = Vector256.Create((long)rows);
        Vector256<long> low = Vector256.Create(1L, 2, 4, 8), high = Vector256.Create(16L, 32, 64, 128);
        return new(Vector256.Equals(bits & low, low).AsDouble(), Vector256.Equals(bits & high, high).AsDouble());
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static RowDoubles operator +(in RowDoubles a, in RowDoubles b) => new(a.first + b.first, a.last + b.last);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static RowDoubles operator -(in RowDoubles a, in RowDoubles b) => new(a.first - b.first, a.last - b.last);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static RowDoubles operator -(in RowDoubles a) => new(-a.first, -a.last);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static RowDoubles operator *(in RowDoubles a, double b) => new(a.first * Vector256.Create(b), a.last * Vector256.Create(b));

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static RowDoubles operator &(in RowDoubles a, in RowDoubles b) => new(a.first & b.first, a.last & b.last);
}
