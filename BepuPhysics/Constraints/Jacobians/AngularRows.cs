using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Three rows about the axes of the world, about how two bodies turn against each other.</summary>
// J = [ 0, I, 0, -I ]   over (vA, wA, vB, wB)
// K = IA^-1 + IB^-1
struct AngularRows : IJacobian<AngularRows, TwoBodies, Rows3, RowMatrix3>
{
    /// <inheritdoc/>
    public static BodyAccess Access => BodyAccess.Angular | BodyAccess.InverseInertia;

    /// <inheritdoc/>
    public static bool IsLinear(int row) => false;

    /// <summary>Axis times angle of a rotation, the shorter way, at most half a turn.</summary>
    // Most rotations are small: there the half angle over its sine is a polynomial, which needs no root. Beyond a sixth of a turn it takes an arc tangent, and
    // not the arc cosine of W, which has lost half of its digits at small angles.
    // At exactly half a turn both ways are equally long, and the axis is that of the quaternion with W = +0.
    // As an error e these rows are its derivative along e itself, whatever its length: d|e|/dt = (e / |e|) w. Across it they are where e = 0.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static Vector3Wide RotationVector(in QuaternionWide q)
    {
        var axis = new Vector3Wide(q.X, q.Y, q.Z);
        var square = axis.LengthSquared();
        var scale = Wide.AsinOverSine(square);
        var isFar = Vector.GreaterThan(square, new Vector<float>(Wide.AsinOverSineLimit));
        if (!Vector.EqualsAll(isFar, Vector<int>.Zero))
        {
            var sine = Vector.SquareRoot(square);
            scale = Wide.Select(isFar, Wide.AtanOfQuarter(sine, Vector.Abs(q.W)) / sine, scale);
        }
        return axis * (Wide.Sign(q.W) * (scale + scale));
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void RelativeVelocity(in AngularRows rows, in TwoBodies bodies, out Rows3 velocity) =>
        velocity.V = bodies.A.Angular - bodies.B.Angular;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void ApplyImpulse(in AngularRows rows, ref TwoBodies bodies, in Rows3 impulse)
    {
        bodies.A.Angular += bodies.A.InverseInertia * impulse.V;
        bodies.B.Angular -= bodies.B.InverseInertia * impulse.V;
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void InverseEffectiveMass(in AngularRows rows, in TwoBodies bodies, out RowMatrix3 inverseMass) =>
        inverseMass.M = bodies.A.InverseInertia + bodies.B.InverseInertia;
}

/// <summary>Three rows about the axes of the world, about how a body turns.</summary>
// J = [ 0, I ]   over (v, w)
// K = I^-1, the inverse inertia
struct OneBodyAngularRows : IJacobian<OneBodyAngularRows, OneBody, Rows3, RowMatrix3>
{
    /// <inheritdoc/>
    public static BodyAccess Access => BodyAccess.Angular | BodyAccess.InverseInertia;

    /// <inheritdoc/>
    public static bool IsLinear(int row) => false;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void RelativeVelocity(in OneBodyAngularRows rows, in OneBody bodies, out Rows3 velocity) => velocity.V = bodies.A.Angular;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void ApplyImpulse(in OneBodyAngularRows rows, ref OneBody bodies, in Rows3 impulse) =>
        bodies.A.Angular += bodies.A.InverseInertia * impulse.V;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void InverseEffectiveMass(in OneBodyAngularRows rows, in OneBody bodies, out RowMatrix3 inverseMass) =>
        inverseMass.M = bodies.A.InverseInertia;
}
