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
//
// J is not the derivative of the gap xA + rA - xB in the world but as the body sees it that has the arm, R d(R^T C)/dt for its rotation R: its arm goes
// on to where the centre of the other one is. A gap that goes round with both is at rest then, and forces act at one place. By the derivative in the
// world they would be a couple as large as the gap: in what spins, gaps lag behind the loads that make them, and the couple speeds all up or brakes it.
//
// The angular rows are the derivative of e along e itself, whatever its length: d|e|/dt = (e / |e|) (wA - wB). Across it they are where
// e = 0. So each sweep turns B along the shortest way, by the right angle.
// At exactly half a turn both ways are equally long, and the axis in e is that of the quaternion with W = +0.
readonly struct WeldJoint : IPointJoint<TwoBodies, WeldWide, PointAndAngularRows, Rows6, RowMatrix6>
{
    // A is easier to turn by far from here on. No ratio of masses or sizes that a game would choose, so that rounding does not decide.
    const float EasierToTurn = 3.7f;

    /// <inheritdoc/>
    public static BodyAccess ArmAccess => BodyAccess.InverseMass | BodyAccess.InverseInertia;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Prepare(in TwoBodies bodies, in WeldWide prestep, out PointAndAngularRows geometry)
    {
        geometry.OffsetA = bodies.B.Position - bodies.A.Position;
        geometry.OffsetB = Vector3Wide.Zero;
        var holdsA = HoldsCenterOfA(bodies);
        var isApart = IsApart(geometry.OffsetA, prestep.LocalOffset, bodies.A);
        if (Vector.EqualsAny(holdsA | isApart, new Vector<int>(-1)))
            PrepareOthers(bodies, prestep, holdsA, isApart, ref geometry);
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void PositionError(in TwoBodies bodies, in WeldWide prestep, in PointAndAngularRows geometry, out Rows6 error)
    {
        var offset = bodies.A.Orientation * prestep.LocalOffset;
        var holdsA = HoldsCenterOfA(bodies);
        if (Vector.EqualsAny(holdsA, new Vector<int>(-1)))
            offset = Vector3Wide.Select(holdsA, OffsetByB(bodies, prestep), offset);
        // The positions are subtracted first: far from the origin their difference is still exact, their sums with the arms are not.
        error.Linear = (bodies.A.Position - bodies.B.Position) + offset;
        var target = QuaternionWide.Concatenate(prestep.LocalOrientation, bodies.A.Orientation);
        error.Angular = AngularRows.RotationVector(QuaternionWide.Concatenate(QuaternionWide.Conjugate(bodies.B.Orientation), target));
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static SpringSettingsWide Spring(in WeldWide prestep) => prestep.SpringSettings;

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<int> HoldsCenterOfA(in TwoBodies bodies) =>
        Vector.GreaterThan(Trace(bodies.A), Trace(bodies.B) * new Vector<float>(EasierToTurn));

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<float> Trace(in SolverBodyWide body) => body.InverseInertia.XX + body.InverseInertia.YY + body.InverseInertia.ZZ;

    // Whether the centre that an arm holds is so far away that the arm has nothing to do with it: more than twice the radius of gyration of its body about
    // its end, with the offset r and the radius k about the centre r^2 + k^2 squared. Such an arm would be a lever as long as the gap.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<int> IsApart(in Vector3Wide arm, in Vector3Wide localOffset, in SolverBodyWide body)
    {
        var trace = Trace(body);
        return Vector.GreaterThan(
            arm.LengthSquared() * trace, new Vector<float>(4) * (localOffset.LengthSquared() * trace + new Vector<float>(3) * body.InverseMass));
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    static void PrepareOthers(in TwoBodies bodies, in WeldWide prestep, Vector<int> holdsA, Vector<int> isApart, ref PointAndAngularRows geometry)
    {
        var arm = geometry.OffsetA;
        var armOfB = Vector3Wide.Select(IsApart(arm, prestep.LocalOffset, bodies.B), -OffsetByB(bodies, prestep), -arm);
        var armOfA = Vector3Wide.Select(isApart, bodies.A.Orientation * prestep.LocalOffset, arm);
        geometry.OffsetA = Vector3Wide.Mask(~holdsA, armOfA);
        geometry.OffsetB = Vector3Wide.Mask(holdsA, armOfB);
    }

    // From the centre of A to that of B as B has it: its frame turned back by the local orientation is where A's frame belongs.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static Vector3Wide OffsetByB(in TwoBodies bodies, in WeldWide prestep) =>
        QuaternionWide.Concatenate(QuaternionWide.Conjugate(prestep.LocalOrientation), bodies.B.Orientation) * prestep.LocalOffset;
}
