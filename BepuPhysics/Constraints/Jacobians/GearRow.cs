using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>A row about how a body turns about an axis against a multiple of how another does.</summary>
// J = [ 0, s a^T, 0, -a^T ]   over (vA, wA, vB, wB), a the axis in the world, s the scale
// K = a (s^2 IA^-1 + IB^-1) a
// Unless s is 1 the torques do not cancel: the rest is what the housing of a gear would bear.
struct GearRow : IJacobian<GearRow, TwoBodies, Rows1, Rows1>
{
    /// <inheritdoc/>
    public static BodyAccess Access => BodyAccess.Orientation | BodyAccess.Angular | BodyAccess.InverseInertia;

    /// <inheritdoc/>
    public static bool IsLinear(int row) => false;

    /// <summary>The axis; a unit vector.</summary>
    public Vector3Wide Axis;
    /// <summary>Angular velocity of B in parts of A's.</summary>
    public Vector<float> Scale;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void RelativeVelocity(in GearRow row, in TwoBodies bodies, out Rows1 velocity) =>
        velocity.X = Vector3Wide.Dot(bodies.A.Angular * row.Scale - bodies.B.Angular, row.Axis);

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void ApplyImpulse(in GearRow row, ref TwoBodies bodies, in Rows1 impulse)
    {
        var angular = row.Axis * impulse.X;
        bodies.A.Angular += bodies.A.InverseInertia * (angular * row.Scale);
        bodies.B.Angular -= bodies.B.InverseInertia * angular;
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void InverseEffectiveMass(in GearRow row, in TwoBodies bodies, out Rows1 inverseMass) =>
        inverseMass.X = Symmetric3x3Wide.VectorSandwich(row.Axis, bodies.A.InverseInertia * (row.Scale * row.Scale) + bodies.B.InverseInertia);
}
