using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Drives a rack B along an axis of a housing C by the turning of a pinion A in it: the way stays <c>Radius angle</c>. Pinion and rack need a hinge
/// and a slider of their own.</summary>
/// <remarks>
/// The angle is that of the pinion against the housing about the Z axes of their bases; the way is that of B's anchor from the housing's along the axis.
/// Nothing is counted: of the teeth of the rack, the nearest is held, so that a rack of any length keeps its place after any number of turns, and what pushes
/// it off by more than half a tooth lets it go on by one.
/// </remarks>
public struct Rack : IThreeBodyConstraintDescription<Rack>
{
    /// <summary>Rotation from the joint's frame to the pinion's, A; its Z axis is the pinion's axis, X is what is measured; unit length.</summary>
    public Quaternion LocalBasisA;
    /// <summary>Rotation from the joint's frame to that of the housing, C; its Z axis is the pinion's, X is angle 0, Y a quarter turn; unit length.</summary>
    public Quaternion LocalHousingBasis;
    /// <summary>Anchor in the frame of the rack, B, m.</summary>
    public Vector3 LocalOffsetB;
    /// <summary>Where the anchor of the rack is at angle 0, in the frame of the housing, m.</summary>
    public Vector3 LocalHousingOffset;
    /// <summary>Direction in which the rack moves, in the frame of the housing; unit length.</summary>
    public Vector3 LocalHousingAxis;
    /// <summary>Way of the rack per radian of the pinion, m: the pinion's radius, negative for the other direction; at least 1 mm.</summary>
    public float Radius;
    /// <summary>Teeth of the pinion: a whole number from 1 to 1000.</summary>
    public float Teeth;
    /// <summary>Stiffness of the teeth; the default is rigid.</summary>
    public SpringSettings SpringSettings;

    /// <inheritdoc/>
    public static int ConstraintTypeId => ConstraintTypeIds.Rack;
    /// <inheritdoc/>
    public static TypeProcessor CreateTypeProcessor() =>
        new TypeProcessor<ThreeBodies, RackWide, Rows1, JointConstraint<ThreeBodies, RackWide, HousedRow, Rows1, Rows1, RackJoint>>();
    /// <inheritdoc/>
    public static void Validate(in Rack description)
    {
        ConstraintChecks.Unit(description.LocalBasisA, nameof(LocalBasisA));
        ConstraintChecks.Unit(description.LocalHousingBasis, nameof(LocalHousingBasis));
        ConstraintChecks.Offset(description.LocalOffsetB, nameof(LocalOffsetB));
        ConstraintChecks.Offset(description.LocalHousingOffset, nameof(LocalHousingOffset));
        ConstraintChecks.Unit(description.LocalHousingAxis, nameof(LocalHousingAxis));
        ConstraintChecks.PinionRadius(description.Radius, nameof(Radius));
        ConstraintChecks.Teeth(description.Teeth, nameof(Teeth));
        ConstraintChecks.Spring(description.SpringSettings, nameof(SpringSettings));
    }
}

/// <summary>A bundle of <see cref="Rack"/>.</summary>
struct RackWide : IWide<Rack>
{
    /// <inheritdoc cref="Rack.LocalBasisA"/>
    public QuaternionWide LocalBasisA;
    /// <inheritdoc cref="Rack.LocalHousingBasis"/>
    public QuaternionWide LocalHousingBasis;
    /// <inheritdoc cref="Rack.LocalOffsetB"/>
    public Vector3Wide LocalOffsetB;
    /// <inheritdoc cref="Rack.LocalHousingOffset"/>
    public Vector3Wide LocalHousingOffset;
    /// <inheritdoc cref="Rack.LocalHousingAxis"/>
    public Vector3Wide LocalHousingAxis;
    /// <inheritdoc cref="Rack.Radius"/>
    public Vector<float> Radius;
    /// <inheritdoc cref="Rack.Teeth"/>
    public Vector<float> Teeth;
    /// <inheritdoc cref="Rack.SpringSettings"/>
    public SpringSettingsWide SpringSettings;
}

/// <summary>Row of <see cref="Rack"/>.</summary>
// C = n (pB - pC) - radius twist, less whole teeth   n the axis, pB and pC the points in the world
// n turns with C, so that C's arm ends where B's point is, as in AxisThroughPoints.
readonly struct RackJoint : IJacobianJoint<ThreeBodies, RackWide, HousedRow, Rows1, Rows1>
{
    /// <inheritdoc/>
    public static bool CarriesBodies => true;

    /// <inheritdoc/>
    // A JIT root of its own: beside three bodies it would take more locals than the JIT tracks.
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static void Prepare(in ThreeBodies bodies, in RackWide prestep, out HousedRow geometry)
    {
        var angle = HousedRow.Turn(bodies.A, bodies.C, prestep.LocalBasisA, prestep.LocalHousingBasis, -prestep.Radius, out geometry.AngularA, out var held);
        var axis = bodies.C.Orientation * prestep.LocalHousingAxis;
        var offsetB = bodies.B.Orientation * prestep.LocalOffsetB;
        // The positions are subtracted first: far from the origin their difference is still exact.
        var offsetC = (bodies.B.Position - bodies.C.Position) + offsetB;
        geometry.LinearA = Vector3Wide.Zero;
        geometry.LinearB = axis;
        geometry.AngularB = Vector3Wide.Cross(offsetB, axis);
        geometry.AngularC = -(geometry.AngularA + Vector3Wide.Cross(offsetC, axis));
        var way = Vector3Wide.Dot(axis, offsetC - bodies.C.Orientation * prestep.LocalHousingOffset);
        geometry.Value = TwistAngle.WithinHalfATurn(prestep.Teeth * (way / prestep.Radius - angle)) * (prestep.Radius / prestep.Teeth * held);
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void PositionError(in ThreeBodies bodies, in RackWide prestep, in HousedRow geometry, out Rows1 error) => error.X = geometry.Value;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static SpringSettingsWide Spring(in RackWide prestep) => prestep.SpringSettings;
}
