using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Pulls a point of a body to a point of the world.</summary>
public struct OneBodyLinearServo : IOneBodyConstraintDescription<OneBodyLinearServo>
{
    /// <summary>Point that is pulled, in the body's frame, m.</summary>
    public Vector3 LocalOffset;
    /// <summary>Where it is pulled to, in the world, m.</summary>
    public Vector3 Target;
    /// <summary>Stiffness of the pull; the default is rigid.</summary>
    public SpringSettings SpringSettings;
    /// <summary>Limits of speed and force.</summary>
    public ServoSettings ServoSettings;

    /// <inheritdoc/>
    public static int ConstraintTypeId => ConstraintTypeIds.OneBodyLinearServo;
    /// <inheritdoc/>
    public static TypeProcessor CreateTypeProcessor() => new TypeProcessor<
        OneBody, OneBodyLinearServoWide, Rows3,
        JointConstraint<OneBody, OneBodyLinearServoWide, OneBodyLinearServoGeometry, Rows3, RowMatrix3, OneBodyLinearServoJoint>>();
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

/// <summary>Lever arm of a pulled point in world axes.</summary>
struct OneBodyLinearServoGeometry
{
    /// <summary>From the centre of the body to the point.</summary>
    public Vector3Wide Offset;
}

/// <summary>Rows of <see cref="OneBodyLinearServo"/>.</summary>
// C = (x + r) - target
// J = [ I, -skew(r) ]   over (v, w), with skew(r) w = r x w
// K = 1/m I + skew(r) I^-1 skew(r)^T
readonly struct OneBodyLinearServoJoint : IJoint<OneBody, OneBodyLinearServoWide, OneBodyLinearServoGeometry, Rows3, RowMatrix3>
{
    /// <inheritdoc/>
    public static RowKind Kind => RowKind.Servo;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Prepare(in OneBody bodies, in OneBodyLinearServoWide prestep, out OneBodyLinearServoGeometry geometry) =>
        geometry.Offset = bodies.A.Orientation * prestep.LocalOffset;

    /// <inheritdoc/>
    // Position and target are subtracted first: far from the origin their difference is still exact.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void PositionError(in OneBody bodies, in OneBodyLinearServoWide prestep, in OneBodyLinearServoGeometry geometry, out Rows3 error) =>
        error.V = (bodies.A.Position - prestep.Target) + geometry.Offset;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void RelativeVelocity(in OneBodyLinearServoGeometry geometry, in OneBody bodies, out Rows3 velocity) =>
        velocity.V = bodies.A.Linear + Vector3Wide.Cross(bodies.A.Angular, geometry.Offset);

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void ApplyImpulse(in OneBodyLinearServoGeometry geometry, ref OneBody bodies, in Rows3 impulse)
    {
        bodies.A.Linear += impulse.V * bodies.A.InverseMass;
        bodies.A.Angular += bodies.A.InverseInertia * Vector3Wide.Cross(geometry.Offset, impulse.V);
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void InverseEffectiveMass(in OneBodyLinearServoGeometry geometry, in OneBody bodies, out RowMatrix3 inverseMass) =>
        inverseMass.M = Symmetric3x3Wide.AddDiagonal(Symmetric3x3Wide.SkewSandwich(geometry.Offset, bodies.A.InverseInertia), bodies.A.InverseMass);

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static SpringSettingsWide Spring(in OneBodyLinearServoWide prestep) => prestep.SpringSettings;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static ServoSettingsWide Servo(in OneBodyLinearServoWide prestep) => prestep.ServoSettings;
}
