using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Moves a point of body B at a velocity, seen from body A.</summary>
/// <remarks>Use <see cref="BallSocketServo"/> to reach a place, <see cref="LinearAxisMotor"/> to move along one axis only.</remarks>
public struct BallSocketMotor : ITwoBodyConstraintDescription<BallSocketMotor>
{
    /// <summary>The point in B's frame, m.</summary>
    public Vector3 LocalOffsetB;
    /// <summary>Velocity of B less that of A where the point is, in A's frame, m/s.</summary>
    public Vector3 TargetVelocityLocalA;
    /// <summary>Greatest force in any direction, N, and softness.</summary>
    public MotorSettings Settings;

    /// <inheritdoc/>
    public static int ConstraintTypeId => ConstraintTypeIds.BallSocketMotor;
    /// <inheritdoc/>
    public static TypeProcessor CreateTypeProcessor() => new TypeProcessor<
        TwoBodies, BallSocketMotorWide, Rows3,
        JointConstraint<TwoBodies, BallSocketMotorWide, PointRows, Rows3, RowMatrix3, BallSocketMotorJoint>>();
    /// <inheritdoc/>
    public static void Validate(in BallSocketMotor description)
    {
        ConstraintChecks.Offset(description.LocalOffsetB, nameof(LocalOffsetB));
        ConstraintChecks.LinearVelocity(description.TargetVelocityLocalA, nameof(TargetVelocityLocalA));
        ConstraintChecks.Motor(description.Settings, nameof(Settings));
    }
}

/// <summary>A bundle of <see cref="BallSocketMotor"/>.</summary>
struct BallSocketMotorWide : IWide<BallSocketMotor>
{
    /// <inheritdoc cref="BallSocketMotor.LocalOffsetB"/>
    public Vector3Wide LocalOffsetB;
    /// <inheritdoc cref="BallSocketMotor.TargetVelocityLocalA"/>
    public Vector3Wide TargetVelocityLocalA;
    /// <inheritdoc cref="BallSocketMotor.Settings"/>
    public MotorSettingsWide Settings;
}

/// <summary>Rows of <see cref="BallSocketMotor"/>.</summary>
// J v = (vA + wA x (pB - xA)) - (vB + wB x rB) = -target, turned into the world with A; pB the point in the world
readonly struct BallSocketMotorJoint :
    IMotor<TwoBodies, BallSocketMotorWide, PointRows, Rows3, RowMatrix3>,
    IJacobianJoint<TwoBodies, BallSocketMotorWide, PointRows, Rows3, RowMatrix3>
{
    /// <inheritdoc/>
    public static bool PullsAtPoints => true;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void PointLoad(in PointRows geometry, in Rows3 impulses, out Vector3Wide impulse, out Vector3Wide offsetA, out Vector3Wide offsetB) =>
        PointRows.PointLoad(geometry, impulses, out impulse, out offsetA, out offsetB);

    /// <inheritdoc/>
    public static BodyAccess Access => BodyAccess.Pose | BodyAccess.Velocity | BodyAccess.Mass;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Prepare(in TwoBodies bodies, in BallSocketMotorWide prestep, out PointRows geometry)
    {
        geometry.OffsetB = bodies.B.Orientation * prestep.LocalOffsetB;
        geometry.OffsetA = (bodies.B.Position - bodies.A.Position) + geometry.OffsetB;
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void TargetVelocity(in TwoBodies bodies, in BallSocketMotorWide prestep, in PointRows geometry, out Rows3 velocity) =>
        velocity.V = -(bodies.A.Orientation * prestep.TargetVelocityLocalA);

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static MotorSettingsWide Motor(in BallSocketMotorWide prestep) => prestep.Settings;
}
