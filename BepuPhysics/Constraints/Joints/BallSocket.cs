using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Keeps a point of body A on a point of body B.</summary>
/// <remarks>Use <see cref="Hinge"/> or <see cref="SwivelHinge"/> where it may not turn freely, and a <see cref="SwingLimit"/> and
/// <see cref="TwistLimit"/> beside it for shoulders and hips; <see cref="BallSocketServo"/> has a greatest force.</remarks>
public struct BallSocket : ITwoBodyConstraintDescription<BallSocket>
{
    /// <summary>Anchor in A's frame, m.</summary>
    public Vector3 LocalOffsetA;
    /// <summary>Anchor in B's frame, m.</summary>
    public Vector3 LocalOffsetB;
    /// <summary>Stiffness of the connection; the default is rigid.</summary>
    public SpringSettings SpringSettings;

    /// <inheritdoc/>
    public static int ConstraintTypeId => ConstraintTypeIds.BallSocket;
    /// <inheritdoc/>
    public static TypeProcessor CreateTypeProcessor() =>
        new TypeProcessor<TwoBodies, BallSocketWide, Rows3,
            JointConstraint<TwoBodies, BallSocketWide, PointRows, Rows3, RowMatrix3, BallSocketJoint>>();
    /// <inheritdoc/>
    public static void Validate(in BallSocket description)
    {
        ConstraintChecks.Offset(description.LocalOffsetA, nameof(LocalOffsetA));
        ConstraintChecks.Offset(description.LocalOffsetB, nameof(LocalOffsetB));
        ConstraintChecks.Spring(description.SpringSettings, nameof(SpringSettings));
    }
}

/// <summary>A bundle of <see cref="BallSocket"/>.</summary>
struct BallSocketWide : IWide<BallSocket>
{
    /// <inheritdoc cref="BallSocket.LocalOffsetA"/>
    public Vector3Wide LocalOffsetA;
    /// <inheritdoc cref="BallSocket.LocalOffsetB"/>
    public Vector3Wide LocalOffsetB;
    /// <inheritdoc cref="BallSocket.SpringSettings"/>
    public SpringSettingsWide SpringSettings;
}

/// <summary>Rows of <see cref="BallSocket"/>.</summary>
// C = (xA + rA) - (xB + rB)
readonly struct BallSocketJoint : IPointJoint<TwoBodies, BallSocketWide, PointRows, Rows3, RowMatrix3>
{
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Prepare(in TwoBodies bodies, in BallSocketWide prestep, out PointRows geometry)
    {
        geometry.OffsetA = bodies.A.Orientation * prestep.LocalOffsetA;
        geometry.OffsetB = bodies.B.Orientation * prestep.LocalOffsetB;
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void PositionError(in TwoBodies bodies, in BallSocketWide prestep, in PointRows geometry, out Rows3 error) =>
        error.V = PointRows.Separation(bodies, geometry.OffsetA, geometry.OffsetB);

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static SpringSettingsWide Spring(in BallSocketWide prestep) => prestep.SpringSettings;
}
