using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Tangents of an axis of A lean to where they are at right angles to the axis of B, if B is a wheel that spins on an A which gives way.</summary>
// Rows at right angles to the axis a of A alone are right where A and B are aligned. Where a joint is off by an angle, they have its sine along the axis b
// of B: they take the spin of B for a motion of the error and brake it, and what they bear spins it up or down. The easier A is to turn, the larger is the
// error that a load leaves, and all of this goes with its square. A wheel that is balanced is spun by nothing if no row has a part along b.
//
// What is not balanced stays as it is: its own loads go round with it, and it is tangents of A in which they are at rest. So does what spins on an A that is
// not easier to turn: there the inertia of the joint goes round with B too.
static class WheelTangents
{
    // How many times as easy to turn A has to be. No ratio of masses or sizes that a game would choose, so that rounding does not decide.
    const float EasierToTurn = 1.7f;

    // One over the square of what unbalance leaves none of the lean: of the tangent of the angle by which the axis is off a principal axis, and of the distance
    // of the centre from the axis, in radii of gyration. Loads that go round and loads that stay brake alike then, of a wheel that turns its axle by a
    // thirtieth of what it spins.
    const float Unbalance = 1000;

    /// <summary>Leans two tangents that are at right angles to the axis of A.</summary>
    /// <param name="bodies">The bodies.</param>
    /// <param name="localAxisB">Axis in B's frame.</param>
    /// <param name="offsetB">From the centre of B to a point of the axis, world axes; none where no point is held.</param>
    /// <param name="tangentX">One tangent.</param>
    /// <param name="tangentY">The other.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static void Lean(
        in TwoBodies bodies, in Vector3Wide localAxisB, in Vector3Wide offsetB, ref Vector3Wide tangentX, ref Vector3Wide tangentY)
    {
        var inverseA = bodies.A.InverseInertia.XX + bodies.A.InverseInertia.YY + bodies.A.InverseInertia.ZZ;
        var inverseB = bodies.B.InverseInertia.XX + bodies.B.InverseInertia.YY + bodies.B.InverseInertia.ZZ;
        var lanes = Vector.GreaterThan(inverseA, inverseB * new Vector<float>(EasierToTurn)) & Vector.GreaterThan(inverseB, Vector<float>.Zero);
        if (Vector.EqualsAll(lanes, Vector<int>.Zero))
            return;
        // Copies: a local whose address is taken is in memory all the time.
        Vector3Wide x = tangentX, y = tangentY, offset = offsetB;
        LeanWhere(lanes, bodies, localAxisB, offset, ref x, ref y);
        tangentX = x;
        tangentY = y;
    }

    // The rotation that takes a to b by the shortest way takes a tangent t to t - (t b) (a + b) / (1 + a b). Beyond a quarter turn the divisor stays one:
    // axes that point against each other have the tangents that they had.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static void LeanWhere(
        Vector<int> lanes, in TwoBodies bodies, in Vector3Wide localAxisB, in Vector3Wide offsetB, ref Vector3Wide tangentX, ref Vector3Wide tangentY)
    {
        var axisA = Vector3Wide.Cross(tangentX, tangentY);
        var axisB = bodies.B.Orientation * localAxisB;
        // What I^-1 b has along b, and across it. A radius of gyration is the root of 1/m over the former.
        var response = bodies.B.InverseInertia * axisB;
        var along = Vector3Wide.Dot(response, axisB);
        var alongSquared = along * along;
        var arm = Vector3Wide.Cross(offsetB, axisB).LengthSquared() * Wide.DivideOrZero(along, bodies.B.InverseMass);
        var unbalance = response.LengthSquared() - alongSquared + arm * alongSquared;
        var balance = alongSquared - unbalance * new Vector<float>(Unbalance);
        var divisor = alongSquared * (Vector<float>.One + Wide.Max(Vector3Wide.Dot(axisA, axisB), Vector<float>.Zero));
        // Where A spins by more than twice as much, A is the wheel: its tangents are what they should be.
        var spinA = Vector3Wide.Dot(bodies.A.Angular, axisA);
        var spinB = Vector3Wide.Dot(bodies.B.Angular, axisB);
        lanes &= Vector.GreaterThan(balance, Vector<float>.Zero) & Vector.LessThan(spinA * spinA, spinB * spinB * new Vector<float>(4));
        var sum = (axisA + axisB) * (balance / divisor);
        tangentX = Vector3Wide.Select(lanes, tangentX - sum * Vector3Wide.Dot(tangentX, axisB), tangentX);
        tangentY = Vector3Wide.Select(lanes, tangentY - sum * Vector3Wide.Dot(tangentY, axisB), tangentY);
    }
}
