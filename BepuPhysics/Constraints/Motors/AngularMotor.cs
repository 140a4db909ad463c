using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Turns body A against body B at an angular velocity.</summary>
/// <remarks>With a target of zero it is a brake, or the friction of a joint. Use <see cref="AngularAxisMotor"/> for one axis,
/// <see cref="AngularServo"/> to reach an orientation.</remarks>
public struct AngularMotor : ITwoBodyConstraintDescription<AngularMotor>
{
    /// <summary>Angular velocity of A less that of B, in A's frame, rad/s.</summary>
    public Vector3 TargetVelocityLocalA;
    /// <summary>Greatest torque about any axis, N m, and softness.</summary>
    public MotorSettings Settings;

    /// <inheritdoc/>
    public static int ConstraintTypeId => ConstraintTypeIds.AngularMotor;
    /// <inheritdoc/>
    public static TypeProcessor CreateTypeProcessor() => new TypeProcessor<
        TwoBodies, AngularMotorWide, Rows3, JointConstraint<TwoBodies, AngularMotorWide, AngularRows, Rows3, RowMatrix3, AngularMotorJoint>>();
    /// <inheritdoc/>
    public static void Validate(in AngularMotor description)
    {
        ConstraintChecks.AngularVelocity(description.TargetVelocityLocalA, nameof(TargetVelocityLocalA));
        ConstraintChecks.Motor(description.Settings, nameof(Settings));
    }
}

/// <summary>A bundle of <see cref="AngularMotor"/>.</summary>
struct AngularMotorWide : IWide<AngularMotor>
{
    /// <inheritdoc cref="AngularMotor.TargetVelocityLocalA"/>
    public Vector3Wide TargetVelocityLocalA;
    /// <inheritdoc cref="AngularMotor.Settings"/>
    public MotorSettingsWide Settings;
}

/// <summary>Rows of <see cref="AngularMotor"/>.</summary>
// J v = wA - wB = target, turned into the world with A
readonly struct AngularMotorJoint :
    IMotor<TwoBodies, AngularMotorWide, AngularRows, Rows3, RowMatrix3>,
    IJacobianJoint<TwoBodies, AngularMotorWide, AngularRows, Rows3, RowMatrix3>
{
    /// <inheritdoc/>
    public static BodyAccess ErrorAccess => BodyAccess.Orientation;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Prepare(in TwoBodies bodies, in AngularMotorWide prestep, out AngularRows geometry) => geometry = default;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void TargetVelocity(in TwoBodies bodies, in AngularMotorWide prestep, in AngularRows geometry, out Rows3 velocity) =>
        velocity.V = bodies.A.Orientation * prestep.TargetVelocityLocalA;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static MotorSettingsWide Motor(in AngularMotorWide prestep) => prestep.Settings;
}
