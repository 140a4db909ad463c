using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Keeps the pose of body B fixed relative to body A.</summary>
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
        new TypeProcessor<TwoBodies, WeldWide, Rows6, JointConstraint<TwoBodies, WeldWide, WeldGeometry, Rows6, RowMatrix6, WeldJoint>>();
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

/// <summary>Lever arms of a weld in world axes. One of them has no length: the weld holds the centre of one body at a point of the other.</summary>
struct WeldGeometry
{
    /// <summary>From the centre of A to where the centre of B belongs; zero where the centre of A is held.</summary>
    public Vector3Wide OffsetA;
    /// <summary>From the centre of B to where the centre of A belongs; zero where the centre of B is held.</summary>
    public Vector3Wide OffsetB;
}

/// <summary>Rows of <see cref="Weld"/>.</summary>
// C = [ (xA + rA) - (xB + rB) ; e ]   e the rotation vector (axis times angle, at most a half turn) that turns B to where it belongs,
//                                     LocalOrientation followed by the orientation of A
// J = [ I, -skew(rA), -I, skew(rB) ]
//     [ 0,     I,      0,    -I    ]   over (vA, wA, vB, wB), with skew(r) w = r x w
// K = [ (1/mA + 1/mB) I + skew(rA) IA^-1 skew(rA)^T + skew(rB) IB^-1 skew(rB)^T,  -skew(rA) IA^-1 - skew(rB) IB^-1 ; the transpose, IA^-1 + IB^-1 ]
//
// Where bodies are welded, any point could be held. The centre of B is, by the offset as an arm of A: rB = 0. But where A is by far easier to turn
// than B, the centre of A is: a heavy rod at the end of an arm of a light link, an arm as long as half of the rod, turns that link by more than a
// substep can follow, is thrown around by it, and gains energy without end. On the rod the same arm does nothing.
// The angular rows are the derivative of e along e itself, whatever its length: d|e|/dt = (e / |e|) (wA - wB). Across it they are where
// e = 0. So each sweep turns B along the shortest way, by the right angle.
// At exactly half a turn both ways are equally long, and the axis in e is that of the quaternion with W = +0.
readonly struct WeldJoint : IJoint<TwoBodies, WeldWide, WeldGeometry, Rows6, RowMatrix6>
{
    // A is easier to turn by far from here on. No ratio of masses or sizes that a game would choose, so that rounding does not decide.
    const float EasierToTurn = 3.7f;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Prepare(in TwoBodies bodies, in WeldWide prestep, out WeldGeometry geometry)
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
    static void HoldCenterOfA(in TwoBodies bodies, in WeldWide prestep, Vector<int> holdsA, ref WeldGeometry geometry)
    {
        var orientationOfA = QuaternionWide.Concatenate(QuaternionWide.Conjugate(prestep.LocalOrientation), bodies.B.Orientation);
        geometry.OffsetB = Vector3Wide.Mask(holdsA, -(orientationOfA * prestep.LocalOffset));
        geometry.OffsetA = Vector3Wide.Mask(~holdsA, geometry.OffsetA);
    }

    /// <inheritdoc/>
    // The positions are subtracted first: far from the origin their difference is still exact.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void PositionError(in TwoBodies bodies, in WeldWide prestep, in WeldGeometry geometry, out Rows6 error)
    {
        var target = QuaternionWide.Concatenate(prestep.LocalOrientation, bodies.A.Orientation);
        error.Linear = (bodies.A.Position - bodies.B.Position) + (geometry.OffsetA - geometry.OffsetB);
        error.Angular = RotationVector(QuaternionWide.Concatenate(QuaternionWide.Conjugate(bodies.B.Orientation), target));
    }

    // Axis times angle of a rotation, the shorter way. The arc tangent needs no unit length and is exact for small angles, where the
    // arc cosine of W would have lost all digits.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector3Wide RotationVector(in QuaternionWide q)
    {
        var axis = new Vector3Wide(q.X, q.Y, q.Z);
        var sine = axis.Length();
        var halfAngle = Wide.Atan2(sine, Vector.Abs(q.W));
        // Where the sine is zero, or its square too small for a float, so is the angle.
        return axis * (Wide.Sign(q.W) * Wide.DivideOrZero(halfAngle + halfAngle, sine));
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void RelativeVelocity(in WeldGeometry geometry, in TwoBodies bodies, out Rows6 velocity)
    {
        velocity.Linear = bodies.A.Linear - bodies.B.Linear +
            (Vector3Wide.Cross(bodies.A.Angular, geometry.OffsetA) - Vector3Wide.Cross(bodies.B.Angular, geometry.OffsetB));
        velocity.Angular = bodies.A.Angular - bodies.B.Angular;
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void ApplyImpulse(in WeldGeometry geometry, ref TwoBodies bodies, in Rows6 impulse)
    {
        bodies.A.Linear += impulse.Linear * bodies.A.InverseMass;
        bodies.A.Angular += bodies.A.InverseInertia * (Vector3Wide.Cross(geometry.OffsetA, impulse.Linear) + impulse.Angular);
        bodies.B.Linear -= impulse.Linear * bodies.B.InverseMass;
        bodies.B.Angular -= bodies.B.InverseInertia * (Vector3Wide.Cross(geometry.OffsetB, impulse.Linear) + impulse.Angular);
    }

    /// <inheritdoc/>
    // A JIT root of its own: with it, the kernel has more locals than the JIT tracks. What it reads and writes is in memory anyway.
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static void InverseEffectiveMass(in WeldGeometry geometry, in TwoBodies bodies, out RowMatrix6 inverseMass)
    {
        inverseMass.Linear = Symmetric3x3Wide.AddDiagonal(
            Symmetric3x3Wide.SkewSandwich(geometry.OffsetA, bodies.A.InverseInertia) + Symmetric3x3Wide.SkewSandwich(geometry.OffsetB, bodies.B.InverseInertia),
            bodies.A.InverseMass + bodies.B.InverseMass);
        inverseMass.Coupling =
            Matrix3x3Wide.Skew(-geometry.OffsetA, bodies.A.InverseInertia) + Matrix3x3Wide.Skew(-geometry.OffsetB, bodies.B.InverseInertia);
        inverseMass.Angular = bodies.A.InverseInertia + bodies.B.InverseInertia;
    }

    /// <inheritdoc/>
    public static bool HoldsPoints => true;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void PointLoad(
        in WeldGeometry geometry, in Rows6 impulses, out Vector3Wide impulse, out Vector3Wide offsetA, out Vector3Wide offsetB)
    {
        impulse = impulses.Linear;
        offsetA = geometry.OffsetA;
        offsetB = geometry.OffsetB;
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static SpringSettingsWide Spring(in WeldWide prestep) => prestep.SpringSettings;
}
