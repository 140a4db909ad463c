using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Keeps an axis of body B along an axis of body A, wherever the bodies are: the rotation of a hinge without its point.</summary>
/// <remarks>Use <see cref="Hinge"/> where a point is held too.</remarks>
public struct AngularHinge : ITwoBodyConstraintDescription<AngularHinge>
{
    /// <summary>Axis in A's frame; unit length.</summary>
    public Vector3 LocalHingeAxisA;
    /// <summary>Axis in B's frame; unit length.</summary>
    public Vector3 LocalHingeAxisB;
    /// <summary>Stiffness of the connection; the default is rigid.</summary>
    public SpringSettings SpringSettings;

    /// <inheritdoc/>
    public static int ConstraintTypeId => ConstraintTypeIds.AngularHinge;
    /// <inheritdoc/>
    public static TypeProcessor CreateTypeProcessor() => new TypeProcessor<
        TwoBodies, AngularHingeWide, Rows2, JointConstraint<TwoBodies, AngularHingeWide, AngularTangentRows, Rows2, RowMatrix2, AngularHingeJoint>>();
    /// <inheritdoc/>
    public static void Validate(in AngularHinge description)
    {
        ConstraintChecks.Unit(description.LocalHingeAxisA, nameof(LocalHingeAxisA));
        ConstraintChecks.Unit(description.LocalHingeAxisB, nameof(LocalHingeAxisB));
        ConstraintChecks.Spring(description.SpringSettings, nameof(SpringSettings));
    }
}

/// <summary>A bundle of <see cref="AngularHinge"/>.</summary>
struct AngularHingeWide : IWide<AngularHinge>
{
    /// <inheritdoc cref="AngularHinge.LocalHingeAxisA"/>
    public Vector3Wide LocalHingeAxisA;
    /// <inheritdoc cref="AngularHinge.LocalHingeAxisB"/>
    public Vector3Wide LocalHingeAxisB;
    /// <inheritdoc cref="AngularHinge.SpringSettings"/>
    public SpringSettingsWide SpringSettings;
}

/// <summary>Rows of <see cref="AngularHinge"/>: the angular ones of <see cref="Hinge"/>.</summary>
// C = [ tx e ; ty e ]   e the rotation vector that turns B's axis b to A's axis a, at right angles to both, and (tx, ty, a) a frame fixed to A
readonly struct AngularHingeJoint : IJacobianJoint<TwoBodies, AngularHingeWide, AngularTangentRows, Rows2, RowMatrix2>
{
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Prepare(in TwoBodies bodies, in AngularHingeWide prestep, out AngularTangentRows geometry)
    {
        // Built in A's frame: built in the world the tangents would jump somewhere as the axis turns, and the impulses with them.
        Vector3Wide.BuildOrthonormalBasis(prestep.LocalHingeAxisA, out var tangentX, out var tangentY);
        geometry.TangentX = bodies.A.Orientation * tangentX;
        geometry.TangentY = bodies.A.Orientation * tangentY;
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void PositionError(in TwoBodies bodies, in AngularHingeWide prestep, in AngularTangentRows geometry, out Rows2 error) =>
        error.V = AngularTangentRows.TurnToAlign(geometry.TangentX, geometry.TangentY, bodies.B.Orientation * prestep.LocalHingeAxisB);

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void LeanRows(in TwoBodies bodies, in AngularHingeWide prestep, ref AngularTangentRows geometry) =>
        WheelTangents.Lean(bodies, prestep.LocalHingeAxisB, Vector3Wide.Zero, ref geometry.TangentX, ref geometry.TangentY);

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static SpringSettingsWide Spring(in AngularHingeWide prestep) => prestep.SpringSettings;
}
