using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Keeps the distance between the centres of two bodies in a range.</summary>
/// <remarks>Use <see cref="DistanceLimit"/> where it is fastened to points of the bodies.</remarks>
public struct CenterDistanceLimit : ITwoBodyConstraintDescription<CenterDistanceLimit>
{
    /// <summary>Least distance, m; 0 for a rope, which keeps only the greatest.</summary>
    public float MinimumDistance;
    /// <summary>Greatest distance, m; not below the least.</summary>
    public float MaximumDistance;
    /// <summary>Stiffness of the limits; the default is rigid.</summary>
    public SpringSettings SpringSettings;

    /// <summary>Describes a range of distances.</summary>
    /// <param name="minimumDistance">Least distance, m; not negative.</param>
    /// <param name="maximumDistance">Greatest distance, m; not below the least.</param>
    /// <param name="springSettings">Stiffness of the limits.</param>
    public CenterDistanceLimit(float minimumDistance, float maximumDistance, in SpringSettings springSettings) =>
        (MinimumDistance, MaximumDistance, SpringSettings) = (minimumDistance, maximumDistance, springSettings);

    /// <inheritdoc/>
    public static int ConstraintTypeId => ConstraintTypeIds.CenterDistanceLimit;
    /// <inheritdoc/>
    public static TypeProcessor CreateTypeProcessor() => new TypeProcessor<
        TwoBodies, CenterDistanceLimitWide, Rows1,
        JointConstraint<TwoBodies, CenterDistanceLimitWide, CenterRow, Rows1, Rows1, CenterDistanceLimitJoint>>();
    /// <inheritdoc/>
    public static void Validate(in CenterDistanceLimit description)
    {
        // There may be no greatest distance to speak of.
        ConstraintChecks.Distance(description.MinimumDistance, nameof(MinimumDistance));
        ConstraintChecks.Order(description.MinimumDistance, description.MaximumDistance, nameof(MinimumDistance), nameof(MaximumDistance));
        ConstraintChecks.Spring(description.SpringSettings, nameof(SpringSettings));
    }
}

/// <summary>A bundle of <see cref="CenterDistanceLimit"/>.</summary>
struct CenterDistanceLimitWide : IWide<CenterDistanceLimit>
{
    /// <inheritdoc cref="CenterDistanceLimit.MinimumDistance"/>
    public Vector<float> MinimumDistance;
    /// <inheritdoc cref="CenterDistanceLimit.MaximumDistance"/>
    public Vector<float> MaximumDistance;
    /// <inheritdoc cref="CenterDistanceLimit.SpringSettings"/>
    public SpringSettingsWide SpringSettings;
}

/// <summary>Row of <see cref="CenterDistanceLimit"/>.</summary>
// C = maximum - |xB - xA| >= 0  along the direction to B,  or  |xB - xA| - minimum >= 0  away from it,  whichever limit is nearer
readonly struct CenterDistanceLimitJoint : IJacobianJoint<TwoBodies, CenterDistanceLimitWide, CenterRow, Rows1, Rows1>
{
    /// <inheritdoc/>
    public static RowKind Kind => RowKind.Inequality;
    /// <inheritdoc/>
    public static bool CarriesBodies => true;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Prepare(in TwoBodies bodies, in CenterDistanceLimitWide prestep, out CenterRow geometry)
    {
        CenterRow.Prepare(bodies, out geometry);
        geometry.Distance = LinearRow.NearerLimit(
            geometry.Distance, prestep.MinimumDistance, prestep.MaximumDistance,
            Vector.GreaterThan(prestep.MinimumDistance, Vector<float>.Zero), out var sign);
        geometry.Direction *= sign;
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void PositionError(in TwoBodies bodies, in CenterDistanceLimitWide prestep, in CenterRow geometry, out Rows1 error) =>
        error.X = geometry.Distance;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static SpringSettingsWide Spring(in CenterDistanceLimitWide prestep) => prestep.SpringSettings;
}
