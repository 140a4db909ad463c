using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Keeps the centres of two bodies at a distance from each other.</summary>
/// <remarks>Cheaper than a <see cref="DistanceServo"/>, which has anchors, and all that lattices of particles need;
/// <see cref="CenterDistanceLimit"/> has a range.</remarks>
public struct CenterDistanceConstraint : ITwoBodyConstraintDescription<CenterDistanceConstraint>
{
    /// <summary>Distance between the centres, m; not negative.</summary>
    public float TargetDistance;
    /// <summary>Stiffness of the connection; the default is rigid.</summary>
    public SpringSettings SpringSettings;

    /// <summary>Describes a distance.</summary>
    /// <param name="targetDistance">Distance between the centres, m; not negative.</param>
    /// <param name="springSettings">Stiffness of the connection.</param>
    public CenterDistanceConstraint(float targetDistance, in SpringSettings springSettings)
    {
        TargetDistance = targetDistance;
        SpringSettings = springSettings;
    }

    /// <inheritdoc/>
    public static int ConstraintTypeId => ConstraintTypeIds.CenterDistanceConstraint;
    /// <inheritdoc/>
    public static TypeProcessor CreateTypeProcessor() => new TypeProcessor<
        TwoBodies, CenterDistanceConstraintWide, Rows1,
        JointConstraint<TwoBodies, CenterDistanceConstraintWide, CenterRow, Rows1, Rows1, CenterDistanceConstraintJoint>>();
    /// <inheritdoc/>
    public static void Validate(in CenterDistanceConstraint description)
    {
        ConstraintChecks.Distance(description.TargetDistance, nameof(TargetDistance));
        ConstraintChecks.Spring(description.SpringSettings, nameof(SpringSettings));
    }
}

/// <summary>A bundle of <see cref="CenterDistanceConstraint"/>.</summary>
struct CenterDistanceConstraintWide : IWide<CenterDistanceConstraint>
{
    /// <inheritdoc cref="CenterDistanceConstraint.TargetDistance"/>
    public Vector<float> TargetDistance;
    /// <inheritdoc cref="CenterDistanceConstraint.SpringSettings"/>
    public SpringSettingsWide SpringSettings;
}

/// <summary>Row of <see cref="CenterDistanceConstraint"/>.</summary>
// C = target - |xB - xA|
readonly struct CenterDistanceConstraintJoint : IJacobianJoint<TwoBodies, CenterDistanceConstraintWide, CenterRow, Rows1, Rows1>
{
    /// <inheritdoc/>
    public static bool CarriesBodies => true;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Prepare(in TwoBodies bodies, in CenterDistanceConstraintWide prestep, out CenterRow geometry) =>
        CenterRow.Prepare(bodies, out geometry);

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void PositionError(in TwoBodies bodies, in CenterDistanceConstraintWide prestep, in CenterRow geometry, out Rows1 error) =>
        error.X = prestep.TargetDistance - geometry.Distance;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static SpringSettingsWide Spring(in CenterDistanceConstraintWide prestep) => prestep.SpringSettings;
}
