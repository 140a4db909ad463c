using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Rows that hold a point of A to a point of B and leave one axis to turn about.</summary>
// J = [ I, -skew(rA), -I, skew(rB) ]
//     [ 0,    tx^T,    0,  -tx^T   ]
//     [ 0,    ty^T,    0,  -ty^T   ]   over (vA, wA, vB, wB), with skew(r) w = r x w
// K = [ KL, KC^T ; KC, KA ],  KL as for a point,  KC = [ (IA^-1 tx) x rA + (IB^-1 tx) x rB ; the same with ty ],
//     KA = T (IA^-1 + IB^-1) T^T with the rows tx, ty in T
struct PointAndTangentRows : IPointJacobian<PointAndTangentRows, TwoBodies, Rows5, RowMatrix5>
{
    /// <inheritdoc/>
    public static BodyAccess Access => BodyAccess.Orientation | BodyAccess.Velocity | BodyAccess.Mass;

    /// <inheritdoc/>
    public static bool IsLinear(int row) => row < 3;

    /// <inheritdoc cref="PointRows.OffsetA"/>
    public Vector3Wide OffsetA;
    /// <inheritdoc cref="PointRows.OffsetB"/>
    public Vector3Wide OffsetB;
    /// <inheritdoc cref="AngularTangentRows.TangentX"/>
    public Vector3Wide TangentX;
    /// <inheritdoc cref="AngularTangentRows.TangentY"/>
    public Vector3Wide TangentY;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void RelativeVelocity(in PointAndTangentRows rows, in TwoBodies bodies, out Rows5 velocity)
    {
        velocity.Linear = bodies.A.Linear - bodies.B.Linear +
            Vector3Wide.Cross(bodies.A.Angular, rows.OffsetA) - Vector3Wide.Cross(bodies.B.Angular, rows.OffsetB);
        var angular = bodies.A.Angular - bodies.B.Angular;
        velocity.Angular.X = Vector3Wide.Dot(rows.TangentX, angular);
        velocity.Angular.Y = Vector3Wide.Dot(rows.TangentY, angular);
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void ApplyImpulse(in PointAndTangentRows rows, ref TwoBodies bodies, in Rows5 impulse)
    {
        var angular = rows.TangentX * impulse.Angular.X + rows.TangentY * impulse.Angular.Y;
        bodies.A.Linear += impulse.Linear * bodies.A.InverseMass;
        bodies.A.Angular += bodies.A.InverseInertia * (Vector3Wide.Cross(rows.OffsetA, impulse.Linear) + angular);
        bodies.B.Linear -= impulse.Linear * bodies.B.InverseMass;
        bodies.B.Angular -= bodies.B.InverseInertia * (Vector3Wide.Cross(rows.OffsetB, impulse.Linear) + angular);
    }

    /// <inheritdoc/>
    // A JIT root of its own: with it, the kernel has more locals than the JIT tracks. What it reads and writes is in memory anyway.
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static void InverseEffectiveMass(in PointAndTangentRows rows, in TwoBodies bodies, out RowMatrix5 inverseMass)
    {
        inverseMass.Linear = PointRows.InverseEffectiveMass(bodies, rows.OffsetA, rows.OffsetB);
        var responseAX = bodies.A.InverseInertia * rows.TangentX;
        var responseBX = bodies.B.InverseInertia * rows.TangentX;
        inverseMass.Coupling.X = Vector3Wide.Cross(responseAX, rows.OffsetA) + Vector3Wide.Cross(responseBX, rows.OffsetB);
        inverseMass.Angular.XX = Vector3Wide.Dot(responseAX + responseBX, rows.TangentX);
        inverseMass.Angular.YX = Vector3Wide.Dot(responseAX + responseBX, rows.TangentY);
        var responseAY = bodies.A.InverseInertia * rows.TangentY;
        var responseBY = bodies.B.InverseInertia * rows.TangentY;
        inverseMass.Coupling.Y = Vector3Wide.Cross(responseAY, rows.OffsetA) + Vector3Wide.Cross(responseBY, rows.OffsetB);
        inverseMass.Angular.YY = Vector3Wide.Dot(responseAY + responseBY, rows.TangentY);
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void PointLoad(
        in PointAndTangentRows jacobian, in Rows5 rows, out Vector3Wide point, out Vector3Wide offsetA, out Vector3Wide offsetB)
    {
        point = rows.Linear;
        offsetA = jacobian.OffsetA;
        offsetB = jacobian.OffsetB;
    }
}
