using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;

namespace BepuPhysics.Trees;

/// <summary>Which boxes overlap or touch a box: asked of both sides of a node at once.</summary>
readonly unsafe struct OverlapTest
{
    /// <summary>Bits that are set where a node's first side is apart from the box.</summary>
    public const uint SideA = 0x77;
    /// <summary>Bits that are set where its second side is.</summary>
    public const uint SideB = SideA << 8;

    readonly Vector128<float> lower, upper;
    // A box is apart where its lower corner is above the upper one of ours, or its upper corner below our lower one: where that, with the sign
    // turned, is above ours. So the sixteen numbers of a node are one vector that is compared once.
    readonly Vector512<float> signs, limits;

    /// <summary>Asks about a box.</summary>
    /// <param name="min">Lower corner; no component may be NaN.</param>
    /// <param name="max">Upper corner, nowhere below the lower.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public OverlapTest(Vector128<float> min, Vector128<float> max)
    {
        Unsafe.SkipInit(out this);
        lower = min;
        upper = max;
        if (!Vector512.IsHardwareAccelerated)
            return;
        var side = Vector256.Create(Vector128<float>.Zero, Vector128.Create(-0f));
        signs = Vector512.Create(side, side);
        side = Vector256.Create(upper, -lower);
        limits = Vector512.Create(side, side);
    }

    /// <summary>Bits of the sides of a node that are apart from the box; others tell nothing.</summary>
    /// <param name="children">First side of the node, behind which is the second.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public uint FindApart(NodeChild* children)
    {
        if (Vector512.IsHardwareAccelerated)
            return (uint)Vector512.GreaterThan(Vector512.Load((float*)children) ^ signs, limits).ExtractMostSignificantBits();
        return (Overlaps(children) ? 0 : SideA) | (Overlaps(children + 1) ? 0 : SideB);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    bool Overlaps(NodeChild* child) => BoxMath.Overlaps(lower, upper, BoxMath.LoadMin(child), BoxMath.LoadMax(child));
}
