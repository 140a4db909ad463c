using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using System.Runtime.Intrinsics.X86;
using BepuUtilities;

namespace BepuPhysics.Trees;

/// <summary>
/// When a moving box meets boxes at rest; a ray is a moving box without size. On each axis the query touches a box from t = (min - upper)
/// / d to
/// t = (max - lower) / d, and on all of them at once from the latest beginning to the earliest end.
/// </summary>
/// <remarks>
/// Where the direction has no component, or a denormal one, its reciprocal is the largest float: an axis on which the two overlap then
/// gives an interval from zero or
/// below to zero or above, one on which they are apart a time that is beyond any use. Nothing can become NaN, since nothing is infinite
/// times zero.
/// </remarks>
readonly unsafe struct SlabTest : IReachTest
{
    // Two roundings on each side of the comparison, each half an ulp: a box that is met exactly at an edge must not be lost.
    internal const float Slack = 1 + 4 * 1.1920929e-7f;

    readonly Vector128<float> lower, upper, inverseDirection, isBackward;
    // A node is sixteen numbers, of which each is the beginning or the end of an axis, as the direction has it: they are put in that order, beginnings first,
    // and ends become times with their sign turned, so that of both the greatest counts.
    readonly Vector512<int> order;
    readonly Vector512<float> corners, inverses;

    public SlabTest(Vector3 min, Vector3 max, Vector3 direction)
    {
        lower = min.AsVector128();
        upper = max.AsVector128();
        inverseDirection = Vector128.Create(Invert(direction.X), Invert(direction.Y), Invert(direction.Z), 0);
        isBackward = Vector128.LessThan(inverseDirection, Vector128<float>.Zero);
        if (!Avx512F.IsSupported)
            return;
        var first = Vector128.Create(0, 1, 2, 3) + (isBackward.AsInt32() & Vector128.Create(4));
        var side = Vector256.Create(first, first ^ Vector128.Create(4, 4, 4, 0));
        order = Vector512.Create(side, side + Vector256.Create(8));
        var corner = Vector256.Create(
            Vector128.ConditionalSelect(isBackward, lower, upper), Vector128.ConditionalSelect(isBackward, upper, lower));
        corners = Vector512.Create(corner, corner);
        var inverse = Vector256.Create(inverseDirection, -inverseDirection);
        inverses = Vector512.Create(inverse, inverse);
    }

    /// <summary>Reciprocal of a component of the direction; never infinite.</summary>
    internal static float Invert(float component)
    {
        var inverse = 1 / component;
        if (component == 0 || inverse > float.MaxValue)
            return float.MaxValue;
        return inverse < -float.MaxValue ? -float.MaxValue : inverse;
    }

    /// <summary>Whether the query touches a child's box at a time in [0, maximumT], and when first; a negative time means it begins
    /// inside.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly bool Meets(NodeChild* child, float maximumT, out float t)
    {
        var toMin = (BoxMath.LoadMin(child) - upper) * inverseDirection;
        var toMax = (BoxMath.LoadMax(child) - lower) * inverseDirection;
        var begin = Vector128.ConditionalSelect(isBackward, toMax, toMin);
        var end = Vector128.ConditionalSelect(isBackward, toMin, toMax);
        // The fourth lane holds no time, so the three that do are folded by hand.
        begin = BoxMath.Max(BoxMath.Max(begin, Turn(begin)), TurnBack(begin));
        end = BoxMath.Min(BoxMath.Min(end, Turn(end)), TurnBack(end));
        t = begin.ToScalar();
        var last = end.ToScalar() * Slack;
        return t <= last & last >= 0 & t <= maximumT;
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly (bool A, bool B) MeetsBoth(NodeChild* children, float maximumT, out float tA, out float tB)
    {
        if (!Avx512F.IsSupported)
            return (Meets(children, maximumT, out tA), Meets(children + 1, maximumT, out tB));
        var times = (Avx512F.PermuteVar16x32(Vector512.Load((float*)children), order) - corners) * inverses;
        // The same as below, of two beginnings and two ends.
        var latest = Avx512F.Max(Avx512F.Max(times, Avx512F.Permute4x32(times, 0b11_00_10_01)), Avx512F.Permute4x32(times, 0b11_01_00_10));
        var (a, b) = (latest.GetLower(), latest.GetUpper());
        return (Meets(a, maximumT, out tA), Meets(b, maximumT, out tB));
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static bool Meets(Vector256<float> side, float maximumT, out float t)
    {
        t = side.ToScalar();
        var last = -side.GetUpper().ToScalar() * Slack;
        return t <= last & last >= 0 & t <= maximumT;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector128<float> Turn(Vector128<float> value) => Vector128.Shuffle(value, Vector128.Create(1, 2, 0, 3));

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector128<float> TurnBack(Vector128<float> value) => Vector128.Shuffle(value, Vector128.Create(2, 0, 1, 3));

    /// <inheritdoc/>
    public static float Growth => 1;

    /// <inheritdoc/>
    public readonly float Farther(float length)
    {
        var inverse = Vector128.Abs(inverseDirection);
        return length * MathHelper.Min(inverse[0], MathHelper.Min(inverse[1], inverse[2]));
    }

    /// <inheritdoc/>
    public readonly float Extent => BoxMath.GreatestExtent(lower, upper);

    /// <inheritdoc/>
    public readonly void Reach(float from, float to, out Vector3 min, out Vector3 max)
    {
        min = lower.AsVector3();
        max = upper.AsVector3();
        var direction = Vector3.One / inverseDirection.AsVector3();
        Vector3 begin = direction * from, end = direction * to;
        var rounding = (Vector3.Abs(min) + Vector3.Abs(max) + Vector3.Abs(end)) * BoxMath.ReachRounding;
        min += Exact.Min(begin, end) - rounding;
        max += Exact.Max(begin, end) + rounding;
    }
}
