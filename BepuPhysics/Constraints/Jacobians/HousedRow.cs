using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>A row about how two bodies A and B move against a third, C, that houses both and bears what their forces do not cancel.</summary>
// J = [ lA, aA, lB, aB, -(lA + lB), aC ]   over (vA, wA, vB, wB, vC, wC)
// K = the sum of l l / m + a I^-1 a
struct HousedRow : IJacobian<HousedRow, ThreeBodies, Rows1, Rows1>
{
    /// <summary>Linear Jacobian of A and of B; that of C is what is missing to zero.</summary>
    public Vector3Wide LinearA, LinearB;
    /// <summary>Angular Jacobian of each body.</summary>
    public Vector3Wide AngularA, AngularB, AngularC;
    /// <summary>What the row measures; what that is, the joint says.</summary>
    public Vector<float> Value;

    /// <summary>The rotation of a body against the housing about their twist axes, times a factor: its part of the row, and the angle.</summary>
    /// <param name="body">The body that turns.</param>
    /// <param name="housing">The body that it turns against.</param>
    /// <param name="localBasis">Basis in the body's frame; Z is the twist axis.</param>
    /// <param name="localHousingBasis">Basis in the housing's frame.</param>
    /// <param name="factor">Factor on the Jacobian.</param>
    /// <param name="angular">Angular Jacobian of the body; of the housing it is the opposite.</param>
    /// <param name="held">The part that is held of what the row measures, and in the Jacobian already: not all where axes point against each other.</param>
    /// <returns>The angle, radians, within half a turn; without the factor.</returns>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static Vector<float> Turn(
        in SolverBodyWide body, in SolverBodyWide housing, in QuaternionWide localBasis, in QuaternionWide localHousingBasis, Vector<float> factor,
        out Vector3Wide angular, out Vector<float> held)
    {
        Unsafe.SkipInit(out TwoBodies pair);
        pair.A.Orientation = housing.Orientation;
        pair.B.Orientation = body.Orientation;
        TwistAngle.Measure(pair, localHousingBasis, localBasis, out var twist);
        held = twist.Held;
        angular = twist.Axis(factor * held);
        return twist.Angle;
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void RelativeVelocity(in HousedRow row, in ThreeBodies bodies, out Rows1 velocity) => velocity.X =
        Vector3Wide.Dot(bodies.A.Linear - bodies.C.Linear, row.LinearA) + Vector3Wide.Dot(bodies.B.Linear - bodies.C.Linear, row.LinearB) +
        (Vector3Wide.Dot(bodies.A.Angular, row.AngularA) + Vector3Wide.Dot(bodies.B.Angular, row.AngularB) +
        Vector3Wide.Dot(bodies.C.Angular, row.AngularC));

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void ApplyImpulse(in HousedRow row, ref ThreeBodies bodies, in Rows1 impulse)
    {
        bodies.A.Linear += row.LinearA * (impulse.X * bodies.A.InverseMass);
        bodies.A.Angular += bodies.A.InverseInertia * (row.AngularA * impulse.X);
        bodies.B.Linear += row.LinearB * (impulse.X * bodies.B.InverseMass);
        bodies.B.Angular += bodies.B.InverseInertia * (row.AngularB * impulse.X);
        bodies.C.Linear -= (row.LinearA + row.LinearB) * (impulse.X * bodies.C.InverseMass);
        bodies.C.Angular += bodies.C.InverseInertia * (row.AngularC * impulse.X);
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void InverseEffectiveMass(in HousedRow row, in ThreeBodies bodies, out Rows1 inverseMass) => inverseMass.X =
        row.LinearA.LengthSquared() * bodies.A.InverseMass + row.LinearB.LengthSquared() * bodies.B.InverseMass +
        (row.LinearA + row.LinearB).LengthSquared() * bodies.C.InverseMass +
        (Symmetric3x3Wide.VectorSandwich(row.AngularA, bodies.A.InverseInertia) +
        Symmetric3x3Wide.VectorSandwich(row.AngularB, bodies.B.InverseInertia) +
        Symmetric3x3Wide.VectorSandwich(row.AngularC, bodies.C.InverseInertia));
}
