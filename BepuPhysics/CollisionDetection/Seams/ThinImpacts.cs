using System;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>Tells which impacts on triangles are to be made exactly, as what is hit there is too thin to give way.</summary>
/// <remarks>
/// A contact that is hit at a speed v gives way by v over e times its angular frequency: an eighth of the way of a step with four substeps, half of it with
/// one. That is nothing to a crate. But what moves by its own thickness within a step would have its middle behind a triangle then, which it would be let
/// through.
/// </remarks>
static class ThinImpacts
{
    /// <summary>Way within a step, as a part of the inner radius, by which what is hit is thin: that of its thickness.</summary>
    public const float ThinWay = 2;

    // Part of its distance from the centre of its body that a contact moves at least: nothing is as thin as that.
    const float LeastWay = 1e-3f;

    /// <summary>Whether one of the contacts of a pair is hit, by a shape that moves by more than its thickness within the step.</summary>
    /// <param name="patches">The contacts.</param>
    /// <param name="motion">How the two bodies move.</param>
    /// <param name="dt">Length of the step, s.</param>
    /// <param name="placed">Shapes and poses of the children.</param>
    /// <param name="ranked">The children that touch.</param>
    public static bool Has(
        ReadOnlySpan<ChildResult> patches, in PairMotion motion, float dt, ReadOnlySpan<PlacedChildren> placed, ReadOnlySpan<RankedChild> ranked)
    {
        var greatest = 0f;
        foreach (ref readonly var patch in patches)
        {
            ref readonly var manifold = ref patch.Manifold;
            for (int i = 0; i < manifold.Count; ++i)
            {
                var arm = manifold.GetOffset(i);
                var velocity = motion.A.Linear - motion.B.Linear + Exact.Cross(motion.A.Angular, arm) - Exact.Cross(motion.B.Angular, arm - manifold.OffsetB);
                var way = -Exact.Dot(velocity, manifold.Normal) * dt;
                // Acceleration, and what else pushes, may add to it.
                if (2 * way > -manifold.GetDepth(i))
                    greatest = MathHelper.Max(greatest, way);
            }
        }
        if (!(greatest > 0))
            return false;
        foreach (ref readonly var child in ranked)
        {
            ref readonly var pair = ref placed[child.Slot];
            if ((pair.TypeA == Triangle.Id) != (pair.TypeB == Triangle.Id) && greatest > ThinWay * pair.InnerRadius())
                return true;
        }
        return false;
    }

    /// <summary>Whether a pair may have such contacts: one that hardly moves has none.</summary>
    /// <param name="patch">Some of its contacts.</param>
    /// <param name="motion">How the two bodies move.</param>
    /// <param name="dt">Length of the step, s.</param>
    public static bool MayHave(in ConvexContactManifold patch, in PairMotion motion, float dt)
    {
        var reach = Exact.LengthSquared(patch.Contact0.Offset);
        var turning = Exact.LengthSquared(motion.A.Angular) + Exact.LengthSquared(motion.B.Angular);
        return (Exact.LengthSquared(motion.A.Linear - motion.B.Linear) + turning * reach) * dt * dt > LeastWay * LeastWay * reach;
    }
}
