using System;
using System.Numerics;
using BepuPhysics.Constraints;
using BepuUtilities;

namespace BepuPhysics.Characters;

/// <summary>Moves a character over a static support: a motor along the surface, and one across it that only pulls towards it.</summary>
/// <remarks>
/// <see cref="CharacterControllers"/> describes it anew in each step, with the surface that the contacts of that step have. The two motors have
/// force caps of their own, and the second works in one direction only unless the character rises, so the constraint is no joint but
/// implements <see cref="IConstraint{TBodies, TPrestep, TImpulses}"/> itself. It is made of nothing but the public interface.
/// </remarks>
public struct StaticCharacterMotion : IOneBodyConstraintDescription<StaticCharacterMotion>
{
    /// <summary>Frame of the surface: X is to the right, Y up from it, Z backwards; unit length.</summary>
    public Quaternion SurfaceBasis;
    /// <summary>Greatest force along the surface, N.</summary>
    public float MaximumHorizontalForce;
    /// <summary>Greatest force that holds the character to the surface, N.</summary>
    public float MaximumVerticalForce;
    /// <summary>Velocity to the right and forwards, m/s.</summary>
    public Vector2 TargetVelocity;
    /// <summary>Depth of the supporting contact, m: so far the character may leave the surface without being held.</summary>
    public float Depth;
    /// <summary>Velocity away from the surface, m/s, of a character that rises, as up a step; negative towards it.</summary>
    public float RisingVelocity;
    /// <summary>Greatest force that raises the character, N. If it is zero the character does not rise, and is only held.</summary>
    public float MaximumRisingForce;
    /// <summary>From the centre of the character to the supporting point, world axes, m.</summary>
    public Vector3 OffsetFromCharacterToSupportPoint;

    /// <inheritdoc/>
    public static int ConstraintTypeId => ConstraintTypeIds.StaticCharacterMotion;

    /// <inheritdoc/>
    public static TypeProcessor CreateTypeProcessor() => new TypeProcessor<
        OneBody, StaticCharacterMotionWide, CharacterMotionImpulses,
        CharacterMotionConstraint<OneBody, StaticCharacterMotionWide>>();

    /// <inheritdoc/>
    public static void Validate(in StaticCharacterMotion description) => CharacterMotionChecks.Refuse(
        description.SurfaceBasis, description.MaximumHorizontalForce, description.MaximumVerticalForce, description.MaximumRisingForce,
        Exact.Dot(description.TargetVelocity, description.TargetVelocity) + Exact.LengthSquared(description.OffsetFromCharacterToSupportPoint) +
        description.Depth + description.RisingVelocity);
}

/// <summary>Moves a character over a dynamic support, which gets the opposite impulses; see <see cref="StaticCharacterMotion"/>.</summary>
public struct DynamicCharacterMotion : ITwoBodyConstraintDescription<DynamicCharacterMotion>
{
    /// <inheritdoc cref="StaticCharacterMotion.SurfaceBasis"/>
    public Quaternion SurfaceBasis;
    /// <inheritdoc cref="StaticCharacterMotion.MaximumHorizontalForce"/>
    public float MaximumHorizontalForce;
    /// <inheritdoc cref="StaticCharacterMotion.MaximumVerticalForce"/>
    public float MaximumVerticalForce;
    /// <inheritdoc cref="StaticCharacterMotion.TargetVelocity"/>
    public Vector2 TargetVelocity;
    /// <inheritdoc cref="StaticCharacterMotion.Depth"/>
    public float Depth;
    /// <inheritdoc cref="StaticCharacterMotion.RisingVelocity"/>
    public float RisingVelocity;
    /// <inheritdoc cref="StaticCharacterMotion.MaximumRisingForce"/>
    public float MaximumRisingForce;
    /// <inheritdoc cref="StaticCharacterMotion.OffsetFromCharacterToSupportPoint"/>
    public Vector3 OffsetFromCharacterToSupportPoint;
    /// <summary>From the centre of the support to the supporting point, world axes, m.</summary>
    public Vector3 OffsetFromSupportToSupportPoint;

    internal DynamicCharacterMotion(in StaticCharacterMotion motion, Vector3 offsetFromSupport)
    {
        SurfaceBasis = motion.SurfaceBasis;
        MaximumHorizontalForce = motion.MaximumHorizontalForce;
        MaximumVerticalForce = motion.MaximumVerticalForce;
        TargetVelocity = motion.TargetVelocity;
        Depth = motion.Depth;
        RisingVelocity = motion.RisingVelocity;
        MaximumRisingForce = motion.MaximumRisingForce;
        OffsetFromCharacterToSupportPoint = motion.OffsetFromCharacterToSupportPoint;
        OffsetFromSupportToSupportPoint = offsetFromSupport;
    }

    /// <inheritdoc/>
    public static int ConstraintTypeId => ConstraintTypeIds.DynamicCharacterMotion;

    /// <inheritdoc/>
    public static TypeProcessor CreateTypeProcessor() => new TypeProcessor<
        TwoBodies, DynamicCharacterMotionWide, CharacterMotionImpulses,
        CharacterMotionConstraint<TwoBodies, DynamicCharacterMotionWide>>();

    /// <inheritdoc/>
    public static void Validate(in DynamicCharacterMotion description) => CharacterMotionChecks.Refuse(
        description.SurfaceBasis, description.MaximumHorizontalForce, description.MaximumVerticalForce, description.MaximumRisingForce,
        Exact.Dot(description.TargetVelocity, description.TargetVelocity) + Exact.LengthSquared(description.OffsetFromCharacterToSupportPoint) +
        description.Depth + description.RisingVelocity + Exact.LengthSquared(description.OffsetFromSupportToSupportPoint));
}

static class CharacterMotionChecks
{
    /// <summary>Throws where a description cannot be simulated.</summary>
    /// <param name="basis">Frame of the surface.</param>
    /// <param name="horizontalForce">Greatest force along the surface.</param>
    /// <param name="verticalForce">Greatest force across it.</param>
    /// <param name="risingForce">Greatest force away from it.</param>
    /// <param name="sum">A sum that is no number where any other field is none.</param>
    public static void Refuse(Quaternion basis, float horizontalForce, float verticalForce, float risingForce, float sum)
    {
        if (!(MathF.Abs(Exact.Dot(basis, basis) - 1) < 1e-3f))
            throw new ArgumentException($"SurfaceBasis must have unit length, not {basis}.", nameof(basis));
        if (!(horizontalForce >= 0 && verticalForce >= 0 && risingForce >= 0))
        {
            throw new ArgumentException(
                $"Greatest forces must not be negative, but are {horizontalForce}, {verticalForce} and {risingForce}.", nameof(horizontalForce));
        }
        if (!float.IsFinite(sum))
            throw new ArgumentException("TargetVelocity, Depth, RisingVelocity and offsets must be finite.", nameof(sum));
    }
}
