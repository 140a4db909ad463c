using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>A row along the line through the centres of two bodies.</summary>
// J = [ n, 0, -n, 0 ]   over (vA, wA, vB, wB), n the direction
// K = 1/mA + 1/mB
struct CenterRow : IJacobian<CenterRow, TwoBodies, Rows1, Rows1>
{
    /// <inheritdoc/>
    public static BodyAccess Access => BodyAccess.Position | BodyAccess.Linear | BodyAccess.InverseMass;

    /// <summary>Direction of the impulse on A; a unit vector.</summary>
    public Vector3Wide Direction;
    /// <summary>What the row measures, m; what that is, the joint says.</summary>
    public Vector<float> Distance;

    /// <summary>The direction from A to B and the distance, which is what the row's velocity takes from.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static void Prepare(in TwoBodies bodies, out CenterRow row)
    {
        var difference = bodies.B.Position - bodies.A.Position;
        var lengthSquared = difference.LengthSquared();
        row.Distance = Vector.SquareRoot(lengthSquared);
        row.Direction = LinearRow.DirectionOf(difference, lengthSquared, row.Distance, Vector<float>.One);
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void RelativeVelocity(in CenterRow row, in TwoBodies bodies, out Rows1 velocity) =>
        velocity.X = Vector3Wide.Dot(bodies.A.Linear - bodies.B.Linear, row.Direction);

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void ApplyImpulse(in CenterRow row, ref TwoBodies bodies, in Rows1 impulse)
    {
        bodies.A.Linear += row.Direction * (impulse.X * bodies.A.InverseMass);
        bodies.B.Linear -= row.Direction * (impulse.X * bodies.B.InverseMass);
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void InverseEffectiveMass(in CenterRow row, in TwoBodies bodies, out Rows1 inverseMass) =>
        inverseMass.X = bodies.A.InverseMass + bodies.B.InverseMass;
}
