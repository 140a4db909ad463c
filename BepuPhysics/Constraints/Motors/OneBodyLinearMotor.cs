using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Moves a point of a body at a velocity of the world.</summary>
/// <remarks>With a target of zero it is a brake. Use <see cref="OneBodyLinearServo"/> to reach a place, <see cref="BallSocketMotor"/> between
/// two bodies.</remarks>
public struct OneBodyLinearMotor : IOneBodyConstraintDescription<OneBodyLinearMotor>
{
    /// <summary>The point in the body's frame, m.</summary>
    public Vector3 LocalOffset;
    /// <summary>Velocity of the point in world axes, m/s.</summary>
    public Vector3 TargetVelocity;
    /// <summary>Greatest force in any direction, N, and softness.</summary>
    public MotorSettings Settings;

    /// <inheritdoc/>
    public static int ConstraintTypeId => ConstraintTypeIds.OneBodyLinearMotor;
    /// <inheritdoc/>
    public static TypeProcessor CreateTypeProcessor() => new TypeProcessor<
        OneBody, OneBodyLinearMotorWide, Rows3,
        JointConstraint<OneBody, OneBodyLinearMotorWide, OneBodyPointRows, Rows3, RowMatrix3, OneBodyLinearMotorJoint>>();
    /// <inheritdoc/>
    public static void Validate(in OneBodyLinearMotor description)
    {
        ConstraintChecks.Offset(description.LocalOffset, nameof(LocalOffset));
        ConstraintChecks.LinearVelocity(description.TargetVelocity, nameof(TargetVelocity));
        ConstraintChecks.Motor(description.Settings, nameof(Settings));
    }
}

/// <summary>A bundle of <see cref="OneBodyLinearMotor"/>.</summary>
struct OneBodyLinearMotorWide : IWide<OneBodyLinearMotor>
{
    /// <inheritdoc cref="OneBodyLinearMotor.LocalOffset"/>
    public Vector3Wide LocalOffset;
    /// <inheritdoc cref="OneBodyLinearMotor.TargetVelocity"/>
    public Vector3Wide TargetVelocity;
    /// <inheritdoc cref="OneBodyLinearMotor.Settings"/>
    public MotorSettingsWide Settings;
}

/// <summary>Rows of <see cref="OneBodyLinearMotor"/>.</summary>
// J v = v + w x r = target
readonly struct OneBodyLinearMotorJoint :
    IMotor<OneBody, OneBodyLinearMotorWide, OneBodyPointRows, Rows3, RowMatrix3>,
    IJacobianJoint<OneBody, OneBodyLinearMotorWide, OneBodyPointRows, Rows3, RowMatrix3>
{
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Prepare(in OneBody bodies, in OneBodyLinearMotorWide prestep, out OneBodyPointRows geometry) =>
        geometry.Offset = bodies.A.Orientation * prestep.LocalOffset;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void TargetVelocity(in OneBody bodies, in OneBodyLinearMotorWide prestep, in OneBodyPointRows geometry, out Rows3 velocity) =>
        velocity.V = prestep.TargetVelocity;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static MotorSettingsWide Motor(in OneBodyLinearMotorWide prestep) => prestep.Settings;
}
