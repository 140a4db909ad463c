using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Keeps the area of the triangle between the centres of three bodies.</summary>
/// <remarks>For the triangles of cloth and soft surfaces; <see cref="VolumeConstraint"/> is for what is filled.</remarks>
public struct AreaConstraint : IThreeBodyConstraintDescription<AreaConstraint>
{
    /// <summary>Twice the area, m^2: the length of ab x ac; not negative.</summary>
    public float TargetScaledArea;
    /// <summary>Stiffness of the connection; the default is rigid.</summary>
    public SpringSettings SpringSettings;

    /// <summary>Describes the area that bodies have at given positions.</summary>
    /// <param name="a">Position of the first body.</param>
    /// <param name="b">Position of the second body.</param>
    /// <param name="c">Position of the third body.</param>
    /// <param name="springSettings">Stiffness of the connection.</param>
    public AreaConstraint(Vector3 a, Vector3 b, Vector3 c, SpringSettings springSettings)
    {
        TargetScaledArea = Exact.Length(Exact.Cross(b - a, c - a));
        SpringSettings = springSettings;
    }

    /// <inheritdoc/>
    public static int ConstraintTypeId => ConstraintTypeIds.AreaConstraint;
    /// <inheritdoc/>
    public static TypeProcessor CreateTypeProcessor() => new TypeProcessor<
        ThreeBodies, AreaConstraintWide, Rows1,
        JointConstraint<ThreeBodies, AreaConstraintWide, AreaGradient, Rows1, Rows1, AreaConstraintJoint>>();
    /// <inheritdoc/>
    public static void Validate(in AreaConstraint description)
    {
        ConstraintChecks.Area(description.TargetScaledArea, nameof(TargetScaledArea));
        ConstraintChecks.Spring(description.SpringSettings, nameof(SpringSettings));
    }
}

/// <summary>A bundle of <see cref="AreaConstraint"/>.</summary>
struct AreaConstraintWide : IWide<AreaConstraint>
{
    /// <inheritdoc cref="AreaConstraint.TargetScaledArea"/>
    public Vector<float> TargetScaledArea;
    /// <inheritdoc cref="AreaConstraint.SpringSettings"/>
    public SpringSettingsWide SpringSettings;
}

/// <summary>Row of <see cref="AreaConstraint"/>.</summary>
// C = 2 area - target
readonly struct AreaConstraintJoint : IJacobianJoint<ThreeBodies, AreaConstraintWide, AreaGradient, Rows1, Rows1>
{
    /// <inheritdoc/>
    public static bool CarriesBodies => true;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Prepare(in ThreeBodies bodies, in AreaConstraintWide prestep, out AreaGradient geometry) =>
        AreaGradient.Prepare(bodies, out geometry);

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void PositionError(in ThreeBodies bodies, in AreaConstraintWide prestep, in AreaGradient geometry, out Rows1 error) =>
        error.X = AreaGradient.Bound(geometry.Area - prestep.TargetScaledArea, geometry, prestep.TargetScaledArea);

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static SpringSettingsWide Spring(in AreaConstraintWide prestep) => prestep.SpringSettings;
}
