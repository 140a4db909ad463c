using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Keeps a point of body B at a distance from a plane of body A: a spring strut, a lift.</summary>
/// <remarks>The suspension of a wheel, beside a <see cref="PointOnLineServo"/>. Use <see cref="LinearAxisLimit"/> for a range,
/// <see cref="LinearAxisMotor"/> for a velocity.</remarks>
public struct LinearAxisServo : ITwoBodyConstraintDescription<LinearAxisServo>
{
    /// <summary>A point of the plane in A's frame, m.</summary>
    public Vector3 LocalOffsetA;
    /// <summary>Anchor in B's frame, m.</summary>
    public Vector3 LocalOffsetB;
    /// <summary>Normal of the plane in A's frame; unit length.</summary>
    public Vector3 LocalPlaneNormal;
    /// <summary>Distance of B's anchor from the plane along the normal, m; negative behind it.</summary>
    public float TargetOffset;
    /// <summary>Limits of speed and force; <see cref="ServoSettings.Default"/> has none, all zero moves nothing.</summary>
    public ServoSettings ServoSettings;
    /// <summary>Stiffness of the connection; the default is rigid.</summary>
    public SpringSettings SpringSettings;

    /// <inheritdoc/>
    public static int ConstraintTypeId => ConstraintTypeIds.LinearAxisServo;
    /// <inheritdoc/>
    public static TypeProcessor CreateTypeProcessor() => new TypeProcessor<
        TwoBodies, LinearAxisServoWide, Rows1, JointConstraint<TwoBodies, LinearAxisServoWide, LinearRow, Rows1, Rows1, LinearAxisServoJoint>>();
    /// <inheritdoc/>
    public static void Validate(in LinearAxisServo description)
    {
        ConstraintChecks.Offset(description.LocalOffsetA, nameof(LocalOffsetA));
        ConstraintChecks.Offset(description.LocalOffsetB, nameof(LocalOffsetB));
        ConstraintChecks.Unit(description.LocalPlaneNormal, nameof(LocalPlaneNormal));
        ConstraintChecks.Offset(description.TargetOffset, nameof(TargetOffset));
        ConstraintChecks.Servo(description.ServoSettings, nameof(ServoSettings));
        ConstraintChecks.Spring(description.SpringSettings, nameof(SpringSettings));
    }
}

/// <summary>A bundle of <see cref="LinearAxisServo"/>.</summary>
struct LinearAxisServoWide : IWide<LinearAxisServo>
{
    /// <inheritdoc cref="LinearAxisServo.LocalOffsetA"/>
    public Vector3Wide LocalOffsetA;
    /// <inheritdoc cref="LinearAxisServo.LocalOffsetB"/>
    public Vector3Wide LocalOffsetB;
    /// <inheritdoc cref="LinearAxisServo.LocalPlaneNormal"/>
    public Vector3Wide LocalPlaneNormal;
    /// <inheritdoc cref="LinearAxisServo.TargetOffset"/>
    public Vector<float> TargetOffset;
    /// <inheritdoc cref="LinearAxisServo.ServoSettings"/>
    public ServoSettingsWide ServoSettings;
    /// <inheritdoc cref="LinearAxisServo.SpringSettings"/>
    public SpringSettingsWide SpringSettings;
}

/// <summary>Row of <see cref="LinearAxisServo"/>.</summary>
// C = target - n (pB - pA)
readonly struct LinearAxisServoJoint : IJacobianJoint<TwoBodies, LinearAxisServoWide, LinearRow, Rows1, Rows1>
{
    /// <inheritdoc/>
    public static RowKind Kind => RowKind.Servo;
    /// <inheritdoc/>
    public static bool CarriesBodies => true;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Prepare(in TwoBodies bodies, in LinearAxisServoWide prestep, out LinearRow geometry) =>
        new AxisThroughPoints(bodies, prestep.LocalOffsetA, prestep.LocalOffsetB, prestep.LocalPlaneNormal).RowTo(out geometry);

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void PositionError(in TwoBodies bodies, in LinearAxisServoWide prestep, in LinearRow geometry, out Rows1 error) =>
        error.X = prestep.TargetOffset - geometry.Distance;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static SpringSettingsWide Spring(in LinearAxisServoWide prestep) => prestep.SpringSettings;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static ServoSettingsWide Servo(in LinearAxisServoWide prestep) => prestep.ServoSettings;
}
