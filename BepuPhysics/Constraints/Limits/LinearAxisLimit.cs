using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Keeps the distance of a point of body B from a plane of body A in a range: the ends of a slider.</summary>
/// <remarks>Use it beside a <see cref="Slider"/> or <see cref="PointOnLineServo"/>; alone it leaves all other motions free.</remarks>
public struct LinearAxisLimit : ITwoBodyConstraintDescription<LinearAxisLimit>
{
    /// <summary>A point of the plane in A's frame, m.</summary>
    public Vector3 LocalOffsetA;
    /// <summary>Anchor in B's frame, m.</summary>
    public Vector3 LocalOffsetB;
    /// <summary>Normal of the plane in A's frame, along which the distance is measured; unit length.</summary>
    public Vector3 LocalAxis;
    /// <summary>Least distance of B's anchor along the axis, m; negative behind A's.</summary>
    public float MinimumOffset;
    /// <summary>Greatest distance of B's anchor along the axis, m; not below the least.</summary>
    public float MaximumOffset;
    /// <summary>Stiffness of the limits; the default is rigid.</summary>
    public SpringSettings SpringSettings;

    /// <inheritdoc/>
    public static int ConstraintTypeId => ConstraintTypeIds.LinearAxisLimit;
    /// <inheritdoc/>
    public static TypeProcessor CreateTypeProcessor() => new TypeProcessor<
        TwoBodies, LinearAxisLimitWide, Rows1, JointConstraint<TwoBodies, LinearAxisLimitWide, LinearRow, Rows1, Rows1, LinearAxisLimitJoint>>();
    /// <inheritdoc/>
    public static void Validate(in LinearAxisLimit description)
    {
        ConstraintChecks.Offset(description.LocalOffsetA, nameof(LocalOffsetA));
        ConstraintChecks.Offset(description.LocalOffsetB, nameof(LocalOffsetB));
        ConstraintChecks.Unit(description.LocalAxis, nameof(LocalAxis));
        // There may be no least or greatest distance to speak of.
        ConstraintChecks.Order(description.MinimumOffset, description.MaximumOffset, nameof(MinimumOffset), nameof(MaximumOffset));
        ConstraintChecks.Spring(description.SpringSettings, nameof(SpringSettings));
    }
}

/// <summary>A bundle of <see cref="LinearAxisLimit"/>.</summary>
struct LinearAxisLimitWide : IWide<LinearAxisLimit>
{
    /// <inheritdoc cref="LinearAxisLimit.LocalOffsetA"/>
    public Vector3Wide LocalOffsetA;
    /// <inheritdoc cref="LinearAxisLimit.LocalOffsetB"/>
    public Vector3Wide LocalOffsetB;
    /// <inheritdoc cref="LinearAxisLimit.LocalAxis"/>
    public Vector3Wide LocalAxis;
    /// <inheritdoc cref="LinearAxisLimit.MinimumOffset"/>
    public Vector<float> MinimumOffset;
    /// <inheritdoc cref="LinearAxisLimit.MaximumOffset"/>
    public Vector<float> MaximumOffset;
    /// <inheritdoc cref="LinearAxisLimit.SpringSettings"/>
    public SpringSettingsWide SpringSettings;
}

/// <summary>Row of <see cref="LinearAxisLimit"/>.</summary>
// C = maximum - n (pB - pA) >= 0  along n,  or  n (pB - pA) - minimum >= 0  along -n,  whichever limit is nearer
readonly struct LinearAxisLimitJoint : IJacobianJoint<TwoBodies, LinearAxisLimitWide, LinearRow, Rows1, Rows1>
{
    /// <inheritdoc/>
    public static RowKind Kind => RowKind.Inequality;
    /// <inheritdoc/>
    public static bool CarriesBodies => true;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Prepare(in TwoBodies bodies, in LinearAxisLimitWide prestep, out LinearRow geometry)
    {
        var axis = new AxisThroughPoints(bodies, prestep.LocalOffsetA, prestep.LocalOffsetB, prestep.LocalAxis);
        var slack = LinearRow.NearerLimit(axis.Distance, prestep.MinimumOffset, prestep.MaximumOffset, new Vector<int>(-1), out var sign);
        axis.Direction *= sign;
        axis.RowTo(out geometry);
        geometry.Distance = slack;
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void PositionError(in TwoBodies bodies, in LinearAxisLimitWide prestep, in LinearRow geometry, out Rows1 error) =>
        error.X = geometry.Distance;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static SpringSettingsWide Spring(in LinearAxisLimitWide prestep) => prestep.SpringSettings;
}
