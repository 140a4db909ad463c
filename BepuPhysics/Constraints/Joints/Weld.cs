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
public struct WeldWide : IWide<Weld>
{
    /// <inheritdoc cref="Weld.LocalOffset"/>
    public Vector3Wide LocalOffset;
    /// <inheritdoc cref="Weld.LocalOrientation"/>
    public QuaternionWide LocalOrientation;
    /// <inheritdoc cref="Weld.SpringSettings"/>
    public SpringSettingsWide SpringSettings;
}

/// <summary>Lever arm of a weld in world axes.</summary>
public struct WeldGeometry
{
    /// <summary>From the centre of A to where the centre of B belongs.</summary>
    public Vector3Wide OffsetA;
}

/// <summary>Rows of <see cref="Weld"/>.</summary>
// C = [ (xA + rA) - xB ; e ]   rA the offset in world axes, e the rotation vector (axis times angle, at most a half turn) that turns B
//                              to where it belongs, LocalOrientation followed by the orientation of A
// J = [ I, -skew(rA), -I,  0 ]
//     [ 0,     I,      0, -I ]   over (vA, wA, vB, wB), with skew(r) w = r x w
// K = [ (1/mA + 1/mB) I + skew(rA) IA^-1 skew(rA)^T,  -skew(rA) IA^-1 ; (-skew(rA) IA^-1)^T,  IA^-1 + IB^-1 ]
// The angular rows are the derivative of e along e itself, whatever its length: d|e|/dt = (e / |e|) (wA - wB). Across it they are where
// e = 0. So each sweep turns B along the shortest way, by the right angle.
// At exactly half a turn both ways are equally long, and the axis in e is that of the quaternion with W = +0.
public readonly struct WeldJoint : IJoint<TwoBodies, WeldWide, WeldGeometry, Rows6, RowMatrix6>
{
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Prepare(in TwoBodies bodies, in WeldWide prestep, out WeldGeometry geometry) =>
        geometry.OffsetA = bodies.A.Orientation * prestep.LocalOffset;

    /// <inheritdoc/>
    // The positions are subtracted first: far from the origin their difference is still exact.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void PositionError(in TwoBodies bodies, in WeldWide prestep, in WeldGeometry geometry, out Rows6 error)
    {
        var target = QuaternionWide.Concatenate(prestep.LocalOrientation, bodies.A.Orientation);
        error.Linear = (bodies.A.Position - bodies.B.Position) + geometry.OffsetA;
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
        velocity.Linear = bodies.A.Linear - bodies.B.Linear + Vector3Wide.Cross(bodies.A.Angular, geometry.OffsetA);
        velocity.Angular = bodies.A.Angular - bodies.B.Angular;
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void ApplyImpulse(in WeldGeometry geometry, ref TwoBodies bodies, in Rows6 impulse)
    {
        bodies.A.Linear += impulse.Linear * bodies.A.InverseMass;
        bodies.A.Angular += bodies.A.InverseInertia * (Vector3Wide.Cross(geometry.OffsetA, impulse.Linear) + impulse.Angular);
        bodies.B.Linear -= impulse.Linear * bodies.B.InverseMass;
        bodies.B.Angular -= bodies.B.InverseInertia * impulse.Angular;
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void InverseEffectiveMass(in WeldGeometry geometry, in TwoBodies bodies, out RowMatrix6 inverseMass)
    {
        inverseMass.Linear = Symmetric3x3Wide.AddDiagonal(
            Symmetric3x3Wide.SkewSandwich(geometry.OffsetA, bodies.A.InverseInertia), bodies.A.InverseMass + bodies.B.InverseMass);
        inverseMass.Coupling = Matrix3x3Wide.Skew(-geometry.OffsetA, bodies.A.InverseInertia);
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
        offsetB = Vector3Wide.Zero;
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static SpringSettingsWide Spring(in WeldWide prestep) => prestep.SpringSettings;
}
