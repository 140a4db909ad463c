using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Turns body B against body A about their twist axes to an angle, the shorter way around.</summary>
/// <remarks>For steering and joints of robots, beside a <see cref="Hinge"/>. Use <see cref="AngularServo"/> for all three angles,
/// <see cref="TwistLimit"/> for a range.</remarks>
public struct TwistServo : ITwoBodyConstraintDescription<TwistServo>
{
    /// <summary>Rotation from the joint's frame to A's; its Z axis is the twist axis, X is angle 0, Y a quarter turn; unit length.</summary>
    public Quaternion LocalBasisA;
    /// <summary>Rotation from the joint's frame to B's; its Z axis is the twist axis, X is what is measured; unit length.</summary>
    public Quaternion LocalBasisB;
    /// <summary>Angle from A to B, radians; whole turns do not count.</summary>
    public float TargetAngle;
    /// <summary>Stiffness of the pull; the default is rigid.</summary>
    public SpringSettings SpringSettings;
    /// <summary>Limits of speed and torque; <see cref="ServoSettings.Default"/> has none, all zero moves nothing.</summary>
    public ServoSettings ServoSettings;

    /// <inheritdoc/>
    public static int ConstraintTypeId => ConstraintTypeIds.TwistServo;
    /// <inheritdoc/>
    public static TypeProcessor CreateTypeProcessor() => new TypeProcessor<
        TwoBodies, TwistServoWide, Rows1, JointConstraint<TwoBodies, TwistServoWide, AngularRow, Rows1, Rows1, TwistServoJoint>>();
    /// <inheritdoc/>
    public static void Validate(in TwistServo description)
    {
        ConstraintChecks.Unit(description.LocalBasisA, nameof(LocalBasisA));
        ConstraintChecks.Unit(description.LocalBasisB, nameof(LocalBasisB));
        ConstraintChecks.Angle(description.TargetAngle, nameof(TargetAngle));
        ConstraintChecks.Spring(description.SpringSettings, nameof(SpringSettings));
        ConstraintChecks.Servo(description.ServoSettings, nameof(ServoSettings));
    }
}

/// <summary>A bundle of <see cref="TwistServo"/>.</summary>
struct TwistServoWide : IWide<TwistServo>
{
    /// <inheritdoc cref="TwistServo.LocalBasisA"/>
    public QuaternionWide LocalBasisA;
    /// <inheritdoc cref="TwistServo.LocalBasisB"/>
    public QuaternionWide LocalBasisB;
    /// <inheritdoc cref="TwistServo.TargetAngle"/>
    public Vector<float> TargetAngle;
    /// <inheritdoc cref="TwistServo.SpringSettings"/>
    public SpringSettingsWide SpringSettings;
    /// <inheritdoc cref="TwistServo.ServoSettings"/>
    public ServoSettingsWide ServoSettings;
}

/// <summary>Row of <see cref="TwistServo"/>.</summary>
// C = target - twist, less whole turns
// J = [ 0, t^T, 0, -t^T ]   over (vA, wA, vB, wB), with t as for the twist
readonly struct TwistServoJoint : IJacobianJoint<TwoBodies, TwistServoWide, AngularRow, Rows1, Rows1>
{
    /// <inheritdoc/>
    public static RowKind Kind => RowKind.Servo;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Prepare(in TwoBodies bodies, in TwistServoWide prestep, out AngularRow geometry)
    {
        TwistAngle.Measure(bodies, prestep.LocalBasisA, prestep.LocalBasisB, out var twist);
        geometry.Angle = TwistAngle.WithinHalfATurn(prestep.TargetAngle - twist.Angle);
        geometry.Axis = twist.Axis(Vector<float>.One);
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void PositionError(in TwoBodies bodies, in TwistServoWide prestep, in AngularRow geometry, out Rows1 error) =>
        error.X = geometry.Angle;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static SpringSettingsWide Spring(in TwistServoWide prestep) => prestep.SpringSettings;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static ServoSettingsWide Servo(in TwistServoWide prestep) => prestep.ServoSettings;
}
