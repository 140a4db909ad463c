using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Brings a point of body A and a point of body B to a distance from each other.</summary>
/// <remarks>For rods, springs and pistons. Use <see cref="DistanceLimit"/> for a rope, <see cref="CenterDistanceConstraint"/> without anchors
/// and forces to limit.</remarks>
public struct DistanceServo : ITwoBodyConstraintDescription<DistanceServo>
{
    /// <summary>Anchor in A's frame, m.</summary>
    public Vector3 LocalOffsetA;
    /// <summary>Anchor in B's frame, m.</summary>
    public Vector3 LocalOffsetB;
    /// <summary>Distance between the anchors, m; not negative.</summary>
    public float TargetDistance;
    /// <summary>Limits of speed and force; <see cref="ServoSettings.Default"/> has none, all zero moves nothing.</summary>
    public ServoSettings ServoSettings;
    /// <summary>Stiffness of the connection; the default is rigid.</summary>
    public SpringSettings SpringSettings;

    /// <summary>Describes a distance without limits of speed and force.</summary>
    /// <param name="localOffsetA">Anchor in A's frame, m.</param>
    /// <param name="localOffsetB">Anchor in B's frame, m.</param>
    /// <param name="targetDistance">Distance between the anchors, m; not negative.</param>
    /// <param name="springSettings">Stiffness of the connection.</param>
    public DistanceServo(Vector3 localOffsetA, Vector3 localOffsetB, float targetDistance, in SpringSettings springSettings) :
        this(localOffsetA, localOffsetB, targetDistance, springSettings, ServoSettings.Default)
    {
    }

    /// <summary>Describes a distance with limits of speed and force.</summary>
    /// <param name="localOffsetA">Anchor in A's frame, m.</param>
    /// <param name="localOffsetB">Anchor in B's frame, m.</param>
    /// <param name="targetDistance">Distance between the anchors, m; not negative.</param>
    /// <param name="springSettings">Stiffness of the connection.</param>
    /// <param name="servoSettings">Limits of speed and force.</param>
    public DistanceServo(
        Vector3 localOffsetA, Vector3 localOffsetB, float targetDistance, in SpringSettings springSettings, in ServoSettings servoSettings)
    {
        (LocalOffsetA, LocalOffsetB, TargetDistance) = (localOffsetA, localOffsetB, targetDistance);
        (ServoSettings, SpringSettings) = (servoSettings, springSettings);
    }

    /// <inheritdoc/>
    public static int ConstraintTypeId => ConstraintTypeIds.DistanceServo;
    /// <inheritdoc/>
    public static TypeProcessor CreateTypeProcessor() => new TypeProcessor<
        TwoBodies, DistanceServoWide, Rows1, JointConstraint<TwoBodies, DistanceServoWide, LinearRow, Rows1, Rows1, DistanceServoJoint>>();
    /// <inheritdoc/>
    public static void Validate(in DistanceServo description)
    {
        ConstraintChecks.Offset(description.LocalOffsetA, nameof(LocalOffsetA));
        ConstraintChecks.Offset(description.LocalOffsetB, nameof(LocalOffsetB));
        ConstraintChecks.Distance(description.TargetDistance, nameof(TargetDistance));
        ConstraintChecks.Servo(description.ServoSettings, nameof(ServoSettings));
        ConstraintChecks.Spring(description.SpringSettings, nameof(SpringSettings));
    }
}

/// <summary>A bundle of <see cref="DistanceServo"/>.</summary>
struct DistanceServoWide : IWide<DistanceServo>
{
    /// <inheritdoc cref="DistanceServo.LocalOffsetA"/>
    public Vector3Wide LocalOffsetA;
    /// <inheritdoc cref="DistanceServo.LocalOffsetB"/>
    public Vector3Wide LocalOffsetB;
    /// <inheritdoc cref="DistanceServo.TargetDistance"/>
    public Vector<float> TargetDistance;
    /// <inheritdoc cref="DistanceServo.ServoSettings"/>
    public ServoSettingsWide ServoSettings;
    /// <inheritdoc cref="DistanceServo.SpringSettings"/>
    public SpringSettingsWide SpringSettings;
}

/// <summary>Row of <see cref="DistanceServo"/>.</summary>
// C = target - |pB - pA|
readonly struct DistanceServoJoint : IJacobianJoint<TwoBodies, DistanceServoWide, LinearRow, Rows1, Rows1>
{
    /// <inheritdoc/>
    public static bool TurnsByError => true;
    /// <inheritdoc/>
    public static RowKind Kind => RowKind.Servo;
    /// <inheritdoc/>
    public static bool CarriesBodies => true;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Prepare(in TwoBodies bodies, in DistanceServoWide prestep, out LinearRow geometry) =>
        LinearRow.BetweenPoints(bodies, prestep.LocalOffsetA, prestep.LocalOffsetB, out geometry);

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void PositionError(in TwoBodies bodies, in DistanceServoWide prestep, in LinearRow geometry, out Rows1 error) =>
        error.X = prestep.TargetDistance - geometry.Distance;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static ServoSettingsWide Servo(in DistanceServoWide prestep) => prestep.ServoSettings;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static SpringSettingsWide Spring(in DistanceServoWide prestep) => prestep.SpringSettings;
}
