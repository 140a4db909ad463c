using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Keeps the distance between a point of body A and a point of body B in a range.</summary>
/// <param name="localOffsetA">Anchor in A's frame, m.</param>
/// <param name="localOffsetB">Anchor in B's frame, m.</param>
/// <param name="minimumDistance">Least distance, m; not negative.</param>
/// <param name="maximumDistance">Greatest distance, m; not below the least.</param>
/// <param name="springSettings">Stiffness of the limits.</param>
public struct DistanceLimit(Vector3 localOffsetA, Vector3 localOffsetB, float minimumDistance, float maximumDistance, in SpringSettings springSettings) :
    ITwoBodyConstraintDescription<DistanceLimit>
{
    /// <summary>Anchor in A's frame, m.</summary>
    public Vector3 LocalOffsetA = localOffsetA;
    /// <summary>Anchor in B's frame, m.</summary>
    public Vector3 LocalOffsetB = localOffsetB;
    /// <summary>Least distance, m; 0 for a rope, which keeps only the greatest.</summary>
    public float MinimumDistance = minimumDistance;
    /// <summary>Greatest distance, m; not below the least.</summary>
    public float MaximumDistance = maximumDistance;
    /// <summary>Stiffness of the limits; the default is rigid.</summary>
    public SpringSettings SpringSettings = springSettings;

    /// <inheritdoc/>
    public static int ConstraintTypeId => ConstraintTypeIds.DistanceLimit;
    /// <inheritdoc/>
    public static TypeProcessor CreateTypeProcessor() => new TypeProcessor<
        TwoBodies, DistanceLimitWide, Rows1, JointConstraint<TwoBodies, DistanceLimitWide, DistanceLimitGeometry, Rows1, Rows1, DistanceLimitJoint>>();
    /// <inheritdoc/>
    public static void Validate(in DistanceLimit description)
    {
        ConstraintChecks.Offset(description.LocalOffsetA, nameof(LocalOffsetA));
        ConstraintChecks.Offset(description.LocalOffsetB, nameof(LocalOffsetB));
        // There may be no greatest distance to speak of.
        ConstraintChecks.Distance(description.MinimumDistance, nameof(MinimumDistance));
        ConstraintChecks.Order(description.MinimumDistance, description.MaximumDistance, nameof(MinimumDistance), nameof(MaximumDistance));
        ConstraintChecks.Spring(description.SpringSettings, nameof(SpringSettings));
    }
}

/// <summary>A bundle of <see cref="DistanceLimit"/>.</summary>
struct DistanceLimitWide : IWide<DistanceLimit>
{
    /// <inheritdoc cref="DistanceLimit.LocalOffsetA"/>
    public Vector3Wide LocalOffsetA;
    /// <inheritdoc cref="DistanceLimit.LocalOffsetB"/>
    public Vector3Wide LocalOffsetB;
    /// <inheritdoc cref="DistanceLimit.MinimumDistance"/>
    public Vector<float> MinimumDistance;
    /// <inheritdoc cref="DistanceLimit.MaximumDistance"/>
    public Vector<float> MaximumDistance;
    /// <inheritdoc cref="DistanceLimit.SpringSettings"/>
    public SpringSettingsWide SpringSettings;
}

/// <summary>The side of a distance limit that is nearer, in world axes.</summary>
struct DistanceLimitGeometry
{
    /// <summary>Direction of the impulse on A: to B for the greatest distance, away from B for the least.</summary>
    public Vector3Wide Direction;
    /// <summary>Lever arm of A crossed with the direction.</summary>
    public Vector3Wide AngularA;
    /// <summary>Lever arm of B crossed with the direction.</summary>
    public Vector3Wide AngularB;
    /// <summary>Distance that is left to the nearer limit; negative beyond it.</summary>
    public Vector<float> Slack;
}

