using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>A row along a direction through a point of A and a point of B.</summary>
// J = [ n, rA x n, -n, -(rB x n) ]   over (vA, wA, vB, wB), n the direction
// K = 1/mA + 1/mB + (rA x n) IA^-1 (rA x n) + (rB x n) IB^-1 (rB x n)
struct LinearRow : IJacobian<LinearRow, TwoBodies, Rows1, Rows1>
{
    /// <summary>Direction of the impulse on A; a unit vector.</summary>
    public Vector3Wide Direction;
    /// <summary>Lever arm of A crossed with the direction.</summary>
    public Vector3Wide AngularA;
    /// <summary>Lever arm of B crossed with the direction.</summary>
    public Vector3Wide AngularB;
    /// <summary>What the row measures, m; what that is, the joint says.</summary>
    public Vector<float> Distance;

    // Squares of lengths lose digits below this, so the direction is not a unit vector any more: what floats can hold, no size of a thing.
    const float LeastLengthSquared = 1e-30f;

    // Slack to a maximum such as float.MaxValue: no speed uses it up, and it can be divided by a timestep.
    const float EndlessSlack = 1e18f;

    /// <summary>The room that is left to the nearer of two limits of a distance; negative beyond it.</summary>
    /// <param name="distance">The distance.</param>
    /// <param name="minimum">Its least value.</param>
    /// <param name="maximum">Its greatest value.</param>
    /// <param name="hasMinimum">Lanes in which the least value counts.</param>
    /// <param name="sign">Factor on a row whose velocity is what the distance loses: 1 for the greatest value, -1 for the least.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static Vector<float> NearerLimit(
        Vector<float> distance, Vector<float> minimum, Vector<float> maximum, Vector<int> hasMinimum, out Vector<float> sign)
    {
        var aboveMinimum = distance - minimum;
        var belowMaximum = maximum - distance;
        var useMinimum = Vector.LessThan(Vector.Abs(aboveMinimum), Vector.Abs(belowMaximum)) & hasMinimum;
        sign = Wide.Select(useMinimum, -Vector<float>.One, Vector<float>.One);
        return Wide.Min(Wide.Select(useMinimum, aboveMinimum, belowMaximum), new Vector<float>(EndlessSlack));
    }

    /// <summary>A difference as a unit vector, times a sign. Points that coincide have no direction; it is the world's Y axis by definition.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static Vector3Wide DirectionOf(in Vector3Wide difference, Vector<float> lengthSquared, Vector<float> length, Vector<float> sign)
    {
        var apart = Vector.GreaterThan(lengthSquared, new Vector<float>(LeastLengthSquared));
        return Vector3Wide.Select(apart, difference * (sign / length), new Vector3Wide(Vector<float>.Zero, sign, Vector<float>.Zero));
    }

    /// <summary>A row along the line from a point of A to a point of B, whose velocity is what their distance loses.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static void BetweenPoints(in TwoBodies bodies, in Vector3Wide localOffsetA, in Vector3Wide localOffsetB, out LinearRow row)
    {
        var offsetA = bodies.A.Orientation * localOffsetA;
        var offsetB = bodies.B.Orientation * localOffsetB;
        // The positions are subtracted first: far from the origin their difference is still exact.
        var difference = (bodies.B.Position - bodies.A.Position) + (offsetB - offsetA);
        var lengthSquared = difference.LengthSquared();
        row.Distance = Vector.SquareRoot(lengthSquared);
        row.Direction = DirectionOf(difference, lengthSquared, row.Distance, Vector<float>.One);
        row.AngularA = Vector3Wide.Cross(offsetA, row.Direction);
        row.AngularB = Vector3Wide.Cross(offsetB, row.Direction);
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void RelativeVelocity(in LinearRow row, in TwoBodies bodies, out Rows1 velocity) =>
        velocity.X = Vector3Wide.Dot(bodies.A.Linear - bodies.B.Linear, row.Direction) +
            (Vector3Wide.Dot(bodies.A.Angular, row.AngularA) - Vector3Wide.Dot(bodies.B.Angular, row.AngularB));

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void ApplyImpulse(in LinearRow row, ref TwoBodies bodies, in Rows1 impulse)
    {
        bodies.A.Linear += row.Direction * (impulse.X * bodies.A.InverseMass);
        bodies.A.Angular += bodies.A.InverseInertia * (row.AngularA * impulse.X);
        bodies.B.Linear -= row.Direction * (impulse.X * bodies.B.InverseMass);
        bodies.B.Angular -= bodies.B.InverseInertia * (row.AngularB * impulse.X);
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void InverseEffectiveMass(in LinearRow row, in TwoBodies bodies, out Rows1 inverseMass) =>
        inverseMass.X = bodies.A.InverseMass + bodies.B.InverseMass +
            (Symmetric3x3Wide.VectorSandwich(row.AngularA, bodies.A.InverseInertia) +
            Symmetric3x3Wide.VectorSandwich(row.AngularB, bodies.B.InverseInertia));
}
