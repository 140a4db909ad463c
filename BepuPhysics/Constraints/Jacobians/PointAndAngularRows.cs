using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Rows that hold a point of A to a point of B and leave nothing to turn.</summary>
// J = [ I, -skew(rA), -I, skew(rB) ]
//     [ 0,     I,      0,    -I    ]   over (vA, wA, vB, wB), with skew(r) w = r x w
// K = [ KL, -skew(rA) IA^-1 - skew(rB) IB^-1 ; the transpose, IA^-1 + IB^-1 ],  KL as for a point
struct PointAndAngularRows : IPointJacobian<PointAndAngularRows, TwoBodies, Rows6, RowMatrix6>
{
    /// <inheritdoc/>
    public static BodyAccess Access => BodyAccess.Pose | BodyAccess.Velocity | BodyAccess.Mass;

    /// <inheritdoc/>
    public static bool IsLinear(int row) => row < 3;

    /// <inheritdoc cref="PointRows.OffsetA"/>
    public Vector3Wide OffsetA;
    /// <inheritdoc cref="PointRows.OffsetB"/>
    public Vector3Wide OffsetB;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void RelativeVelocity(in PointAndAngularRows rows, in TwoBodies bodies, out Rows6 velocity)
    {
        velocity.Linear = bodies.A.Linear - bodies.B.Linear +
            (Vector3Wide.Cross(bodies.A.Angular, rows.OffsetA) - Vector3Wide.Cross(bodies.B.Angular, rows.OffsetB));
        velocity.Angular = bodies.A.Angular - bodies.B.Angular;
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void ApplyImpulse(in PointAndAngularRows rows, ref TwoBodies bodies, in Rows6 impulse)
    {
        bodies.A.Linear += impulse.Linear * bodies.A.InverseMass;
        bodies.A.Angular += bodies.A.InverseInertia * (Vector3Wide.Cross(rows.OffsetA, impulse.Linear) + impulse.Angular);
        bodies.B.Linear -= impulse.Linear * bodies.B.InverseMass;
        bodies.B.Angular -= bodies.B.InverseInertia * (Vector3Wide.Cross(rows.OffsetB, impulse.Linear) + impulse.Angular);
    }

    /// <inheritdoc/>
    // A JIT root of its own: with it, the kernel has more locals than the JIT tracks. What it reads and writes is in memory anyway.
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static void InverseEffectiveMass(in PointAndAngularRows rows, in TwoBodies bodies, out RowMatrix6 inverseMass)
    {
        var linear = Symmetric3x3Wide.SkewSandwich(rows.OffsetA, bodies.A.InverseInertia);
        var coupling = Matrix3x3Wide.Skew(-rows.OffsetA, bodies.A.InverseInertia);
        var arm = rows.OffsetB;
        var hasArm = ~(Vector.Equals(arm.X, Vector<float>.Zero) & Vector.Equals(arm.Y, Vector<float>.Zero) & Vector.Equals(arm.Z, Vector<float>.Zero));
        // Hardly any has: B is held by its centre.
        if (!Vector.EqualsAll(hasArm, Vector<int>.Zero))
        {
            // Lane by lane, so that zeros have the same signs beside others.
            var linearB = Symmetric3x3Wide.SkewSandwich(arm, bodies.B.InverseInertia);
            var couplingB = Matrix3x3Wide.Skew(-arm, bodies.B.InverseInertia);
            linear = Symmetric3x3Wide.Select(hasArm, linear + linearB, linear);
            coupling.X = Vector3Wide.Select(hasArm, coupling.X + couplingB.X, coupling.X);
            coupling.Y = Vector3Wide.Select(hasArm, coupling.Y + couplingB.Y, coupling.Y);
            coupling.Z = Vector3Wide.Select(hasArm, coupling.Z + couplingB.Z, coupling.Z);
        }
        inverseMass.Linear = Symmetric3x3Wide.AddDiagonal(linear, bodies.A.InverseMass + bodies.B.InverseMass);
        inverseMass.Coupling = coupling;
        inverseMass.Angular = bodies.A.InverseInertia + bodies.B.InverseInertia;
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void PointLoad(
        in PointAndAngularRows jacobian, in Rows6 rows, out Vector3Wide point, out Vector3Wide offsetA, out Vector3Wide offsetB)
    {
        point = rows.Linear;
        offsetA = jacobian.OffsetA;
        offsetB = jacobian.OffsetB;
    }
}
