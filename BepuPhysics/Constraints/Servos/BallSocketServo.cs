using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Pulls a point of body B to a point of body A.</summary>
/// <remarks>Use <see cref="BallSocket"/> where nothing limits the force, which is cheaper; <see cref="OneBodyLinearServo"/> to pull to a point
/// of the world.</remarks>
public struct BallSocketServo : ITwoBodyConstraintDescription<BallSocketServo>
{
    /// <summary>Anchor in A's frame, m.</summary>
    public Vector3 LocalOffsetA;
    /// <summary>Anchor in B's frame, m.</summary>
    public Vector3 LocalOffsetB;
    /// <summary>Stiffness of the pull; the default is rigid.</summary>
    public SpringSettings SpringSettings;
    /// <summary>Limits of speed and force; <see cref="ServoSettings.Default"/> has none, all zero moves nothing.</summary>
    public ServoSettings ServoSettings;

    /// <inheritdoc/>
    public static int ConstraintTypeId => ConstraintTypeIds.BallSocketServo;
    /// <inheritdoc/>
    public static TypeProcessor CreateTypeProcessor() => new TypeProcessor<
        TwoBodies, BallSocketServoWide, Rows3,
        JointConstraint<TwoBodies, BallSocketServoWide, PointRows, Rows3, RowMatrix3, BallSocketServoJoint>>();
    /// <inheritdoc/>
    public static void Validate(in BallSocketServo description)
    {
        ConstraintChecks.Offset(description.LocalOffsetA, nameof(LocalOffsetA));
        ConstraintChecks.Offset(description.LocalOffsetB, nameof(LocalOffsetB));
        ConstraintChecks.Spring(description.SpringSettings, nameof(SpringSettings));
        ConstraintChecks.Servo(description.ServoSettings, nameof(ServoSettings));
    }
}

/// <summary>A bundle of <see cref="BallSocketServo"/>.</summary>
struct BallSocketServoWide : IWide<BallSocketServo>
{
    /// <inheritdoc cref="BallSocketServo.LocalOffsetA"/>
    public Vector3Wide LocalOffsetA;
    /// <inheritdoc cref="BallSocketServo.LocalOffsetB"/>
    public Vector3Wide LocalOffsetB;
    /// <inheritdoc cref="BallSocketServo.SpringSettings"/>
    public SpringSettingsWide SpringSettings;
    /// <inheritdoc cref="BallSocketServo.ServoSettings"/>
    public ServoSettingsWide ServoSettings;
}

/// <summary>Rows of <see cref="BallSocketServo"/>.</summary>
// C = (xA + rA) - (xB + rB)
readonly struct BallSocketServoJoint : IPointJoint<TwoBodies, BallSocketServoWide, PointRows, Rows3, RowMatrix3>
{
    /// <inheritdoc/>
    public static RowKind Kind => RowKind.Servo;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Prepare(in TwoBodies bodies, in BallSocketServoWide prestep, out PointRows geometry)
    {
        geometry.OffsetA = bodies.A.Orientation * prestep.LocalOffsetA;
        geometry.OffsetB = bodies.B.Orientation * prestep.LocalOffsetB;
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void PositionError(in TwoBodies bodies, in BallSocketServoWide prestep, in PointRows geometry, out Rows3 error) =>
        error.V = PointRows.Separation(bodies, geometry.OffsetA, geometry.OffsetB);

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static SpringSettingsWide Spring(in BallSocketServoWide prestep) => prestep.SpringSettings;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static ServoSettingsWide Servo(in BallSocketServoWide prestep) => prestep.ServoSettings;
}
