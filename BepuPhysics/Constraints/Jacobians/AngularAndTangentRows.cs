using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Rows that leave nothing to turn, and hold a point of B to a line of A along which it slides.</summary>
// J = [ 0,     I,     0,      -I      ]
//     [ tx, rA x tx, -tx, -(rB x tx)  ]
//     [ ty, rA x ty, -ty, -(rB x ty)  ]   over (vA, wA, vB, wB)
// K = [ KA, KC^T ; KC, KL ],  KA = IA^-1 + IB^-1,  KC = [ IA^-1 (rA x tx) + IB^-1 (rB x tx) ; the same with ty ],  KL as for the tangents
// The block of three comes first, as in Rows5: here it is the angular one, and the block of two is linear.
struct AngularAndTangentRows : IJacobian<AngularAndTangentRows, TwoBodies, Rows5, RowMatrix5>
{
    /// <inheritdoc/>
    public static bool IsLinear(int row) => row >= 3;

    /// <summary>The rows at right angles to the line.</summary>
    public LinearTangentRows Tangents;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void RelativeVelocity(in AngularAndTangentRows rows, in TwoBodies bodies, out Rows5 velocity)
    {
        velocity.Linear = bodies.A.Angular - bodies.B.Angular;
        var point = bodies.A.Linear - bodies.B.Linear +
            Vector3Wide.Cross(bodies.A.Angular, rows.Tangents.OffsetA) - Vector3Wide.Cross(bodies.B.Angular, rows.Tangents.OffsetB);
        velocity.Angular.X = Vector3Wide.Dot(rows.Tangents.TangentX, point);
        velocity.Angular.Y = Vector3Wide.Dot(rows.Tangents.TangentY, point);
    }

    /// <inheritdoc/>
    // A JIT root of its own: the kernel has no budget left for it.
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static void ApplyImpulse(in AngularAndTangentRows rows, ref TwoBodies bodies, in Rows5 impulse)
    {
        var linear = rows.Tangents.TangentX * impulse.Angular.X + rows.Tangents.TangentY * impulse.Angular.Y;
        bodies.A.Linear += linear * bodies.A.InverseMass;
        bodies.A.Angular += bodies.A.InverseInertia * (Vector3Wide.Cross(rows.Tangents.OffsetA, linear) + impulse.Linear);
        bodies.B.Linear -= linear * bodies.B.InverseMass;
        bodies.B.Angular -= bodies.B.InverseInertia * (Vector3Wide.Cross(rows.Tangents.OffsetB, linear) + impulse.Linear);
    }

    /// <inheritdoc/>
    // A JIT root of its own, as in PointAndTangentRows.
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static void InverseEffectiveMass(in AngularAndTangentRows rows, in TwoBodies bodies, out RowMatrix5 inverseMass)
    {
        var armAX = Vector3Wide.Cross(rows.Tangents.OffsetA, rows.Tangents.TangentX);
        var armAY = Vector3Wide.Cross(rows.Tangents.OffsetA, rows.Tangents.TangentY);
        var armBX = Vector3Wide.Cross(rows.Tangents.OffsetB, rows.Tangents.TangentX);
        var armBY = Vector3Wide.Cross(rows.Tangents.OffsetB, rows.Tangents.TangentY);
        var responseAX = bodies.A.InverseInertia * armAX;
        var responseAY = bodies.A.InverseInertia * armAY;
        var responseBX = bodies.B.InverseInertia * armBX;
        var responseBY = bodies.B.InverseInertia * armBY;
        var massPart = bodies.A.InverseMass + bodies.B.InverseMass;
        inverseMass.Linear = bodies.A.InverseInertia + bodies.B.InverseInertia;
        inverseMass.Coupling.X = responseAX + responseBX;
        inverseMass.Coupling.Y = responseAY + responseBY;
        inverseMass.Angular.XX = massPart + (Vector3Wide.Dot(responseAX, armAX) + Vector3Wide.Dot(responseBX, armBX));
        inverseMass.Angular.YX = Vector3Wide.Dot(responseAX, armAY) + Vector3Wide.Dot(responseBX, armBY);
        inverseMass.Angular.YY = massPart + (Vector3Wide.Dot(responseAY, armAY) + Vector3Wide.Dot(responseBY, armBY));
    }
}
