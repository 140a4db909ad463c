using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Two rows about how two bodies turn against each other about axes at right angles to an axis of A.</summary>
// J = [ 0, tx^T, 0, -tx^T ]
//     [ 0, ty^T, 0, -ty^T ]   over (vA, wA, vB, wB)
// K = T (IA^-1 + IB^-1) T^T with the rows tx, ty in T
struct AngularTangentRows : IJacobian<AngularTangentRows, TwoBodies, Rows2, RowMatrix2>
{
    /// <inheritdoc/>
    public static BodyAccess Access => BodyAccess.Orientation | BodyAccess.Angular | BodyAccess.InverseInertia;

    /// <inheritdoc/>
    public static bool IsLinear(int row) => false;

    /// <summary>A direction fixed to A, at right angles to the axis.</summary>
    public Vector3Wide TangentX;
    /// <summary>The direction fixed to A that completes the first and the axis to a right-handed frame.</summary>
    public Vector3Wide TangentY;

    /// <summary>The rotation vector that turns an axis b of B to the axis a of A, along the tangents; at right angles to both axes.</summary>
    // b in the frame (tx, ty, a) has the coordinates (x, y, z), so b x a = tx y - ty x, and the angle is that of (z, |x, y|). Most axes are nearly aligned:
    // there the angle over its sine is a polynomial, which needs no root.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static Vector2Wide TurnToAlign(in Vector3Wide tangentX, in Vector3Wide tangentY, in Vector3Wide axisB)
    {
        var x = Vector3Wide.Dot(tangentX, axisB);
        var y = Vector3Wide.Dot(tangentY, axisB);
        var z = Vector3Wide.Dot(Vector3Wide.Cross(tangentX, tangentY), axisB);
        var square = x * x + y * y;
        var scale = Wide.AsinOverSine(square);
        var isNear = Vector.LessThanOrEqual(square, new Vector<float>(Wide.AsinOverSineLimit)) & Vector.GreaterThan(z, Vector<float>.Zero);
        return Vector.EqualsAll(isNear, new Vector<int>(-1)) ? new(y * scale, -x * scale) : TurnToAlign(isNear, scale, x, y, z);
    }

    // Axes that point exactly against each other are half a turn apart about any axis; it is tx by definition.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static Vector2Wide TurnToAlign(Vector<int> isNear, Vector<float> scaleWhereNear, Vector<float> x, Vector<float> y, Vector<float> z)
    {
        var sine = Vector.SquareRoot(x * x + y * y);
        var angle = Wide.AtanOfQuarter(sine, Vector.Abs(z));
        angle = Wide.Select(Vector.LessThan(z, Vector<float>.Zero), new Vector<float>(MathHelper.Pi) - angle, angle);
        var isOpposite = Vector.AndNot(Vector.Equals(sine, Vector<float>.Zero), isNear);
        var scale = Wide.Select(isNear, scaleWhereNear, Wide.DivideOrZero(angle, sine));
        return new(Wide.Select(isOpposite, angle, y * scale), -x * scale);
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void RelativeVelocity(in AngularTangentRows rows, in TwoBodies bodies, out Rows2 velocity)
    {
        var angular = bodies.A.Angular - bodies.B.Angular;
        velocity.V = new(Vector3Wide.Dot(rows.TangentX, angular), Vector3Wide.Dot(rows.TangentY, angular));
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void ApplyImpulse(in AngularTangentRows rows, ref TwoBodies bodies, in Rows2 impulse)
    {
        var angular = rows.TangentX * impulse.V.X + rows.TangentY * impulse.V.Y;
        bodies.A.Angular += bodies.A.InverseInertia * angular;
        bodies.B.Angular -= bodies.B.InverseInertia * angular;
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void InverseEffectiveMass(in AngularTangentRows rows, in TwoBodies bodies, out RowMatrix2 inverseMass) =>
        inverseMass.M = Matrix2x3Wide.Sandwich(new(rows.TangentX, rows.TangentY), bodies.A.InverseInertia + bodies.B.InverseInertia);
}

/// <summary>Two rows along directions at right angles to an axis of A, through a point of A and a point of B.</summary>
// J = [ tx, rA x tx, -tx, -(rB x tx) ]
//     [ ty, rA x ty, -ty, -(rB x ty) ]   over (vA, wA, vB, wB)
// K = (1/mA + 1/mB) I + RA IA^-1 RA^T + RB IB^-1 RB^T with the rows r x tx, r x ty in R
struct LinearTangentRows : IJacobian<LinearTangentRows, TwoBodies, Rows2, RowMatrix2>
{
    /// <summary>From the centre of A to the point, world axes.</summary>
    public Vector3Wide OffsetA;
    /// <summary>From the centre of B to the point, world axes.</summary>
    public Vector3Wide OffsetB;
    /// <inheritdoc cref="AngularTangentRows.TangentX"/>
    public Vector3Wide TangentX;
    /// <inheritdoc cref="AngularTangentRows.TangentY"/>
    public Vector3Wide TangentY;

    /// <summary>The impulse on A, and the arms at which the two bodies bear it.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal readonly void Load(in Vector2Wide impulses, out Vector3Wide impulse, out Vector3Wide offsetA, out Vector3Wide offsetB)
    {
        impulse = TangentX * impulses.X + TangentY * impulses.Y;
        offsetA = OffsetA;
        offsetB = OffsetB;
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void RelativeVelocity(in LinearTangentRows rows, in TwoBodies bodies, out Rows2 velocity)
    {
        PointRows.RelativeVelocity(new() { OffsetA = rows.OffsetA, OffsetB = rows.OffsetB }, bodies, out var point);
        velocity.V = new(Vector3Wide.Dot(rows.TangentX, point.V), Vector3Wide.Dot(rows.TangentY, point.V));
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void ApplyImpulse(in LinearTangentRows rows, ref TwoBodies bodies, in Rows2 impulse) =>
        PointRows.ApplyImpulse(
            new() { OffsetA = rows.OffsetA, OffsetB = rows.OffsetB }, ref bodies, new(rows.TangentX * impulse.V.X + rows.TangentY * impulse.V.Y));

    /// <inheritdoc/>
    // A JIT root of its own, as in PointAndTangentRows.
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static void InverseEffectiveMass(in LinearTangentRows rows, in TwoBodies bodies, out RowMatrix2 inverseMass)
    {
        var armsA = new Matrix2x3Wide(Vector3Wide.Cross(rows.OffsetA, rows.TangentX), Vector3Wide.Cross(rows.OffsetA, rows.TangentY));
        var armsB = new Matrix2x3Wide(Vector3Wide.Cross(rows.OffsetB, rows.TangentX), Vector3Wide.Cross(rows.OffsetB, rows.TangentY));
        inverseMass.M = Symmetric2x2Wide.AddDiagonal(
            Matrix2x3Wide.Sandwich(armsA, bodies.A.InverseInertia) + Matrix2x3Wide.Sandwich(armsB, bodies.B.InverseInertia),
            bodies.A.InverseMass + bodies.B.InverseMass);
    }
}
