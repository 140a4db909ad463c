using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Pulls a point of a body to a point of the world.</summary>
/// <remarks>For what is grabbed with a mouse or a hand: change the target as it moves. Use <see cref="BallSocketServo"/> for a point of another
/// body.</remarks>
public struct OneBodyLinearServo : IOneBodyConstraintDescription<OneBodyLinearServo>
{
    /// <summary>Point that is pulled, in the body's frame, m.</summary>
    public Vector3 LocalOffset;
    /// <summary>Where it is pulled to, in the world, m.</summary>
    public Vector3 Target;
    /// <summary>Stiffness of the pull; the default is rigid.</summary>
    public SpringSettings SpringSettings;
    /// <summary>Limits of speed and force; <see cref="ServoSettings.Default"/> has none, all zero moves nothing.</summary>
    public ServoSettings ServoSettings;

    /// <inheritdoc/>
    public static int ConstraintTypeId => ConstraintTypeIds.OneBodyLinearServo;
    /// <inheritdoc/>
    public static TypeProcessor CreateTypeProcessor() => new TypeProcessor<
        OneBody, OneBodyLinearServoWide, Rows3,
        JointConstraint<OneBody, OneBodyLinearServoWide, OneBodyPointRows, Rows3, RowMatrix3, OneBodyLinearServoJoint>>();
    /// <inheritdoc/>
    public static void Validate(in OneBodyLinearServo description)
    {
        ConstraintChecks.Offset(description.LocalOffset, nameof(LocalOffset));
        ConstraintChecks.Position(description.Target, nameof(Target));
        ConstraintChecks.Spring(description.SpringSettings, nameof(SpringSettings));
        ConstraintChecks.Servo(description.ServoSettings, nameof(ServoSettings));
    }
}

/// <summary>A bundle of <see cref="OneBodyLinearServo"/>.</summary>
struct OneBodyLinearServoWide : IWide<OneBodyLinearServo>
{
    /// <inheritdoc cref="OneBodyLinearServo.LocalOffset"/>
    public Vector3Wide LocalOffset;
    /// <inheritdoc cref="OneBodyLinearServo.Target"/>
    public Vector3Wide Target;
    /// <inheritdoc cref="OneBodyLinearServo.SpringSettings"/>
    public SpringSettingsWide SpringSettings;
    /// <inheritdoc cref="OneBodyLinearServo.ServoSettings"/>
    public ServoSettingsWide ServoSettings;
}

/// <summary>Rows of <see cref="OneBodyLinearServo"/>.</summary>
// C = (x + r) - target
readonly struct OneBodyLinearServoJoint : IJacobianJoint<OneBody, OneBodyLinearServoWide, OneBodyPointRows, Rows3, RowMatrix3>
{
    /// <inheritdoc/>
    public static BodyAccess ErrorAccess => BodyAccess.Position;
    /// <inheritdoc/>
    public static RowKind Kind => RowKind.Servo;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Prepare(in OneBody bodies, in OneBodyLinearServoWide prestep, out OneBodyPointRows geometry) =>
        geometry.Offset = bodies.A.Orientation * prestep.LocalOffset;

    /// <inheritdoc/>
    // Position and target are subtracted first: far from the origin their difference is still exact.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void PositionError(in OneBody bodies, in OneBodyLinearServoWide prestep, in OneBodyPointRows geometry, out Rows3 error) =>
        error.V = (bodies.A.Position - prestep.Target) + geometry.Offset;

    /// <inheritdoc/>
    public static bool HasPlaces => true;

    /// <inheritdoc/>
    public static void ShiftOrigin(ref OneBodyLinearServoWide prestep, in Vector3Wide shift) => prestep.Target -= shift;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static SpringSettingsWide Spring(in OneBodyLinearServoWide prestep) => prestep.SpringSettings;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static ServoSettingsWide Servo(in OneBodyLinearServoWide prestep) => prestep.ServoSettings;
}
