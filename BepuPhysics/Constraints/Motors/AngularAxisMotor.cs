using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Turns body A against body B about an axis of A at a velocity.</summary>
/// <remarks>For wheels and fans, beside a <see cref="Hinge"/>. Use <see cref="TwistMotor"/> where the axes of both bodies count,
/// <see cref="TwistServo"/> to reach an angle.</remarks>
public struct AngularAxisMotor : ITwoBodyConstraintDescription<AngularAxisMotor>
{
    /// <summary>Axis in A's frame; unit length.</summary>
    public Vector3 LocalAxisA;
    /// <summary>Angular velocity of A less that of B about the axis, rad/s.</summary>
    public float TargetVelocity;
    /// <summary>Greatest torque, N m, and softness.</summary>
    public MotorSettings Settings;

    /// <inheritdoc/>
    public static int ConstraintTypeId => ConstraintTypeIds.AngularAxisMotor;
    /// <inheritdoc/>
    public static TypeProcessor CreateTypeProcessor() => new TypeProcessor<
        TwoBodies, AngularAxisMotorWide, Rows1,
        JointConstraint<TwoBodies, AngularAxisMotorWide, AngularRow, Rows1, Rows1, AngularAxisMotorJoint>>();
    /// <inheritdoc/>
    public static void Validate(in AngularAxisMotor description)
    {
        ConstraintChecks.Unit(description.LocalAxisA, nameof(LocalAxisA));
        ConstraintChecks.AngularVelocity(description.TargetVelocity, nameof(TargetVelocity));
        ConstraintChecks.Motor(description.Settings, nameof(Settings));
    }
}

/// <summary>A bundle of <see cref="AngularAxisMotor"/>.</summary>
struct AngularAxisMotorWide : IWide<AngularAxisMotor>
{
    /// <inheritdoc cref="AngularAxisMotor.LocalAxisA"/>
    public Vector3Wide LocalAxisA;
    /// <inheritdoc cref="AngularAxisMotor.TargetVelocity"/>
    public Vector<float> TargetVelocity;
    /// <inheritdoc cref="AngularAxisMotor.Settings"/>
    public MotorSettingsWide Settings;
}

/// <summary>Row of <see cref="AngularAxisMotor"/>.</summary>
// J v = a (wA - wB) = target, a the axis of A in the world
readonly struct AngularAxisMotorJoint :
    IMotor<TwoBodies, AngularAxisMotorWide, AngularRow, Rows1, Rows1>, IJacobianJoint<TwoBodies, AngularAxisMotorWide, AngularRow, Rows1, Rows1>
{
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Prepare(in TwoBodies bodies, in AngularAxisMotorWide prestep, out AngularRow geometry) =>
        geometry = new() { Axis = bodies.A.Orientation * prestep.LocalAxisA };

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void TargetVelocity(in TwoBodies bodies, in AngularAxisMotorWide prestep, in AngularRow geometry, out Rows1 velocity) =>
        velocity.X = prestep.TargetVelocity;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static MotorSettingsWide Motor(in AngularAxisMotorWide prestep) => prestep.Settings;
}
