using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Keeps the distance between a point of body A and a point of body B in a range.</summary>
/// <param name="localOffsetA">Anchor in A's frame, m.</param>
/// <param name="localOffsetB">Anchor in B's frame, m.</param>
/// <param name="minimumDistance">Least distance, m; not negative.</param>
/// <param name="maximumDistance">Greatest distance, m; not below the least.</param>
/// <param name="springSettings">Stiffness of the limits.</param>
/// <remarks>For ropes, with a least distance of zero. Use <see cref="DistanceServo"/> for a rod or a spring, <see cref="Pulley"/> for a rope
/// that runs over wheels.</remarks>
public struct DistanceLimit(Vector3 localOffsetA, Vector3 localOffsetB, float minimumDistance, float maximumDistance, in SpringSettings springSettings) :
    ITwoBodyConstraintDescription<DistanceLimit>
{
    /// <summary>Anchor in A's frame, m.</summary>
    public Vector3 LocalOffsetA = localOffsetA;
    /// <summary>Anchor in B's frame, m.</summary>
    public Vector3 LocalOffsetB = localOffsetB;
    /// <summary>Least distance, m; 0 for a rope, which keeps only the greatest.</summary>
    public float MinimumDistance = minimumDistance;
    /// <summary>Greatest distance, m; not below the least.</summary>
    public float MaximumDistance = maximumDistance;
    /// <summary>Stiffness of the limits; the default is rigid.</summary>
    public SpringSettings SpringSettings = springSettings;

    /// <inheritdoc/>
    public static int ConstraintTypeId => ConstraintTypeIds.DistanceLimit;
    /// <inheritdoc/>
    public static TypeProcessor CreateTypeProcessor() => new TypeProcessor<
        TwoBodies, DistanceLimitWide, Rows1, JointConstraint<TwoBodies, DistanceLimitWide, LinearRow, Rows1, Rows1, DistanceLimitJoint>>();
    /// <inheritdoc/>
    public static void Validate(in DistanceLimit description)
    {
        ConstraintChecks.Offset(description.LocalOffsetA, nameof(LocalOffsetA));
        ConstraintChecks.Offset(description.LocalOffsetB, nameof(LocalOffsetB));
        // There may be no greatest distance to speak of.
        ConstraintChecks.Distance(description.MinimumDistance, nameof(MinimumDistance));
        ConstraintChecks.Order(description.MinimumDistance, description.MaximumDistance, nameof(MinimumDistance), nameof(MaximumDistance));
        ConstraintChecks.Spring(description.SpringSettings, nameof(SpringSettings));
    }
}

/// <summary>A bundle of <see cref="DistanceLimit"/>.</summary>
struct DistanceLimitWide : IWide<DistanceLimit>
{
    /// <inheritdoc cref="DistanceLimit.LocalOffsetA"/>
    public Vector3Wide LocalOffsetA;
    /// <inheritdoc cref="DistanceLimit.LocalOffsetB"/>
    public Vector3Wide LocalOffsetB;
    /// <inheritdoc cref="DistanceLimit.MinimumDistance"/>
    public Vector<float> MinimumDistance;
    /// <inheritdoc cref="DistanceLimit.MaximumDistance"/>
    public Vector<float> MaximumDistance;
    /// <inheritdoc cref="DistanceLimit.SpringSettings"/>
    public SpringSettingsWide SpringSettings;
}

/// <summary>Row of <see cref="DistanceLimit"/>.</summary>
// d = (xB + rB) - (xA + rA),  u = d / |d|
// C = maximum - |d| >= 0  with n = u,  or  |d| - minimum >= 0  with n = -u,  whichever limit is nearer
// A minimum of zero cannot be violated, so such a lane always watches its maximum: the anchors of a slack rope may pass through
// each other.
readonly struct DistanceLimitJoint : IJacobianJoint<TwoBodies, DistanceLimitWide, LinearRow, Rows1, Rows1>
{
    /// <inheritdoc/>
    public static bool TurnsByError => true;
    /// <inheritdoc/>
    public static RowKind Kind => RowKind.Inequality;
    /// <inheritdoc/>
    public static bool CarriesBodies => true;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Prepare(in TwoBodies bodies, in DistanceLimitWide prestep, out LinearRow geometry)
    {
        var offsetA = bodies.A.Orientation * prestep.LocalOffsetA;
        var offsetB = bodies.B.Orientation * prestep.LocalOffsetB;
        // The positions are subtracted first: far from the origin their difference is still exact.
        var difference = (bodies.B.Position - bodies.A.Position) + (offsetB - offsetA);
        var lengthSquared = difference.LengthSquared();
        var length = Vector.SquareRoot(lengthSquared);
        geometry.Distance = LinearRow.NearerLimit(
            length, prestep.MinimumDistance, prestep.MaximumDistance, Vector.GreaterThan(prestep.MinimumDistance, Vector<float>.Zero), out var sign);
        geometry.Direction = LinearRow.DirectionOf(difference, lengthSquared, length, sign);
        geometry.AngularA = Vector3Wide.Cross(offsetA, geometry.Direction);
        geometry.AngularB = Vector3Wide.Cross(offsetB, geometry.Direction);
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void PositionError(in TwoBodies bodies, in DistanceLimitWide prestep, in LinearRow geometry, out Rows1 error) =>
        error.X = geometry.Distance;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static SpringSettingsWide Spring(in DistanceLimitWide prestep) => prestep.SpringSettings;
}
