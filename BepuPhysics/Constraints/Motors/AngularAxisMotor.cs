using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Turns body A against body B about an axis of A at a velocity.</summary>
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
        JointConstraint<TwoBodies, AngularAxisMotorWide, AngularAxisMotorGeometry, Rows1, Rows1, AngularAxisMotorJoint>>();
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

/// <summary>The axis of a motor in world axes.</summary>
struct AngularAxisMotorGeometry
{
    /// <summary>Unit vector, fixed to A.</summary>
    public Vector3Wide Axis;
}

/// <summary>Row of <see cref="AngularAxisMotor"/>.</summary>
// J v = a (wA - wB) = target, a the axis of A in the world
// J = [ 0, a^T, 0, -a^T ]   over (vA, wA, vB, wB)
// K = a (IA^-1 + IB^-1) a
readonly struct AngularAxisMotorJoint : IMotor<TwoBodies, AngularAxisMotorWide, AngularAxisMotorGeometry, Rows1, Rows1>
{
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Prepare(in TwoBodies bodies, in AngularAxisMotorWide prestep, out AngularAxisMotorGeometry geometry) =>
        geometry.Axis = bodies.A.Orientation * prestep.LocalAxisA;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void TargetVelocity(in TwoBodies bodies, in AngularAxisMotorWide prestep, in AngularAxisMotorGeometry geometry, out Rows1 velocity) =>
        velocity.X = prestep.TargetVelocity;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void RelativeVelocity(in AngularAxisMotorGeometry geometry, in TwoBodies bodies, out Rows1 velocity) =>
        velocity.X = AngularRow.RelativeVelocity(geometry.Axis, bodies);

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void ApplyImpulse(in AngularAxisMotorGeometry geometry, ref TwoBodies bodies, in Rows1 impulse) =>
        AngularRow.ApplyImpulse(geometry.Axis, ref bodies, impulse.X);

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void InverseEffectiveMass(in AngularAxisMotorGeometry geometry, in TwoBodies bodies, out Rows1 inverseMass) =>
        inverseMass.X = AngularRow.InverseEffectiveMass(geometry.Axis, bodies);

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static MotorSettingsWide Motor(in AngularAxisMotorWide prestep) => prestep.Settings;
}
