using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using BepuUtilities;

namespace BepuPhysics.Trees;

/// <summary>How far boxes are from a box: zero for those that it overlaps or touches.</summary>
readonly struct GapTest(Vector3 min, Vector3 max) : IBoxTest
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
}
