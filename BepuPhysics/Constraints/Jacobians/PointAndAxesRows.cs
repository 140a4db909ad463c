using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics.Arm;
using System.Runtime.Intrinsics.X86;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Rows that hold a point of A to a point of B, and one about the angle between an axis of A and an axis of B.</summary>
// J = [ I, -skew(rA), -I, skew(rB) ]
//     [ 0,     n^T,    0,   -n^T   ]   over (vA, wA, vB, wB), with skew(r) w = r x w, n at right angles to both axes
// K = [ KL, kC ; kC^T, kA ],  KL as for a point,  kC = (IA^-1 n) x rA + (IB^-1 n) x rB,  kA = n (IA^-1 + IB^-1) n
struct PointAndAxesRows : IPointJacobian<PointAndAxesRows, TwoBodies, Rows4, RowMatrix4>
{
    /// <inheritdoc/>
    public static BodyAccess Access => BodyAccess.Orientation | BodyAccess.Velocity | BodyAccess.Mass;

    /// <inheritdoc/>
    public static bool IsLinear(int row) => row < 3;

    /// <inheritdoc cref="PointRows.OffsetA"/>
    public Vector3Wide OffsetA;
    /// <inheritdoc cref="PointRows.OffsetB"/>
    public Vector3Wide OffsetB;
    /// <summary>The row about the angle.</summary>
    public AxesRow Axes;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void RelativeVelocity(in PointAndAxesRows rows, in TwoBodies bodies, out Rows4 velocity)
    {
        velocity.Linear = bodies.A.Linear - bodies.B.Linear +
            Vector3Wide.Cross(bodies.A.Angular, rows.OffsetA) - Vector3Wide.Cross(bodies.B.Angular, rows.OffsetB);
        velocity.Angular = AngularRow.RelativeVelocity(rows.Axes.Axis, bodies);
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void ApplyImpulse(in PointAndAxesRows rows, ref TwoBodies bodies, in Rows4 impulse)
    {
        var angular = rows.Axes.Axis * impulse.Angular;
        bodies.A.Linear += impulse.Linear * bodies.A.InverseMass;
        bodies.A.Angular += bodies.A.InverseInertia * (Vector3Wide.Cross(rows.OffsetA, impulse.Linear) + angular);
        bodies.B.Linear -= impulse.Linear * bodies.B.InverseMass;
        bodies.B.Angular -= bodies.B.InverseInertia * (Vector3Wide.Cross(rows.OffsetB, impulse.Linear) + angular);
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void InverseEffectiveMass(in PointAndAxesRows rows, in TwoBodies bodies, out RowMatrix4 inverseMass)
    {
        if (Avx512F.VL.IsSupported || AdvSimd.IsSupported)
            AddUp(rows, bodies, out inverseMass);
        else
            AddUpByCall(rows, bodies, out inverseMass);
    }

    // For sixteen registers, as in PointRows.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static void AddUpByCall(in PointAndAxesRows rows, in TwoBodies bodies, out RowMatrix4 inverseMass) => AddUp(rows, bodies, out inverseMass);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void AddUp(in PointAndAxesRows rows, in TwoBodies bodies, out RowMatrix4 inverseMass)
    {
        inverseMass.Linear = PointRows.InverseEffectiveMass(bodies, rows.OffsetA, rows.OffsetB);
        var responseA = bodies.A.InverseInertia * rows.Axes.Axis;
        var responseB = bodies.B.InverseInertia * rows.Axes.Axis;
        inverseMass.Coupling = Vector3Wide.Cross(responseA, rows.OffsetA) + Vector3Wide.Cross(responseB, rows.OffsetB);
        inverseMass.Angular = Vector3Wide.Dot(responseA + responseB, rows.Axes.Axis);
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void PointLoad(
        in PointAndAxesRows jacobian, in Rows4 rows, out Vector3Wide point, out Vector3Wide offsetA, out Vector3Wide offsetB)
    {
        point = rows.Linear;
        offsetA = jacobian.OffsetA;
        offsetB = jacobian.OffsetB;
    }
}
