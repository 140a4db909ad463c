using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Keeps a point and an axis of body A on a point and an axis of body B, so that they can only turn about the axis.</summary>
public struct Hinge : ITwoBodyConstraintDescription<Hinge>
{
    /// <summary>Anchor in A's frame, m.</summary>
    public Vector3 LocalOffsetA;
    /// <summary>Axis in A's frame; unit length.</summary>
    public Vector3 LocalHingeAxisA;
    /// <summary>Anchor in B's frame, m.</summary>
    public Vector3 LocalOffsetB;
    /// <summary>Axis in B's frame; unit length.</summary>
    public Vector3 LocalHingeAxisB;
    /// <summary>Stiffness of the connection; the default is rigid.</summary>
    public SpringSettings SpringSettings;

    /// <inheritdoc/>
    public static int ConstraintTypeId => ConstraintTypeIds.Hinge;
    /// <inheritdoc/>
    public static TypeProcessor CreateTypeProcessor() =>
        new TypeProcessor<TwoBodies, HingeWide, Rows5, JointConstraint<TwoBodies, HingeWide, HingeGeometry, Rows5, RowMatrix5, HingeJoint>>();
    /// <inheritdoc/>
    public static void Validate(in Hinge description)
    {
        ConstraintChecks.Offset(description.LocalOffsetA, nameof(LocalOffsetA));
        ConstraintChecks.Unit(description.LocalHingeAxisA, nameof(LocalHingeAxisA));
        ConstraintChecks.Offset(description.LocalOffsetB, nameof(LocalOffsetB));
        ConstraintChecks.Unit(description.LocalHingeAxisB, nameof(LocalHingeAxisB));
        ConstraintChecks.Spring(description.SpringSettings, nameof(SpringSettings));
    }
}

/// <summary>A bundle of <see cref="Hinge"/>.</summary>
struct HingeWide : IWide<Hinge>
{
    /// <inheritdoc cref="Hinge.LocalOffsetA"/>
    public Vector3Wide LocalOffsetA;
    /// <inheritdoc cref="Hinge.LocalHingeAxisA"/>
    public Vector3Wide LocalHingeAxisA;
    /// <inheritdoc cref="Hinge.LocalOffsetB"/>
    public Vector3Wide LocalOffsetB;
    /// <inheritdoc cref="Hinge.LocalHingeAxisB"/>
    public Vector3Wide LocalHingeAxisB;
    /// <inheritdoc cref="Hinge.SpringSettings"/>
    public SpringSettingsWide SpringSettings;
}

/// <summary>Lever arms and axes of a hinge in world axes.</summary>
struct HingeGeometry
{
    /// <summary>From the centre of A to its anchor.</summary>
    public Vector3Wide OffsetA;
    /// <summary>From the centre of B to its anchor.</summary>
    public Vector3Wide OffsetB;
    /// <summary>A direction fixed to A, at right angles to its axis.</summary>
    public Vector3Wide TangentX;
    /// <summary>The direction fixed to A that completes the first and the axis to a right-handed frame.</summary>
    public Vector3Wide TangentY;
}

