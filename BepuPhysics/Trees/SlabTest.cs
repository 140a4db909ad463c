using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;

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
readonly struct SlabTest : IBoxTest
{
    // Two roundings on each side of the comparison, each half an ulp: a box that is met exactly at an edge must not be lost.
    const float Slack = 1 + 4 * 1.1920929e-7f;

    readonly Vector128<float> lower, upper, inverseDirection, isBackward;

    public SlabTest(Vector3 min, Vector3 max, Vector3 direction)
    {
        lower = min.AsVector128();
        upper = max.AsVector128();
        inverseDirection = Vector128.Create(Invert(direction.X), Invert(direction.Y), Invert(direction.Z), 0);
        isBackward = Vector128.LessThan(inverseDirection, Vector128<float>.Zero);
    }

    static float Invert(float component)
    {
        var inverse = 1 / component;
        if (component == 0 || inverse > float.MaxValue)
            return float.MaxValue;
        return inverse < -float.MaxValue ? -float.MaxValue : inverse;
    }

    /// <summary>Whether the query touches a child's box at a time in [0, maximumT], and when first; a negative time means it begins
    /// inside.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly unsafe bool Meets(NodeChild* child, float maximumT, out float t)
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

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector128<float> Turn(Vector128<float> value) => Vector128.Shuffle(value, Vector128.Create(1, 2, 0, 3));

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector128<float> TurnBack(Vector128<float> value) => Vector128.Shuffle(value, Vector128.Create(2, 0, 1, 3));
}
