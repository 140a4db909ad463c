using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using System.Runtime.Intrinsics.X86;

namespace BepuPhysics.Constraints.Contact;

/// <summary>What is done with lanes of four numbers: elementwise, or in a fixed order, so that each CPU comes to the same bits.</summary>
static class RowLanes
{
    /// <summary>The first number in all lanes.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static Vector128<float> First(Vector128<float> value) => Vector128.Shuffle(value, Vector128.Create(0, 0, 0, 0));

    /// <summary>The second number in all lanes.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static Vector128<float> Second(Vector128<float> value) => Vector128.Shuffle(value, Vector128.Create(1, 1, 1, 1));

    /// <summary>The third number in all lanes.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static Vector128<float> Third(Vector128<float> value) => Vector128.Shuffle(value, Vector128.Create(2, 2, 2, 2));

    /// <summary>The fourth number in all lanes.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static Vector128<float> Fourth(Vector128<float> value) => Vector128.Shuffle(value, Vector128.Create(3, 3, 3, 3));

    /// <summary>Sum of all lanes: of the first two and of the last two, one after the other.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static float Sum(Vector128<float> value)
    {
        var pairs = value + Vector128.Shuffle(value, Vector128.Create(1, 0, 3, 2));
        return pairs.ToScalar() + Third(pairs).ToScalar();
    }

    /// <summary>Larger value of each lane; that of <paramref name="b"/> where either is NaN, or both are zero.</summary>
    // The instruction says just that.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static Vector128<float> Max(Vector128<float> a, Vector128<float> b) =>
        Sse.IsSupported ? Sse.Max(a, b) : Vector128.ConditionalSelect(Vector128.GreaterThan(a, b), a, b);

    /// <summary>Goes on by a share of a direction, and takes what has changed since the start into it; the next start is there.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static void Follow(ref Vector128<float> value, ref Vector128<float> start, ref Vector128<float> direction, Vector128<float> share)
    {
        var more = direction * share;
        direction = more + (value - start);
        start = value += more;
    }
}

/// <summary>Three times four lanes.</summary>
[InlineArray(3)]
struct ThreeRowLanes
{
    Vector128<float> first;
}

/// <summary>Four times four lanes.</summary>
[InlineArray(4)]
struct FourRowLanes
{
    Vector128<float> first;
}

/// <summary>Seven times four lanes.</summary>
[InlineArray(7)]
struct SevenRowLanes
{
    Vector128<float> first;
}