/// <summary>Rows of <see cref="Hinge"/>.</summary>
// C = [ (xA + rA) - (xB + rB) ; tx e ; ty e ]   e the rotation vector that turns B's axis b to A's axis a, at right angles to both,
//                                               and (tx, ty, a) a frame fixed to A
// J = [ I, -skew(rA), -I, skew(rB) ]
//     [ 0,    tx^T,    0,  -tx^T   ]
//     [ 0,    ty^T,    0,  -ty^T   ]   over (vA, wA, vB, wB), with skew(r) w = r x w
// K = [ KL, KC^T ; KC, KA ],  KL as for a ball socket,  KC = [ (IA^-1 tx) x rA + (IB^-1 tx) x rB ; the same with ty ],
//     KA = T (IA^-1 + IB^-1) T^T with the rows tx, ty in T
// The angular rows are the derivative of e along e itself, whatever its length; across it they are where e = 0.
// Axes that point exactly against each other are half a turn apart about any axis; it is tx by definition.
readonly struct HingeJoint : IJoint<TwoBodies, HingeWide, HingeGeometry, Rows5, RowMatrix5>
{
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Prepare(in TwoBodies bodies, in HingeWide prestep, out HingeGeometry geometry)
    {
        // The tangents are built in A's frame: built in the world they would jump somewhere as the axis turns, and the impulses with them.
        Vector3Wide.BuildOrthonormalBasis(prestep.LocalHingeAxisA, out var tangentX, out var tangentY);
        geometry.OffsetA = bodies.A.Orientation * prestep.LocalOffsetA;
        geometry.OffsetB = bodies.B.Orientation * prestep.LocalOffsetB;
        geometry.TangentX = bodies.A.Orientation * tangentX;
        geometry.TangentY = bodies.A.Orientation * tangentY;
    }

    /// <inheritdoc/>
    // The positions are subtracted first: far from the origin their difference is still exact.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void PositionError(in TwoBodies bodies, in HingeWide prestep, in HingeGeometry geometry, out Rows5 error)
    {
        error.Linear = (bodies.A.Position - bodies.B.Position) + (geometry.OffsetA - geometry.OffsetB);
        // b in the frame (tx, ty, a) has the coordinates (x, y, z), so b x a = tx y - ty x, and the angle is that of (z, |x, y|).
        var axisB = bodies.B.Orientation * prestep.LocalHingeAxisB;
        var x = Vector3Wide.Dot(geometry.TangentX, axisB);
        var y = Vector3Wide.Dot(geometry.TangentY, axisB);
        var z = Vector3Wide.Dot(Vector3Wide.Cross(geometry.TangentX, geometry.TangentY), axisB);
        var sine = Vector.SquareRoot(x * x + y * y);
        var angle = Wide.Atan2(sine, z);
        var aligned = Vector.Equals(sine, Vector<float>.Zero);
        var scale = Wide.DivideOrZero(angle, sine);
        error.Angular.X = Wide.Select(aligned, angle, y * scale);
        error.Angular.Y = -x * scale;
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void RelativeVelocity(in HingeGeometry geometry, in TwoBodies bodies, out Rows5 velocity)
    {
        velocity.Linear = bodies.A.Linear - bodies.B.Linear +
            Vector3Wide.Cross(bodies.A.Angular, geometry.OffsetA) - Vector3Wide.Cross(bodies.B.Angular, geometry.OffsetB);
        var angular = bodies.A.Angular - bodies.B.Angular;
        velocity.Angular.X = Vector3Wide.Dot(geometry.TangentX, angular);
        velocity.Angular.Y = Vector3Wide.Dot(geometry.TangentY, angular);
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void ApplyImpulse(in HingeGeometry geometry, ref TwoBodies bodies, in Rows5 impulse)
    {
        var angular = geometry.TangentX * impulse.Angular.X + geometry.TangentY * impulse.Angular.Y;
        bodies.A.Linear += impulse.Linear * bodies.A.InverseMass;
        bodies.A.Angular += bodies.A.InverseInertia * (Vector3Wide.Cross(geometry.OffsetA, impulse.Linear) + angular);
        bodies.B.Linear -= impulse.Linear * bodies.B.InverseMass;
        bodies.B.Angular -= bodies.B.InverseInertia * (Vector3Wide.Cross(geometry.OffsetB, impulse.Linear) + angular);
    }

    /// <inheritdoc/>
    // A JIT root of its own: with it, the kernel has more locals than the JIT tracks. What it reads and writes is in memory anyway.
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static void InverseEffectiveMass(in HingeGeometry geometry, in TwoBodies bodies, out RowMatrix5 inverseMass)
    {
        inverseMass.Linear = Symmetric3x3Wide.AddDiagonal(
            Symmetric3x3Wide.SkewSandwich(geometry.OffsetA, bodies.A.InverseInertia) + Symmetric3x3Wide.SkewSandwich(geometry.OffsetB, bodies.B.InverseInertia),
            bodies.A.InverseMass + bodies.B.InverseMass);
        var responseAX = bodies.A.InverseInertia * geometry.TangentX;
        var responseBX = bodies.B.InverseInertia * geometry.TangentX;
        inverseMass.Coupling.X = Vector3Wide.Cross(responseAX, geometry.OffsetA) + Vector3Wide.Cross(responseBX, geometry.OffsetB);
        inverseMass.Angular.XX = Vector3Wide.Dot(responseAX + responseBX, geometry.TangentX);
        inverseMass.Angular.YX = Vector3Wide.Dot(responseAX + responseBX, geometry.TangentY);
        var responseAY = bodies.A.InverseInertia * geometry.TangentY;
        var responseBY = bodies.B.InverseInertia * geometry.TangentY;
        inverseMass.Coupling.Y = Vector3Wide.Cross(responseAY, geometry.OffsetA) + Vector3Wide.Cross(responseBY, geometry.OffsetB);
        inverseMass.Angular.YY = Vector3Wide.Dot(responseAY + responseBY, geometry.TangentY);
    }

    /// <inheritdoc/>
    public static bool HoldsPoints => true;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void PointLoad(
        in HingeGeometry geometry, in Rows5 impulses, out Vector3Wide impulse, out Vector3Wide offsetA, out Vector3Wide offsetB)
    {
        impulse = impulses.Linear;
        offsetA = geometry.OffsetA;
        offsetB = geometry.OffsetB;
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static SpringSettingsWide Spring(in HingeWide prestep) => prestep.SpringSettings;
}
