using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>A row about how two bodies turn against each other about an axis, for the joints that have such.</summary>
// J = [ 0, a^T, 0, -a^T ]   over (vA, wA, vB, wB), a the axis in the world
// K = a (IA^-1 + IB^-1) a
static class AngularRow
{
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
