using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Moves a point of body B along an axis of body A at a velocity.</summary>
/// <remarks>For lifts and conveyors, beside a <see cref="Slider"/> or <see cref="PointOnLineServo"/>. Use <see cref="LinearAxisServo"/> to reach
/// a place.</remarks>
public struct LinearAxisMotor : ITwoBodyConstraintDescription<LinearAxisMotor>
{
    /// <summary>Anchor in A's frame, m.</summary>
    public Vector3 LocalOffsetA;
    /// <summary>Anchor in B's frame, m.</summary>
    public Vector3 LocalOffsetB;
    /// <summary>Axis in A's frame; unit length.</summary>
    public Vector3 LocalAxis;
    /// <summary>Velocity of B's anchor along the axis, seen from A, m/s.</summary>
    public float TargetVelocity;
    /// <summary>Greatest force, N, and softness.</summary>
    public MotorSettings Settings;

    /// <inheritdoc/>
    public static int ConstraintTypeId => ConstraintTypeIds.LinearAxisMotor;
    /// <inheritdoc/>
    public static TypeProcessor CreateTypeProcessor() => new TypeProcessor<
        TwoBodies, LinearAxisMotorWide, Rows1, JointConstraint<TwoBodies, LinearAxisMotorWide, LinearRow, Rows1, Rows1, LinearAxisMotorJoint>>();
    /// <inheritdoc/>
    public static void Validate(in LinearAxisMotor description)
    {
        ConstraintChecks.Offset(description.LocalOffsetA, nameof(LocalOffsetA));
        ConstraintChecks.Offset(description.LocalOffsetB, nameof(LocalOffsetB));
        ConstraintChecks.Unit(description.LocalAxis, nameof(LocalAxis));
        ConstraintChecks.LinearVelocity(description.TargetVelocity, nameof(TargetVelocity));
        ConstraintChecks.Motor(description.Settings, nameof(Settings));
    }
}

/// <summary>A bundle of <see cref="LinearAxisMotor"/>.</summary>
struct LinearAxisMotorWide : IWide<LinearAxisMotor>
{
    /// <inheritdoc cref="LinearAxisMotor.LocalOffsetA"/>
    public Vector3Wide LocalOffsetA;
    /// <inheritdoc cref="LinearAxisMotor.LocalOffsetB"/>
    public Vector3Wide LocalOffsetB;
    /// <inheritdoc cref="LinearAxisMotor.LocalAxis"/>
    public Vector3Wide LocalAxis;
    /// <inheritdoc cref="LinearAxisMotor.TargetVelocity"/>
    public Vector<float> TargetVelocity;
    /// <inheritdoc cref="LinearAxisMotor.Settings"/>
    public MotorSettingsWide Settings;
}

/// <summary>Row of <see cref="LinearAxisMotor"/>.</summary>
// J v = -(n (pB - pA))' = -target   the row is along what the distance loses
// Where on the axis A's anchor is makes no difference to a velocity.
readonly struct LinearAxisMotorJoint :
    IMotor<TwoBodies, LinearAxisMotorWide, LinearRow, Rows1, Rows1>,
    IJacobianJoint<TwoBodies, LinearAxisMotorWide, LinearRow, Rows1, Rows1>
{
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Prepare(in TwoBodies bodies, in LinearAxisMotorWide prestep, out LinearRow geometry) =>
        new AxisThroughPoints(bodies, prestep.LocalOffsetA, prestep.LocalOffsetB, prestep.LocalAxis).RowTo(out geometry);

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void TargetVelocity(in TwoBodies bodies, in LinearAxisMotorWide prestep, in LinearRow geometry, out Rows1 velocity) =>
        velocity.X = -prestep.TargetVelocity;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static MotorSettingsWide Motor(in LinearAxisMotorWide prestep) => prestep.Settings;
}
