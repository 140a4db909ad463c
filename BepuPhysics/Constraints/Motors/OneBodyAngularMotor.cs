using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Turns a body at an angular velocity of the world.</summary>
/// <remarks>With a target of zero it damps rotation. Use <see cref="OneBodyAngularServo"/> to reach an orientation, <see cref="AngularMotor"/>
/// between two bodies.</remarks>
public struct OneBodyAngularMotor : IOneBodyConstraintDescription<OneBodyAngularMotor>
{
    /// <summary>Angular velocity in world axes, rad/s.</summary>
    public Vector3 TargetVelocity;
    /// <summary>Greatest torque about any axis, N m, and softness.</summary>
    public MotorSettings Settings;

    /// <inheritdoc/>
    public static int ConstraintTypeId => ConstraintTypeIds.OneBodyAngularMotor;
    /// <inheritdoc/>
    public static TypeProcessor CreateTypeProcessor() => new TypeProcessor<
        OneBody, OneBodyAngularMotorWide, Rows3,
        JointConstraint<OneBody, OneBodyAngularMotorWide, OneBodyAngularRows, Rows3, RowMatrix3, OneBodyAngularMotorJoint>>();
    /// <inheritdoc/>
    public static void Validate(in OneBodyAngularMotor description)
    {
        ConstraintChecks.AngularVelocity(description.TargetVelocity, nameof(TargetVelocity));
        ConstraintChecks.Motor(description.Settings, nameof(Settings));
    }
}

/// <summary>A bundle of <see cref="OneBodyAngularMotor"/>.</summary>
struct OneBodyAngularMotorWide : IWide<OneBodyAngularMotor>
{
    /// <inheritdoc cref="OneBodyAngularMotor.TargetVelocity"/>
    public Vector3Wide TargetVelocity;
    /// <inheritdoc cref="OneBodyAngularMotor.Settings"/>
    public MotorSettingsWide Settings;
}

/// <summary>Rows of <see cref="OneBodyAngularMotor"/>.</summary>
// J v = w = target
readonly struct OneBodyAngularMotorJoint :
    IMotor<OneBody, OneBodyAngularMotorWide, OneBodyAngularRows, Rows3, RowMatrix3>,
    IJacobianJoint<OneBody, OneBodyAngularMotorWide, OneBodyAngularRows, Rows3, RowMatrix3>
{
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Prepare(in OneBody bodies, in OneBodyAngularMotorWide prestep, out OneBodyAngularRows geometry) => geometry = default;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void TargetVelocity(in OneBody bodies, in OneBodyAngularMotorWide prestep, in OneBodyAngularRows geometry, out Rows3 velocity) =>
        velocity.V = prestep.TargetVelocity;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static MotorSettingsWide Motor(in OneBodyAngularMotorWide prestep) => prestep.Settings;
}
