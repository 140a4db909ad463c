using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>
/// Keeps an axis of body A and an axis of body B at right angles, wherever the bodies are: they can turn about both, as a universal joint does.
/// </summary>
/// <remarks>Use <see cref="SwivelHinge"/> where a point is held too.</remarks>
public struct AngularSwivelHinge : ITwoBodyConstraintDescription<AngularSwivelHinge>
{
    /// <summary>Axis in A's frame; unit length.</summary>
    public Vector3 LocalSwivelAxisA;
    /// <summary>Axis in B's frame; unit length.</summary>
    public Vector3 LocalHingeAxisB;
    /// <summary>Stiffness of the connection; the default is rigid.</summary>
    public SpringSettings SpringSettings;

    /// <inheritdoc/>
    public static int ConstraintTypeId => ConstraintTypeIds.AngularSwivelHinge;
    /// <inheritdoc/>
    public static TypeProcessor CreateTypeProcessor() => new TypeProcessor<
        TwoBodies, AngularSwivelHingeWide, Rows1, JointConstraint<TwoBodies, AngularSwivelHingeWide, AxesRow, Rows1, Rows1, AngularSwivelHingeJoint>>();
    /// <inheritdoc/>
    public static void Validate(in AngularSwivelHinge description)
    {
        ConstraintChecks.Unit(description.LocalSwivelAxisA, nameof(LocalSwivelAxisA));
        ConstraintChecks.Unit(description.LocalHingeAxisB, nameof(LocalHingeAxisB));
        ConstraintChecks.Spring(description.SpringSettings, nameof(SpringSettings));
    }
}

/// <summary>A bundle of <see cref="AngularSwivelHinge"/>.</summary>
struct AngularSwivelHingeWide : IWide<AngularSwivelHinge>
{
    /// <inheritdoc cref="AngularSwivelHinge.LocalSwivelAxisA"/>
    public Vector3Wide LocalSwivelAxisA;
    /// <inheritdoc cref="AngularSwivelHinge.LocalHingeAxisB"/>
    public Vector3Wide LocalHingeAxisB;
    /// <inheritdoc cref="AngularSwivelHinge.SpringSettings"/>
    public SpringSettingsWide SpringSettings;
}

/// <summary>Row of <see cref="AngularSwivelHinge"/>.</summary>
// C = a quarter turn - angle(a, b)   an angle and not its cosine, which would be soft where the axes are far from right angles
readonly struct AngularSwivelHingeJoint : IJacobianJoint<TwoBodies, AngularSwivelHingeWide, AxesRow, Rows1, Rows1>
{
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Prepare(in TwoBodies bodies, in AngularSwivelHingeWide prestep, out AxesRow geometry) =>
        AxesRow.Prepare(bodies, prestep.LocalSwivelAxisA, prestep.LocalHingeAxisB, out geometry);

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void PositionError(in TwoBodies bodies, in AngularSwivelHingeWide prestep, in AxesRow geometry, out Rows1 error) =>
        error.X = AxesRow.LackOfQuarterTurn(geometry);

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static SpringSettingsWide Spring(in AngularSwivelHingeWide prestep) => prestep.SpringSettings;
}
