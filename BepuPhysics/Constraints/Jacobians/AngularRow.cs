using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>A row about how two bodies turn against each other about an axis.</summary>
// J = [ 0, a^T, 0, -a^T ]   over (vA, wA, vB, wB), a the axis in the world
// K = a (IA^-1 + IB^-1) a
struct AngularRow : IJacobian<AngularRow, TwoBodies, Rows1, Rows1>
{
    /// <inheritdoc/>
    public static BodyAccess Access => BodyAccess.Orientation | BodyAccess.Angular | BodyAccess.InverseInertia;

    /// <inheritdoc/>
    public static bool IsLinear(int row) => false;

    /// <summary>Angular Jacobian of A; of B it is the opposite. A unit vector where nothing else is said.</summary>
    public Vector3Wide Axis;
    /// <summary>What the row measures, radians; what that is, the joint says.</summary>
    public Vector<float> Angle;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void RelativeVelocity(in AngularRow row, in TwoBodies bodies, out Rows1 velocity) => velocity.X = RelativeVelocity(row.Axis, bodies);

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void ApplyImpulse(in AngularRow row, ref TwoBodies bodies, in Rows1 impulse) => ApplyImpulse(row.Axis, ref bodies, impulse.X);

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void InverseEffectiveMass(in AngularRow row, in TwoBodies bodies, out Rows1 inverseMass) =>
        inverseMass.X = InverseEffectiveMass(row.Axis, bodies);

    /// <summary>J v.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static Vector<float> RelativeVelocity(in Vector3Wide axis, in TwoBodies bodies) =>
        Vector3Wide.Dot(bodies.A.Angular - bodies.B.Angular, axis);

    /// <summary>v += M^-1 J^T lambda.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static void ApplyImpulse(in Vector3Wide axis, ref TwoBodies bodies, Vector<float> impulse)
    {
        var angular = axis * impulse;
        bodies.A.Angular += bodies.A.InverseInertia * angular;
        bodies.B.Angular -= bodies.B.InverseInertia * angular;
    }

    /// <summary>K.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static Vector<float> InverseEffectiveMass(in Vector3Wide axis, in TwoBodies bodies) =>
        Symmetric3x3Wide.VectorSandwich(axis, bodies.A.InverseInertia + bodies.B.InverseInertia);
}
