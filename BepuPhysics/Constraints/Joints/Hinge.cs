using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Keeps a point and an axis of body A on a point and an axis of body B, so that they can only turn about the axis.</summary>
/// <remarks>For doors, wheels and elbows. A <see cref="TwistLimit"/> or <see cref="TwistServo"/> beside it limits or drives the angle, an
/// <see cref="AngularAxisMotor"/> turns it. Use <see cref="SwivelHinge"/> for two axes, <see cref="BallSocket"/> for none.</remarks>
public struct Hinge : ITwoBodyConstraintDescription<Hinge>
{
    /// <summary>Anchor in A's frame, m.</summary>
    public Vector3 LocalOffsetA;
    /// <summary>Axis in A's frame; unit length.</summary>
    public Vector3 LocalHingeAxisA;
    /// <summary>Anchor in B's frame, m.</summary>
    public Vector3 LocalOffsetB;
    /// <summary>Axis in B's frame; unit length.</summary>
    public Vector3 LocalHingeAxisB;
    /// <summary>Stiffness of the connection; the default is rigid.</summary>
    public SpringSettings SpringSettings;

    /// <inheritdoc/>
    public static int ConstraintTypeId => ConstraintTypeIds.Hinge;
    /// <inheritdoc/>
    public static TypeProcessor CreateTypeProcessor() =>
        new TypeProcessor<TwoBodies, HingeWide, Rows5, JointConstraint<TwoBodies, HingeWide, PointAndTangentRows, Rows5, RowMatrix5, HingeJoint>>();
    /// <inheritdoc/>
    public static void Validate(in Hinge description)
    {
        ConstraintChecks.Offset(description.LocalOffsetA, nameof(LocalOffsetA));
        ConstraintChecks.Unit(description.LocalHingeAxisA, nameof(LocalHingeAxisA));
        ConstraintChecks.Offset(description.LocalOffsetB, nameof(LocalOffsetB));
        ConstraintChecks.Unit(description.LocalHingeAxisB, nameof(LocalHingeAxisB));
        ConstraintChecks.Spring(description.SpringSettings, nameof(SpringSettings));
    }
}

/// <summary>A bundle of <see cref="Hinge"/>.</summary>
struct HingeWide : IWide<Hinge>
{
    /// <inheritdoc cref="Hinge.LocalOffsetA"/>
    public Vector3Wide LocalOffsetA;
    /// <inheritdoc cref="Hinge.LocalHingeAxisA"/>
    public Vector3Wide LocalHingeAxisA;
    /// <inheritdoc cref="Hinge.LocalOffsetB"/>
    public Vector3Wide LocalOffsetB;
    /// <inheritdoc cref="Hinge.LocalHingeAxisB"/>
    public Vector3Wide LocalHingeAxisB;
    /// <inheritdoc cref="Hinge.SpringSettings"/>
    public SpringSettingsWide SpringSettings;
}

/// <summary>Rows of <see cref="Hinge"/>.</summary>
// C = [ (xA + rA) - (xB + rB) ; tx e ; ty e ]   e the rotation vector that turns B's axis b to A's axis a, at right angles to both,
//                                               and (tx, ty, a) a frame fixed to A
// The angular rows of the Jacobian are the derivative of e along e itself, whatever its length; across it they are where e = 0.
readonly struct HingeJoint : IPointJoint<TwoBodies, HingeWide, PointAndTangentRows, Rows5, RowMatrix5>
{
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Prepare(in TwoBodies bodies, in HingeWide prestep, out PointAndTangentRows geometry)
    {
        // The tangents are built in A's frame: built in the world they would jump somewhere as the axis turns, and the impulses with them.
        Vector3Wide.BuildOrthonormalBasis(prestep.LocalHingeAxisA, out var tangentX, out var tangentY);
        geometry.OffsetA = bodies.A.Orientation * prestep.LocalOffsetA;
        geometry.OffsetB = bodies.B.Orientation * prestep.LocalOffsetB;
        geometry.TangentX = bodies.A.Orientation * tangentX;
        geometry.TangentY = bodies.A.Orientation * tangentY;
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void PositionError(in TwoBodies bodies, in HingeWide prestep, in PointAndTangentRows geometry, out Rows5 error)
    {
        error.Linear = PointRows.Separation(bodies, geometry.OffsetA, geometry.OffsetB);
        error.Angular = AngularTangentRows.TurnToAlign(geometry.TangentX, geometry.TangentY, bodies.B.Orientation * prestep.LocalHingeAxisB);
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void LeanRows(in TwoBodies bodies, in HingeWide prestep, ref PointAndTangentRows geometry) =>
        WheelTangents.Lean(bodies, prestep.LocalHingeAxisB, geometry.OffsetB, ref geometry.TangentX, ref geometry.TangentY);

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static SpringSettingsWide Spring(in HingeWide prestep) => prestep.SpringSettings;
}
