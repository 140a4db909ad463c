using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using BepuUtilities;

namespace BepuPhysics.Trees;

/// <summary>How far boxes are from a box: zero for those that it overlaps or touches.</summary>
readonly struct GapTest(Vector3 min, Vector3 max) : IReachTest
{
    // Corners are rounded by a part of their coordinates, which are no farther from the box than the distance; and so is what is worked out
    // here. What is in a box is never nearer than is told.
    const float Slack = 1 - 2e-6f;

    readonly Vector128<float> lower = min.AsVector128(), upper = max.AsVector128();

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly unsafe bool Meets(NodeChild* child, float maximum, out float t)
    {
        var gap = BoxMath.Max(BoxMath.Max(BoxMath.LoadMin(child) - upper, lower - BoxMath.LoadMax(child)), Vector128<float>.Zero);
        t = Exact.Length(gap.AsVector3()) * Slack;
        // The missing side of a tree with a single leaf is infinitely far away; nothing that has a place is.
        return t <= maximum & t <= float.MaxValue;
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly unsafe (bool A, bool B) MeetsBoth(NodeChild* children, float maximum, out float tA, out float tB) =>
        (Meets(children, maximum, out tA), Meets(children + 1, maximum, out tB));

    /// <inheritdoc/>
    public static float Growth => 2;

    /// <inheritdoc/>
    public readonly float Farther(float length) => length;

    /// <inheritdoc/>
    public readonly float Extent => BoxMath.GreatestExtent(lower, upper);

    /// <inheritdoc/>
    public readonly void Reach(float from, float to, out Vector3 min, out Vector3 max)
    {
        min = lower.AsVector3();
        max = upper.AsVector3();
        // As much as what is told is too near, and what corners lose.
        var gap = new Vector3(to) + (new Vector3(to) + Vector3.Abs(min) + Vector3.Abs(max)) * BoxMath.ReachRounding;
        min -= gap;
        max += gap;
    }
}
