using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Keeps a point of body B on a line of body A, along which it slides freely.</summary>
/// <remarks>Use <see cref="Slider"/> where the bodies may not turn against each other either.</remarks>
public struct PointOnLineServo : ITwoBodyConstraintDescription<PointOnLineServo>
{
    /// <summary>A point of the line in A's frame, m.</summary>
    public Vector3 LocalOffsetA;
    /// <summary>Anchor in B's frame, m.</summary>
    public Vector3 LocalOffsetB;
    /// <summary>Direction of the line in A's frame; unit length.</summary>
    public Vector3 LocalDirection;
    /// <summary>Limits of speed and force; <see cref="ServoSettings.Default"/> has none, all zero moves nothing.</summary>
    public ServoSettings ServoSettings;
    /// <summary>Stiffness of the connection; the default is rigid.</summary>
    public SpringSettings SpringSettings;

    /// <inheritdoc/>
    public static int ConstraintTypeId => ConstraintTypeIds.PointOnLineServo;
    /// <inheritdoc/>
    public static TypeProcessor CreateTypeProcessor() => new TypeProcessor<
        TwoBodies, PointOnLineServoWide, Rows2,
        JointConstraint<TwoBodies, PointOnLineServoWide, LinearTangentRows, Rows2, RowMatrix2, PointOnLineServoJoint>>();
    /// <inheritdoc/>
    public static void Validate(in PointOnLineServo description)
    {
        ConstraintChecks.Offset(description.LocalOffsetA, nameof(LocalOffsetA));
        ConstraintChecks.Offset(description.LocalOffsetB, nameof(LocalOffsetB));
        ConstraintChecks.Unit(description.LocalDirection, nameof(LocalDirection));
        ConstraintChecks.Servo(description.ServoSettings, nameof(ServoSettings));
        ConstraintChecks.Spring(description.SpringSettings, nameof(SpringSettings));
    }
}

/// <summary>A bundle of <see cref="PointOnLineServo"/>.</summary>
struct PointOnLineServoWide : IWide<PointOnLineServo>
{
    /// <inheritdoc cref="PointOnLineServo.LocalOffsetA"/>
    public Vector3Wide LocalOffsetA;
    /// <inheritdoc cref="PointOnLineServo.LocalOffsetB"/>
    public Vector3Wide LocalOffsetB;
    /// <inheritdoc cref="PointOnLineServo.LocalDirection"/>
    public Vector3Wide LocalDirection;
    /// <inheritdoc cref="PointOnLineServo.ServoSettings"/>
    public ServoSettingsWide ServoSettings;
    /// <inheritdoc cref="PointOnLineServo.SpringSettings"/>
    public SpringSettingsWide SpringSettings;
}

/// <summary>Rows of <see cref="PointOnLineServo"/>.</summary>
// C = [ tx ; ty ] (pA - pB)   pA and pB the points in the world, (tx, ty, direction) a frame fixed to A
// The tangents turn with A, so that its arm ends where B's point is: wA (tx x (pA - pB)) + wA (rA x tx) = wA ((rA + pB - pA) x tx).
readonly struct PointOnLineServoJoint : IJacobianJoint<TwoBodies, PointOnLineServoWide, LinearTangentRows, Rows2, RowMatrix2>
{
    /// <inheritdoc/>
    public static bool PullsAtPoints => true;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void PointLoad(
        in LinearTangentRows geometry, in Rows2 impulses, out Vector3Wide impulse, out Vector3Wide offsetA, out Vector3Wide offsetB) =>
        geometry.Load(impulses.V, out impulse, out offsetA, out offsetB);

    /// <inheritdoc/>
    public static bool TurnsByError => true;
    /// <inheritdoc/>
    public static RowKind Kind => RowKind.Servo;
    /// <inheritdoc/>
    public static bool CarriesBodies => true;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Prepare(in TwoBodies bodies, in PointOnLineServoWide prestep, out LinearTangentRows geometry)
    {
        // Built in A's frame: built in the world the tangents would jump somewhere as the line turns, and the impulses with them.
        Vector3Wide.BuildOrthonormalBasis(prestep.LocalDirection, out var tangentX, out var tangentY);
        geometry.OffsetB = bodies.B.Orientation * prestep.LocalOffsetB;
        geometry.OffsetA = (bodies.B.Position - bodies.A.Position) + geometry.OffsetB;
        geometry.TangentX = bodies.A.Orientation * tangentX;
        geometry.TangentY = bodies.A.Orientation * tangentY;
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void PositionError(in TwoBodies bodies, in PointOnLineServoWide prestep, in LinearTangentRows geometry, out Rows2 error)
    {
        var separation = bodies.A.Orientation * prestep.LocalOffsetA - geometry.OffsetA;
        error.V = new(Vector3Wide.Dot(geometry.TangentX, separation), Vector3Wide.Dot(geometry.TangentY, separation));
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static SpringSettingsWide Spring(in PointOnLineServoWide prestep) => prestep.SpringSettings;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static ServoSettingsWide Servo(in PointOnLineServoWide prestep) => prestep.ServoSettings;
}
