using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Turns body B about an axis of body A at a multiple of the velocity of A.</summary>
/// <remarks>It holds velocities, so angles drift under load. Use <see cref="Gear"/> for wheels that keep their place.</remarks>
public struct AngularAxisGearMotor : ITwoBodyConstraintDescription<AngularAxisGearMotor>
{
    /// <summary>Axis in A's frame; unit length.</summary>
    public Vector3 LocalAxisA;
    /// <summary>Angular velocity of B about the axis, in parts of A's; negative to turn the other way.</summary>
    public float VelocityScale;
    /// <summary>Greatest torque, N m, and softness.</summary>
    public MotorSettings Settings;

    /// <inheritdoc/>
    public static int ConstraintTypeId => ConstraintTypeIds.AngularAxisGearMotor;
    /// <inheritdoc/>
    public static TypeProcessor CreateTypeProcessor() => new TypeProcessor<
        TwoBodies, AngularAxisGearMotorWide, Rows1,
        JointConstraint<TwoBodies, AngularAxisGearMotorWide, GearRow, Rows1, Rows1, AngularAxisGearMotorJoint>>();
    /// <inheritdoc/>
    public static void Validate(in AngularAxisGearMotor description)
    {
        ConstraintChecks.Unit(description.LocalAxisA, nameof(LocalAxisA));
        ConstraintChecks.GearRatio(description.VelocityScale, nameof(VelocityScale));
        ConstraintChecks.Motor(description.Settings, nameof(Settings));
    }
}

/// <summary>A bundle of <see cref="AngularAxisGearMotor"/>.</summary>
struct AngularAxisGearMotorWide : IWide<AngularAxisGearMotor>
{
    /// <inheritdoc cref="AngularAxisGearMotor.LocalAxisA"/>
    public Vector3Wide LocalAxisA;
    /// <inheritdoc cref="AngularAxisGearMotor.VelocityScale"/>
    public Vector<float> VelocityScale;
    /// <inheritdoc cref="AngularAxisGearMotor.Settings"/>
    public MotorSettingsWide Settings;
}

/// <summary>Row of <see cref="AngularAxisGearMotor"/>.</summary>
// J v = scale a wA - a wB = 0, a the axis of A in the world
readonly struct AngularAxisGearMotorJoint :
    IMotor<TwoBodies, AngularAxisGearMotorWide, GearRow, Rows1, Rows1>,
    IJacobianJoint<TwoBodies, AngularAxisGearMotorWide, GearRow, Rows1, Rows1>
{
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Prepare(in TwoBodies bodies, in AngularAxisGearMotorWide prestep, out GearRow geometry)
    {
        geometry.Axis = bodies.A.Orientation * prestep.LocalAxisA;
        geometry.Scale = prestep.VelocityScale;
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void TargetVelocity(in TwoBodies bodies, in AngularAxisGearMotorWide prestep, in GearRow geometry, out Rows1 velocity) =>
        velocity.X = Vector<float>.Zero;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static MotorSettingsWide Motor(in AngularAxisGearMotorWide prestep) => prestep.Settings;
}
