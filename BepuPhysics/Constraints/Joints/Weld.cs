using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Keeps the pose of body B fixed relative to body A.</summary>
/// <remarks>Bodies that never come apart are cheaper and stiffer as one body. Use <see cref="AngularServo"/> and <see cref="BallSocketServo"/>
/// for a connection that gives way beyond a force.</remarks>
public struct Weld : ITwoBodyConstraintDescription<Weld>
{
    /// <summary>Offset from the centre of A to the centre of B in A's frame, m.</summary>
    public Vector3 LocalOffset;
    /// <summary>Orientation of B in A's frame: the rotation from B's frame to A's; unit length.</summary>
    public Quaternion LocalOrientation;
    /// <summary>Stiffness of the connection; the default is rigid.</summary>
    public SpringSettings SpringSettings;

    /// <inheritdoc/>
    public static int ConstraintTypeId => ConstraintTypeIds.Weld;
    /// <inheritdoc/>
    public static TypeProcessor CreateTypeProcessor() =>
        new TypeProcessor<TwoBodies, WeldWide, Rows6, JointConstraint<TwoBodies, WeldWide, PointAndAngularRows, Rows6, RowMatrix6, WeldJoint>>();
    /// <inheritdoc/>
    public static void Validate(in Weld description)
    {
        ConstraintChecks.Offset(description.LocalOffset, nameof(LocalOffset));
        ConstraintChecks.Unit(description.LocalOrientation, nameof(LocalOrientation));
        ConstraintChecks.Spring(description.SpringSettings, nameof(SpringSettings));
    }
}

/// <summary>A bundle of <see cref="Weld"/>.</summary>
struct WeldWide : IWide<Weld>
{
    /// <inheritdoc cref="Weld.LocalOffset"/>
    public Vector3Wide LocalOffset;
    /// <inheritdoc cref="Weld.LocalOrientation"/>
    public QuaternionWide LocalOrientation;
    /// <inheritdoc cref="Weld.SpringSettings"/>
    public SpringSettingsWide SpringSettings;
}

/// <summary>Rows of <see cref="Weld"/>.</summary>
// C = [ (xA + rA) - (xB + rB) ; e ]   e the rotation vector (axis times angle, at most a half turn) that turns B to where it belongs,
//                                     LocalOrientation followed by the orientation of A
//
// Where bodies are welded, any point could be held. The centre of B is, by the offset as an arm of A: rB = 0. But where A is by far easier to turn
// than B, the centre of A is: a heavy rod at the end of an arm of a light link, an arm as long as half of the rod, turns that link by more than a
// substep can follow, is thrown around by it, and gains energy without end. On the rod the same arm does nothing.
// The angular rows are the derivative of e along e itself, whatever its length: d|e|/dt = (e / |e|) (wA - wB). Across it they are where
// e = 0. So each sweep turns B along the shortest way, by the right angle.
// At exactly half a turn both ways are equally long, and the axis in e is that of the quaternion with W = +0.
readonly struct WeldJoint : IPointJoint<TwoBodies, WeldWide, PointAndAngularRows, Rows6, RowMatrix6>
{
    // A is easier to turn by far from here on. No ratio of masses or sizes that a game would choose, so that rounding does not decide.
    const float EasierToTurn = 3.7f;

    /// <inheritdoc/>
    public static BodyAccess ArmAccess => BodyAccess.InverseInertia;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Prepare(in TwoBodies bodies, in WeldWide prestep, out PointAndAngularRows geometry)
    {
        var inverseA = bodies.A.InverseInertia.XX + bodies.A.InverseInertia.YY + bodies.A.InverseInertia.ZZ;
        var inverseB = bodies.B.InverseInertia.XX + bodies.B.InverseInertia.YY + bodies.B.InverseInertia.ZZ;
        geometry.OffsetA = bodies.A.Orientation * prestep.LocalOffset;
        geometry.OffsetB = Vector3Wide.Zero;
        var holdsA = Vector.GreaterThan(inverseA, inverseB * new Vector<float>(EasierToTurn));
        if (Vector.EqualsAny(holdsA, new Vector<int>(-1)))
            HoldCenterOfA(bodies, prestep, holdsA, ref geometry);
    }

    // B's frame turned back by the local orientation is where A's frame belongs.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static void HoldCenterOfA(in TwoBodies bodies, in WeldWide prestep, Vector<int> holdsA, ref PointAndAngularRows geometry)
    {
        var orientationOfA = QuaternionWide.Concatenate(QuaternionWide.Conjugate(prestep.LocalOrientation), bodies.B.Orientation);
        geometry.OffsetB = Vector3Wide.Mask(holdsA, -(orientationOfA * prestep.LocalOffset));
        geometry.OffsetA = Vector3Wide.Mask(~holdsA, geometry.OffsetA);
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void PositionError(in TwoBodies bodies, in WeldWide prestep, in PointAndAngularRows geometry, out Rows6 error)
    {
        var target = QuaternionWide.Concatenate(prestep.LocalOrientation, bodies.A.Orientation);
        error.Linear = PointRows.Separation(bodies, geometry.OffsetA, geometry.OffsetB);
        error.Angular = AngularRows.RotationVector(QuaternionWide.Concatenate(QuaternionWide.Conjugate(bodies.B.Orientation), target));
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static SpringSettingsWide Spring(in WeldWide prestep) => prestep.SpringSettings;
}
