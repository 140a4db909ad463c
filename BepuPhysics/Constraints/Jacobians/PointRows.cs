using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics.Arm;
using System.Runtime.Intrinsics.X86;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Three rows along the axes of the world, about a point of A and a point of B.</summary>
// J = [ I, -skew(rA), -I, skew(rB) ]   over (vA, wA, vB, wB), with skew(r) w = r x w
// K = (1/mA + 1/mB) I + skew(rA) IA^-1 skew(rA)^T + skew(rB) IB^-1 skew(rB)^T
struct PointRows : IPointJacobian<PointRows, TwoBodies, Rows3, RowMatrix3>
{
    /// <inheritdoc/>
    public static BodyAccess Access => BodyAccess.Orientation | BodyAccess.Velocity | BodyAccess.Mass;

    /// <summary>From the centre of A to its point, world axes.</summary>
    public Vector3Wide OffsetA;
    /// <summary>From the centre of B to its point, world axes.</summary>
    public Vector3Wide OffsetB;

    /// <summary>From the point of B to that of A.</summary>
    // The positions are subtracted first: far from the origin their difference is still exact, their sums with the arms are not.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static Vector3Wide Separation(in TwoBodies bodies, in Vector3Wide offsetA, in Vector3Wide offsetB) =>
        (bodies.A.Position - bodies.B.Position) + (offsetA - offsetB);

    /// <summary>K of these rows, for others that have them too.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static Symmetric3x3Wide InverseEffectiveMass(in TwoBodies bodies, in Vector3Wide offsetA, in Vector3Wide offsetB) =>
        Symmetric3x3Wide.AddDiagonal(
            Symmetric3x3Wide.SkewSandwich(offsetA, bodies.A.InverseInertia) + Symmetric3x3Wide.SkewSandwich(offsetB, bodies.B.InverseInertia),
            bodies.A.InverseMass + bodies.B.InverseMass);

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void RelativeVelocity(in PointRows rows, in TwoBodies bodies, out Rows3 velocity) =>
        velocity.V = bodies.A.Linear - bodies.B.Linear +
            Vector3Wide.Cross(bodies.A.Angular, rows.OffsetA) - Vector3Wide.Cross(bodies.B.Angular, rows.OffsetB);

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void ApplyImpulse(in PointRows rows, ref TwoBodies bodies, in Rows3 impulse)
    {
        bodies.A.Linear += impulse.V * bodies.A.InverseMass;
        bodies.A.Angular += bodies.A.InverseInertia * Vector3Wide.Cross(rows.OffsetA, impulse.V);
        bodies.B.Linear -= impulse.V * bodies.B.InverseMass;
        bodies.B.Angular -= bodies.B.InverseInertia * Vector3Wide.Cross(rows.OffsetB, impulse.V);
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void InverseEffectiveMass(in PointRows rows, in TwoBodies bodies, out RowMatrix3 inverseMass)
    {
        if (Avx512F.VL.IsSupported || AdvSimd.IsSupported)
            inverseMass.M = InverseEffectiveMass(bodies, rows.OffsetA, rows.OffsetB);
        else
            InverseEffectiveMassByCall(bodies, rows.OffsetA, rows.OffsetB, out inverseMass.M);
    }

    // Sixteen registers do not hold what a kernel has at hand around it: inlined, each operation would read and write the stack.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static void InverseEffectiveMassByCall(in TwoBodies bodies, in Vector3Wide offsetA, in Vector3Wide offsetB, out Symmetric3x3Wide inverseMass) =>
        inverseMass = InverseEffectiveMass(bodies, offsetA, offsetB);

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void PointLoad(in PointRows jacobian, in Rows3 rows, out Vector3Wide point, out Vector3Wide offsetA, out Vector3Wide offsetB)
    {
        point = rows.V;
        offsetA = jacobian.OffsetA;
        offsetB = jacobian.OffsetB;
    }
}

/// <summary>Three rows along the axes of the world, about a point of one body.</summary>
// J = [ I, -skew(r) ]   over (v, w), with skew(r) w = r x w
// K = 1/m I + skew(r) I^-1 skew(r)^T
struct OneBodyPointRows : IJacobian<OneBodyPointRows, OneBody, Rows3, RowMatrix3>
{
    /// <inheritdoc/>
    public static BodyAccess Access => BodyAccess.Orientation | BodyAccess.Velocity | BodyAccess.Mass;

    /// <summary>From the centre of the body to the point, world axes.</summary>
    public Vector3Wide Offset;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void RelativeVelocity(in OneBodyPointRows rows, in OneBody bodies, out Rows3 velocity) =>
        velocity.V = bodies.A.Linear + Vector3Wide.Cross(bodies.A.Angular, rows.Offset);

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void ApplyImpulse(in OneBodyPointRows rows, ref OneBody bodies, in Rows3 impulse)
    {
        bodies.A.Linear += impulse.V * bodies.A.InverseMass;
        bodies.A.Angular += bodies.A.InverseInertia * Vector3Wide.Cross(rows.Offset, impulse.V);
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void InverseEffectiveMass(in OneBodyPointRows rows, in OneBody bodies, out RowMatrix3 inverseMass) =>
        inverseMass.M = Symmetric3x3Wide.AddDiagonal(Symmetric3x3Wide.SkewSandwich(rows.Offset, bodies.A.InverseInertia), bodies.A.InverseMass);
}
