using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using System.Runtime.Intrinsics.X86;
using BepuUtilities;

namespace BepuPhysics.Trees;

/// <summary>
/// Boxes as pairs of four-lane vectors. The fourth lane of a <see cref="NodeChild"/> holds integers, whose bits may be any float:
/// comparisons of it are masked off and selects of it are overwritten, so it never shows.
/// </summary>
static unsafe class BoxMath
{
    const uint CornerMask = 7;

    /// <summary>All bits set in the lanes of a corner, none in the fourth.</summary>
    public static Vector128<float> CornerLanes
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => Vector128.Create(-1, -1, -1, 0).AsSingle();
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector128<float> LoadMin(NodeChild* child) => Vector128.Load((float*)child);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector128<float> LoadMax(NodeChild* child) => Vector128.Load((float*)child + 4);

    // Compare and select: minimum instructions differ between processors for zeros of unlike sign and for what is no number. That of x86 is defined as
    // this selection.
    /// <summary>The lesser, number by number; the second of two that are alike, or of which one is no number.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector128<float> Min(Vector128<float> a, Vector128<float> b) =>
        Sse.IsSupported ? Sse.Min(a, b) : Vector128.ConditionalSelect(Vector128.LessThan(a, b), a, b);

    /// <summary>The greater, number by number; the second of two that are alike, or of which one is no number.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector128<float> Max(Vector128<float> a, Vector128<float> b) =>
        Sse.IsSupported ? Sse.Max(a, b) : Vector128.ConditionalSelect(Vector128.GreaterThan(a, b), a, b);

    /// <inheritdoc cref="Min(Vector128{float}, Vector128{float})"/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector256<float> Min(Vector256<float> a, Vector256<float> b) =>
        Avx.IsSupported ? Avx.Min(a, b) : Vector256.ConditionalSelect(Vector256.LessThan(a, b), a, b);

    /// <inheritdoc cref="Max(Vector128{float}, Vector128{float})"/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector256<float> Max(Vector256<float> a, Vector256<float> b) =>
        Avx.IsSupported ? Avx.Max(a, b) : Vector256.ConditionalSelect(Vector256.GreaterThan(a, b), a, b);

    /// <summary>Writes a box and leaves the index and the leaf count beside it alone.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void StoreBox(NodeChild* child, Vector128<float> min, Vector128<float> max)
    {
        Vector128.ConditionalSelect(CornerLanes, min, LoadMin(child)).Store((float*)child);
        Vector128.ConditionalSelect(CornerLanes, max, LoadMax(child)).Store((float*)child + 4);
    }

    /// <summary>Writes a whole child.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Store(NodeChild* child, Vector128<float> min, Vector128<float> max, int index, int leafCount)
    {
        min.AsInt32().WithElement(3, index).Store((int*)child);
        max.AsInt32().WithElement(3, leafCount).Store((int*)child + 4);
    }

    /// <summary>Whether two boxes overlap; boxes that only touch do.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static bool Overlaps(Vector128<float> minA, Vector128<float> maxA, Vector128<float> minB, Vector128<float> maxB)
    {
        var separate = Vector128.GreaterThan(minA, maxB) | Vector128.GreaterThan(minB, maxA);
        return (separate.ExtractMostSignificantBits() & CornerMask) == 0;
    }

    /// <summary>Half the surface of a box: how likely a random ray or small box meets it. Zero for points and axis-aligned lines.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static float HalfArea(Vector128<float> min, Vector128<float> max)
    {
        var size = max - min;
        var x = size.GetElement(0);
        var y = size.GetElement(1);
        var z = size.GetElement(2);
        return x * y + (y * z + z * x);
    }

    /// <summary>Half the surface of the box around two boxes.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static float UnionHalfArea(NodeChild* a, NodeChild* b) =>
        HalfArea(Min(LoadMin(a), LoadMin(b)), Max(LoadMax(a), LoadMax(b)));

    /// <summary>Half the surface of a child's box.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static float HalfArea(NodeChild* child) => HalfArea(LoadMin(child), LoadMax(child));

    /// <summary>Whether a box is finite and its lower corner is nowhere above its upper one.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static bool IsValid(Vector3 min, Vector3 max)
    {
        var lower = min.AsVector128();
        var upper = max.AsVector128();
        var good = Vector128.LessThanOrEqual(lower, upper)
            & Vector128.GreaterThanOrEqual(lower, Vector128.Create(-float.MaxValue))
            & Vector128.LessThanOrEqual(upper, Vector128.Create(float.MaxValue));
        return (good.ExtractMostSignificantBits() & CornerMask) == CornerMask;
    }

    /// <summary>Refuses a box that is not finite or is inside out.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void RequireBox(Vector3 min, Vector3 max)
    {
        if (!IsValid(min, max))
            ThrowBox(min, max);
    }

    /// <summary>Refuses a vector that is not finite.</summary>
    public static void RequireFinite(Vector3 value, [CallerArgumentExpression(nameof(value))] string name = "")
    {
        if (!IsValid(value, value))
            throw new ArgumentException($"Every component must be finite, was {value}.", name);
    }

    /// <summary>Refuses a length of a ray that is negative or not a number; infinity is allowed.</summary>
    public static void RequireLength(float value, [CallerArgumentExpression(nameof(value))] string name = "")
    {
        if (!(value >= 0))
            throw new ArgumentOutOfRangeException(name, value, "Must be zero or more.");
    }

    static void ThrowBox(Vector3 min, Vector3 max) =>
        throw new ArgumentException($"A box must be finite with min <= max on every axis, was min {min}, max {max}.");

    /// <summary>Of coordinates and ways: beyond what boxes lose that are moved or widened.</summary>
    public const float ReachRounding = 4e-6f;

    /// <summary>Length of the longest side of a box.</summary>
    public static float GreatestExtent(Vector128<float> min, Vector128<float> max)
    {
        var extent = max - min;
        return MathHelper.Max(extent[0], MathHelper.Max(extent[1], extent[2]));
    }
}
