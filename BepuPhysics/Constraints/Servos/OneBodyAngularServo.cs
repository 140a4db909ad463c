using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Turns a body to an orientation in the world, the shorter way.</summary>
/// <remarks>Keeps characters upright and held things turned. Use <see cref="AngularServo"/> for an orientation against another body.</remarks>
public struct OneBodyAngularServo : IOneBodyConstraintDescription<OneBodyAngularServo>
{
    /// <summary>Orientation in the world; unit length.</summary>
    public Quaternion TargetOrientation;
    /// <summary>Stiffness of the pull; the default is rigid.</summary>
    public SpringSettings SpringSettings;
    /// <summary>Limits of speed and torque; <see cref="ServoSettings.Default"/> has none, all zero moves nothing.</summary>
    public ServoSettings ServoSettings;

    /// <inheritdoc/>
    public static int ConstraintTypeId => ConstraintTypeIds.OneBodyAngularServo;
    /// <inheritdoc/>
    public static TypeProcessor CreateTypeProcessor() => new TypeProcessor<
        OneBody, OneBodyAngularServoWide, Rows3,
        JointConstraint<OneBody, OneBodyAngularServoWide, OneBodyAngularRows, Rows3, RowMatrix3, OneBodyAngularServoJoint>>();
    /// <inheritdoc/>
    public static void Validate(in OneBodyAngularServo description)
    {
        ConstraintChecks.Unit(description.TargetOrientation, nameof(TargetOrientation));
        ConstraintChecks.Spring(description.SpringSettings, nameof(SpringSettings));
        ConstraintChecks.Servo(description.ServoSettings, nameof(ServoSettings));
    }
}

/// <summary>A bundle of <see cref="OneBodyAngularServo"/>.</summary>
struct OneBodyAngularServoWide : IWide<OneBodyAngularServo>
{
    /// <inheritdoc cref="OneBodyAngularServo.TargetOrientation"/>
    public QuaternionWide TargetOrientation;
    /// <inheritdoc cref="OneBodyAngularServo.SpringSettings"/>
    public SpringSettingsWide SpringSettings;
    /// <inheritdoc cref="OneBodyAngularServo.ServoSettings"/>
    public ServoSettingsWide ServoSettings;
}

/// <summary>Rows of <see cref="OneBodyAngularServo"/>.</summary>
// C = e   the rotation vector (axis times angle, at most a half turn) that turns the target to where the body is
readonly struct OneBodyAngularServoJoint : IJacobianJoint<OneBody, OneBodyAngularServoWide, OneBodyAngularRows, Rows3, RowMatrix3>
{
    /// <inheritdoc/>
    public static BodyAccess ErrorAccess => BodyAccess.Orientation;
    /// <inheritdoc/>
    public static RowKind Kind => RowKind.Servo;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Prepare(in OneBody bodies, in OneBodyAngularServoWide prestep, out OneBodyAngularRows geometry) => geometry = default;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void PositionError(in OneBody bodies, in OneBodyAngularServoWide prestep, in OneBodyAngularRows geometry, out Rows3 error) =>
        error.V = AngularRows.RotationVector(
            QuaternionWide.Concatenate(QuaternionWide.Conjugate(prestep.TargetOrientation), bodies.A.Orientation));

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static SpringSettingsWide Spring(in OneBodyAngularServoWide prestep) => prestep.SpringSettings;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static ServoSettingsWide Servo(in OneBodyAngularServoWide prestep) => prestep.ServoSettings;
}
