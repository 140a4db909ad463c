using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Turns body A against body B about the axis half way between one of A and one of B, at a velocity.</summary>
/// <remarks>Beside a <see cref="BallSocket"/> or <see cref="SwivelHinge"/>, whose bodies have no axis in common. Use
/// <see cref="AngularAxisMotor"/> beside a <see cref="Hinge"/>.</remarks>
public struct TwistMotor : ITwoBodyConstraintDescription<TwistMotor>
{
    /// <summary>Axis in A's frame; unit length.</summary>
    public Vector3 LocalAxisA;
    /// <summary>Axis in B's frame; unit length.</summary>
    public Vector3 LocalAxisB;
    /// <summary>Angular velocity of A less that of B about the axis half way, rad/s.</summary>
    public float TargetVelocity;
    /// <summary>Greatest torque, N m, and softness.</summary>
    public MotorSettings Settings;

    /// <inheritdoc/>
    public static int ConstraintTypeId => ConstraintTypeIds.TwistMotor;
    /// <inheritdoc/>
    public static TypeProcessor CreateTypeProcessor() => new TypeProcessor<
        TwoBodies, TwistMotorWide, Rows1, JointConstraint<TwoBodies, TwistMotorWide, AngularRow, Rows1, Rows1, TwistMotorJoint>>();
    /// <inheritdoc/>
    public static void Validate(in TwistMotor description)
    {
        ConstraintChecks.Unit(description.LocalAxisA, nameof(LocalAxisA));
        ConstraintChecks.Unit(description.LocalAxisB, nameof(LocalAxisB));
        ConstraintChecks.AngularVelocity(description.TargetVelocity, nameof(TargetVelocity));
        ConstraintChecks.Motor(description.Settings, nameof(Settings));
    }
}

/// <summary>A bundle of <see cref="TwistMotor"/>.</summary>
struct TwistMotorWide : IWide<TwistMotor>
{
    /// <inheritdoc cref="TwistMotor.LocalAxisA"/>
    public Vector3Wide LocalAxisA;
    /// <inheritdoc cref="TwistMotor.LocalAxisB"/>
    public Vector3Wide LocalAxisB;
    /// <inheritdoc cref="TwistMotor.TargetVelocity"/>
    public Vector<float> TargetVelocity;
    /// <inheritdoc cref="TwistMotor.Settings"/>
    public MotorSettingsWide Settings;
}

/// <summary>Row of <see cref="TwistMotor"/>.</summary>
// J v = m (wA - wB) = target, m the unit vector half way between the axes a and b in the world
// Axes that point exactly against each other have nothing half way: m is zero, and the motor lets go.
readonly struct TwistMotorJoint :
    IMotor<TwoBodies, TwistMotorWide, AngularRow, Rows1, Rows1>,
    IJacobianJoint<TwoBodies, TwistMotorWide, AngularRow, Rows1, Rows1>
{
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Prepare(in TwoBodies bodies, in TwistMotorWide prestep, out AngularRow geometry) =>
        geometry = new() { Axis = Vector3Wide.Normalize(bodies.A.Orientation * prestep.LocalAxisA + bodies.B.Orientation * prestep.LocalAxisB) };

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void TargetVelocity(in TwoBodies bodies, in TwistMotorWide prestep, in AngularRow geometry, out Rows1 velocity) =>
        velocity.X = prestep.TargetVelocity;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static MotorSettingsWide Motor(in TwistMotorWide prestep) => prestep.Settings;
}
