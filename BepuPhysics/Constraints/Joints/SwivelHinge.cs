using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Keeps a point of body A on a point of body B and an axis of A at right angles to one of B: a universal joint.</summary>
/// <remarks>For cardan shafts and gimbals. Use <see cref="Hinge"/> where only one axis is free, <see cref="BallSocket"/> where all are.</remarks>
public struct SwivelHinge : ITwoBodyConstraintDescription<SwivelHinge>
{
    /// <summary>Anchor in A's frame, m.</summary>
    public Vector3 LocalOffsetA;
    /// <summary>Axis in A's frame; unit length.</summary>
    public Vector3 LocalSwivelAxisA;
    /// <summary>Anchor in B's frame, m.</summary>
    public Vector3 LocalOffsetB;
    /// <summary>Axis in B's frame; unit length.</summary>
    public Vector3 LocalHingeAxisB;
    /// <summary>Stiffness of the connection; the default is rigid.</summary>
    public SpringSettings SpringSettings;

    /// <inheritdoc/>
    public static int ConstraintTypeId => ConstraintTypeIds.SwivelHinge;
    /// <inheritdoc/>
    public static TypeProcessor CreateTypeProcessor() => new TypeProcessor<
        TwoBodies, SwivelHingeWide, Rows4, JointConstraint<TwoBodies, SwivelHingeWide, PointAndAxesRows, Rows4, RowMatrix4, SwivelHingeJoint>>();
    /// <inheritdoc/>
    public static void Validate(in SwivelHinge description)
    {
        ConstraintChecks.Offset(description.LocalOffsetA, nameof(LocalOffsetA));
        ConstraintChecks.Unit(description.LocalSwivelAxisA, nameof(LocalSwivelAxisA));
        ConstraintChecks.Offset(description.LocalOffsetB, nameof(LocalOffsetB));
        ConstraintChecks.Unit(description.LocalHingeAxisB, nameof(LocalHingeAxisB));
        ConstraintChecks.Spring(description.SpringSettings, nameof(SpringSettings));
    }
}

/// <summary>A bundle of <see cref="SwivelHinge"/>.</summary>
struct SwivelHingeWide : IWide<SwivelHinge>
{
    /// <inheritdoc cref="SwivelHinge.LocalOffsetA"/>
    public Vector3Wide LocalOffsetA;
    /// <inheritdoc cref="SwivelHinge.LocalSwivelAxisA"/>
    public Vector3Wide LocalSwivelAxisA;
    /// <inheritdoc cref="SwivelHinge.LocalOffsetB"/>
    public Vector3Wide LocalOffsetB;
    /// <inheritdoc cref="SwivelHinge.LocalHingeAxisB"/>
    public Vector3Wide LocalHingeAxisB;
    /// <inheritdoc cref="SwivelHinge.SpringSettings"/>
    public SpringSettingsWide SpringSettings;
}

/// <summary>Rows of <see cref="SwivelHinge"/>.</summary>
// C = [ (xA + rA) - (xB + rB) ; a quarter turn - angle(a, b) ]
readonly struct SwivelHingeJoint : IPointJoint<TwoBodies, SwivelHingeWide, PointAndAxesRows, Rows4, RowMatrix4>
{
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Prepare(in TwoBodies bodies, in SwivelHingeWide prestep, out PointAndAxesRows geometry)
    {
        geometry.OffsetA = bodies.A.Orientation * prestep.LocalOffsetA;
        geometry.OffsetB = bodies.B.Orientation * prestep.LocalOffsetB;
        AxesRow.Prepare(bodies, prestep.LocalSwivelAxisA, prestep.LocalHingeAxisB, out geometry.Axes);
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void PositionError(in TwoBodies bodies, in SwivelHingeWide prestep, in PointAndAxesRows geometry, out Rows4 error)
    {
        error.Linear = PointRows.Separation(bodies, geometry.OffsetA, geometry.OffsetB);
        error.Angular = AxesRow.LackOfQuarterTurn(geometry.Axes);
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static SpringSettingsWide Spring(in SwivelHingeWide prestep) => prestep.SpringSettings;
}