/// <summary>Row of <see cref="DistanceLimit"/>.</summary>
// d = (xB + rB) - (xA + rA),  u = d / |d|
// C = maximum - |d| >= 0  with n = u,  or  |d| - minimum >= 0  with n = -u,  whichever limit is nearer
// J = [ n, rA x n, -n, -(rB x n) ]   over (vA, wA, vB, wB)
// K = 1/mA + 1/mB + (rA x n) IA^-1 (rA x n) + (rB x n) IB^-1 (rB x n)
// A minimum of zero cannot be violated, so such a lane always watches its maximum: the anchors of a slack rope may pass through
// each other. Anchors that coincide have no direction; it is the world's Y axis by definition.
readonly struct DistanceLimitJoint : IJoint<TwoBodies, DistanceLimitWide, DistanceLimitGeometry, Rows1, Rows1>
{
    // Squares of lengths lose digits below this, so the direction is not a unit vector any more: what floats can hold, no size of a thing.
    const float LeastLengthSquared = 1e-30f;
    // Slack to a maximum such as float.MaxValue: no speed uses it up, and it can be divided by a timestep.
    const float EndlessSlack = 1e18f;

    /// <inheritdoc/>
    public static RowKind Kind => RowKind.Inequality;
    /// <inheritdoc/>
    public static bool CarriesBodies => true;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Prepare(in TwoBodies bodies, in DistanceLimitWide prestep, out DistanceLimitGeometry geometry)
    {
        var offsetA = bodies.A.Orientation * prestep.LocalOffsetA;
        var offsetB = bodies.B.Orientation * prestep.LocalOffsetB;
        // The positions are subtracted first: far from the origin their difference is still exact.
        var difference = (bodies.B.Position - bodies.A.Position) + (offsetB - offsetA);
        var lengthSquared = difference.LengthSquared();
        var length = Vector.SquareRoot(lengthSquared);
        var aboveMinimum = length - prestep.MinimumDistance;
        var belowMaximum = prestep.MaximumDistance - length;
        var useMinimum =
            Vector.LessThan(Vector.Abs(aboveMinimum), Vector.Abs(belowMaximum)) & Vector.GreaterThan(prestep.MinimumDistance, Vector<float>.Zero);
        geometry.Slack = Wide.Min(Wide.Select(useMinimum, aboveMinimum, belowMaximum), new Vector<float>(EndlessSlack));

        var sign = Wide.Select(useMinimum, -Vector<float>.One, Vector<float>.One);
        var apart = Vector.GreaterThan(lengthSquared, new Vector<float>(LeastLengthSquared));
        geometry.Direction = Vector3Wide.Select(
            apart, difference * (sign / length), new Vector3Wide(Vector<float>.Zero, sign, Vector<float>.Zero));
        geometry.AngularA = Vector3Wide.Cross(offsetA, geometry.Direction);
        geometry.AngularB = Vector3Wide.Cross(offsetB, geometry.Direction);
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void PositionError(in TwoBodies bodies, in DistanceLimitWide prestep, in DistanceLimitGeometry geometry, out Rows1 error) =>
        error.X = geometry.Slack;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void RelativeVelocity(in DistanceLimitGeometry geometry, in TwoBodies bodies, out Rows1 velocity) =>
        velocity.X = Vector3Wide.Dot(bodies.A.Linear - bodies.B.Linear, geometry.Direction) +
            (Vector3Wide.Dot(bodies.A.Angular, geometry.AngularA) - Vector3Wide.Dot(bodies.B.Angular, geometry.AngularB));

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void ApplyImpulse(in DistanceLimitGeometry geometry, ref TwoBodies bodies, in Rows1 impulse)
    {
        bodies.A.Linear += geometry.Direction * (impulse.X * bodies.A.InverseMass);
        bodies.A.Angular += bodies.A.InverseInertia * (geometry.AngularA * impulse.X);
        bodies.B.Linear -= geometry.Direction * (impulse.X * bodies.B.InverseMass);
        bodies.B.Angular -= bodies.B.InverseInertia * (geometry.AngularB * impulse.X);
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void InverseEffectiveMass(in DistanceLimitGeometry geometry, in TwoBodies bodies, out Rows1 inverseMass) =>
        inverseMass.X = bodies.A.InverseMass + bodies.B.InverseMass +
            (Symmetric3x3Wide.VectorSandwich(geometry.AngularA, bodies.A.InverseInertia) +
            Symmetric3x3Wide.VectorSandwich(geometry.AngularB, bodies.B.InverseInertia));

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static SpringSettingsWide Spring(in DistanceLimitWide prestep) => prestep.SpringSettings;
}
