using System;
using System.Numerics;
using BepuPhysics.Constraints;

namespace Demos.Characters;

/// <summary>Moves a character over a static support: a motor along the surface, and one across it that only pulls towards it.</summary>
/// <remarks>
/// A game's own constraint type, made of nothing but the public interface. It is described anew in each step, with the surface that the contacts of
/// that step have. The two motors have force caps of their own, and the second works in one direction only, so the constraint is no joint but
/// implements <see cref="IConstraint{TBodies, TPrestep, TImpulses}"/> itself.
/// </remarks>
struct StaticCharacterMotion : IOneBodyConstraintDescription<StaticCharacterMotion>
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
    /// <summary>From the centre of the character to the supporting point, world axes, m.</summary>
    public Vector3 OffsetFromCharacterToSupportPoint;

    public static int ConstraintTypeId => 64;

    public static TypeProcessor CreateTypeProcessor() => new TypeProcessor<
        OneBody, StaticCharacterMotionWide, CharacterMotionImpulses,
        CharacterMotionConstraint<OneBody, StaticCharacterMotionWide>>();

    public static void Validate(in StaticCharacterMotion description) => CharacterMotionChecks.Refuse(
        description.SurfaceBasis, description.MaximumHorizontalForce, description.MaximumVerticalForce,
        description.TargetVelocity.LengthSquared() + description.OffsetFromCharacterToSupportPoint.LengthSquared() + description.Depth);
}

/// <summary>Moves a character over a dynamic support, which gets the opposite impulses; see <see cref="StaticCharacterMotion"/>.</summary>
struct DynamicCharacterMotion : ITwoBodyConstraintDescription<DynamicCharacterMotion>
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
    /// <inheritdoc cref="StaticCharacterMotion.OffsetFromCharacterToSupportPoint"/>
    public Vector3 OffsetFromCharacterToSupportPoint;
    /// <summary>From the centre of the support to the supporting point, world axes, m.</summary>
    public Vector3 OffsetFromSupportToSupportPoint;

    public static int ConstraintTypeId => 65;

    public static TypeProcessor CreateTypeProcessor() => new TypeProcessor<
        TwoBodies, DynamicCharacterMotionWide, CharacterMotionImpulses,
        CharacterMotionConstraint<TwoBodies, DynamicCharacterMotionWide>>();

    public static void Validate(in DynamicCharacterMotion description) => CharacterMotionChecks.Refuse(
        description.SurfaceBasis, description.MaximumHorizontalForce, description.MaximumVerticalForce,
        description.TargetVelocity.LengthSquared() + description.OffsetFromCharacterToSupportPoint.LengthSquared() + description.Depth +
        description.OffsetFromSupportToSupportPoint.LengthSquared());
}

static class CharacterMotionChecks
{
    /// <summary>Throws where a description cannot be simulated.</summary>
    /// <param name="basis">Frame of the surface.</param>
    /// <param name="horizontalForce">Greatest force along the surface.</param>
    /// <param name="verticalForce">Greatest force across it.</param>
    /// <param name="sum">A sum that is no number where any other field is none.</param>
    public static void Refuse(Quaternion basis, float horizontalForce, float verticalForce, float sum)
    {
        if (!(MathF.Abs(basis.LengthSquared() - 1) < 1e-3f))
            throw new ArgumentException($"SurfaceBasis must have unit length, not {basis}.", nameof(basis));
        if (!(horizontalForce >= 0 && verticalForce >= 0))
            throw new ArgumentException($"Greatest forces must not be negative, but are {horizontalForce} and {verticalForce}.", nameof(horizontalForce));
        if (!float.IsFinite(sum))
            throw new ArgumentException("TargetVelocity, Depth and offsets must be finite.", nameof(sum));
    }
}
