using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Keeps the volume of the tetrahedron between the centres of four bodies.</summary>
/// <remarks>For the tetrahedra of soft bodies, with a <see cref="CenterDistanceConstraint"/> along their edges; <see cref="AreaConstraint"/> is
/// for surfaces.</remarks>
public struct VolumeConstraint : IFourBodyConstraintDescription<VolumeConstraint>
{
    /// <summary>Six times the volume, m^3: (ab x ac) ad from body to body; its sign says which way the tetrahedron winds.</summary>
    public float TargetScaledVolume;
    /// <summary>Stiffness of the connection; the default is rigid.</summary>
    public SpringSettings SpringSettings;

    /// <summary>Describes the volume that bodies have at given positions.</summary>
    /// <param name="a">Position of the first body.</param>
    /// <param name="b">Position of the second body.</param>
    /// <param name="c">Position of the third body.</param>
    /// <param name="d">Position of the fourth body.</param>
    /// <param name="springSettings">Stiffness of the connection.</param>
    public VolumeConstraint(Vector3 a, Vector3 b, Vector3 c, Vector3 d, SpringSettings springSettings)
    {
        TargetScaledVolume = Exact.Dot(Exact.Cross(b - a, c - a), d - a);
        SpringSettings = springSettings;
    }

    /// <inheritdoc/>
    public static int ConstraintTypeId => ConstraintTypeIds.VolumeConstraint;
    /// <inheritdoc/>
    public static TypeProcessor CreateTypeProcessor() => new TypeProcessor<
        FourBodies, VolumeConstraintWide, Rows1,
        JointConstraint<FourBodies, VolumeConstraintWide, VolumeGradient, Rows1, Rows1, VolumeConstraintJoint>>();
    /// <inheritdoc/>
    public static void Validate(in VolumeConstraint description)
    {
        ConstraintChecks.Volume(description.TargetScaledVolume, nameof(TargetScaledVolume));
        ConstraintChecks.Spring(description.SpringSettings, nameof(SpringSettings));
    }
}

/// <summary>A bundle of <see cref="VolumeConstraint"/>.</summary>
struct VolumeConstraintWide : IWide<VolumeConstraint>
{
    /// <inheritdoc cref="VolumeConstraint.TargetScaledVolume"/>
    public Vector<float> TargetScaledVolume;
    /// <inheritdoc cref="VolumeConstraint.SpringSettings"/>
    public SpringSettingsWide SpringSettings;
}

/// <summary>Row of <see cref="VolumeConstraint"/>.</summary>
// C = 6 V - target
readonly struct VolumeConstraintJoint : IJacobianJoint<FourBodies, VolumeConstraintWide, VolumeGradient, Rows1, Rows1>
{
    /// <inheritdoc/>
    public static bool CarriesBodies => true;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Prepare(in FourBodies bodies, in VolumeConstraintWide prestep, out VolumeGradient geometry) =>
        VolumeGradient.Prepare(bodies, out geometry);

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void PositionError(in FourBodies bodies, in VolumeConstraintWide prestep, in VolumeGradient geometry, out Rows1 error) =>
        error.X = VolumeGradient.Bound(geometry.Volume - prestep.TargetScaledVolume, geometry, prestep.TargetScaledVolume);

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static SpringSettingsWide Spring(in VolumeConstraintWide prestep) => prestep.SpringSettings;
}
