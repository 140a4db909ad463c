using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Turns body B to an orientation relative to body A, the shorter way.</summary>
/// <remarks>For muscles of ragdolls that take a pose. Use <see cref="TwistServo"/> for one angle, <see cref="OneBodyAngularServo"/> for an
/// orientation in the world.</remarks>
public struct AngularServo : ITwoBodyConstraintDescription<AngularServo>
{
    /// <summary>Orientation of B in A's frame: the rotation from B's frame to A's; unit length.</summary>
    public Quaternion TargetRelativeRotationLocalA;
    /// <summary>Stiffness of the pull; the default is rigid.</summary>
    public SpringSettings SpringSettings;
    /// <summary>Limits of speed and torque; <see cref="ServoSettings.Default"/> has none, all zero moves nothing.</summary>
    public ServoSettings ServoSettings;

    /// <inheritdoc/>
    public static int ConstraintTypeId => ConstraintTypeIds.AngularServo;
    /// <inheritdoc/>
    public static TypeProcessor CreateTypeProcessor() => new TypeProcessor<
        TwoBodies, AngularServoWide, Rows3, JointConstraint<TwoBodies, AngularServoWide, AngularRows, Rows3, RowMatrix3, AngularServoJoint>>();
    /// <inheritdoc/>
    public static void Validate(in AngularServo description)
    {
        ConstraintChecks.Unit(description.TargetRelativeRotationLocalA, nameof(TargetRelativeRotationLocalA));
        ConstraintChecks.Spring(description.SpringSettings, nameof(SpringSettings));
        ConstraintChecks.Servo(description.ServoSettings, nameof(ServoSettings));
    }
}

/// <summary>A bundle of <see cref="AngularServo"/>.</summary>
struct AngularServoWide : IWide<AngularServo>
{
    /// <inheritdoc cref="AngularServo.TargetRelativeRotationLocalA"/>
    public QuaternionWide TargetRelativeRotationLocalA;
    /// <inheritdoc cref="AngularServo.SpringSettings"/>
    public SpringSettingsWide SpringSettings;
    /// <inheritdoc cref="AngularServo.ServoSettings"/>
    public ServoSettingsWide ServoSettings;
}

/// <summary>Rows of <see cref="AngularServo"/>: the angular ones of <see cref="Weld"/>.</summary>
// C = e   the rotation vector that turns B to where it belongs, the target followed by the orientation of A
readonly struct AngularServoJoint : IJacobianJoint<TwoBodies, AngularServoWide, AngularRows, Rows3, RowMatrix3>
{
    /// <inheritdoc/>
    public static BodyAccess ErrorAccess => BodyAccess.Orientation;
    /// <inheritdoc/>
    public static RowKind Kind => RowKind.Servo;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Prepare(in TwoBodies bodies, in AngularServoWide prestep, out AngularRows geometry) => geometry = default;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void PositionError(in TwoBodies bodies, in AngularServoWide prestep, in AngularRows geometry, out Rows3 error)
    {
        var target = QuaternionWide.Concatenate(prestep.TargetRelativeRotationLocalA, bodies.A.Orientation);
        error.V = AngularRows.RotationVector(QuaternionWide.Concatenate(QuaternionWide.Conjugate(bodies.B.Orientation), target));
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static SpringSettingsWide Spring(in AngularServoWide prestep) => prestep.SpringSettings;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static ServoSettingsWide Servo(in AngularServoWide prestep) => prestep.ServoSettings;
}
