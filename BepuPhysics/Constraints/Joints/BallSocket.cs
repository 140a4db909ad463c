using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Keeps a point of body A on a point of body B.</summary>
public struct BallSocket : ITwoBodyConstraintDescription<BallSocket>
{
    /// <summary>Anchor in A's frame, m.</summary>
    public Vector3 LocalOffsetA;
    /// <summary>Anchor in B's frame, m.</summary>
    public Vector3 LocalOffsetB;
    /// <summary>Stiffness of the connection; the default is rigid.</summary>
    public SpringSettings SpringSettings;

    /// <inheritdoc/>
    public static int ConstraintTypeId => ConstraintTypeIds.BallSocket;
    /// <inheritdoc/>
    public static TypeProcessor CreateTypeProcessor() =>
        new TypeProcessor<TwoBodies, BallSocketWide, Rows3,
            JointConstraint<TwoBodies, BallSocketWide, BallSocketGeometry, Rows3, RowMatrix3, BallSocketJoint>>();
    /// <inheritdoc/>
    public static void Validate(in BallSocket description)
    {
        ConstraintChecks.Offset(description.LocalOffsetA, nameof(LocalOffsetA));
        ConstraintChecks.Offset(description.LocalOffsetB, nameof(LocalOffsetB));
        ConstraintChecks.Spring(description.SpringSettings, nameof(SpringSettings));
    }
}

/// <summary>A bundle of <see cref="BallSocket"/>.</summary>
struct BallSocketWide : IWide<BallSocket>
{
    /// <inheritdoc cref="BallSocket.LocalOffsetA"/>
    public Vector3Wide LocalOffsetA;
    /// <inheritdoc cref="BallSocket.LocalOffsetB"/>
    public Vector3Wide LocalOffsetB;
    /// <inheritdoc cref="BallSocket.SpringSettings"/>
    public SpringSettingsWide SpringSettings;
}

/// <summary>Lever arms of a point joint in world axes.</summary>
struct BallSocketGeometry
{
    /// <summary>From the centre of A to its anchor.</summary>
    public Vector3Wide OffsetA;
    /// <summary>From the centre of B to its anchor.</summary>
    public Vector3Wide OffsetB;
}

/// <summary>Rows of <see cref="BallSocket"/>.</summary>
// C = (xA + rA) - (xB + rB)
// J = [ I, -skew(rA), -I, skew(rB) ]   over (vA, wA, vB, wB), with skew(r) w = r x w
// K = (1/mA + 1/mB) I + skew(rA) IA^-1 skew(rA)^T + skew(rB) IB^-1 skew(rB)^T
readonly struct BallSocketJoint : IJoint<TwoBodies, BallSocketWide, BallSocketGeometry, Rows3, RowMatrix3>
{
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Prepare(in TwoBodies bodies, in BallSocketWide prestep, out BallSocketGeometry geometry)
    {
        geometry.OffsetA = bodies.A.Orientation * prestep.LocalOffsetA;
        geometry.OffsetB = bodies.B.Orientation * prestep.LocalOffsetB;
    }

    /// <inheritdoc/>
    // The positions are subtracted first: far from the origin their difference is still exact, their sums with the arms are not.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void PositionError(in TwoBodies bodies, in BallSocketWide prestep, in BallSocketGeometry geometry, out Rows3 error) =>
        error.V = (bodies.A.Position - bodies.B.Position) + (geometry.OffsetA - geometry.OffsetB);

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void RelativeVelocity(in BallSocketGeometry geometry, in TwoBodies bodies, out Rows3 velocity) =>
        velocity.V = bodies.A.Linear - bodies.B.Linear +
            Vector3Wide.Cross(bodies.A.Angular, geometry.OffsetA) - Vector3Wide.Cross(bodies.B.Angular, geometry.OffsetB);

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void ApplyImpulse(in BallSocketGeometry geometry, ref TwoBodies bodies, in Rows3 impulse)
    {
        bodies.A.Linear += impulse.V * bodies.A.InverseMass;
        bodies.A.Angular += bodies.A.InverseInertia * Vector3Wide.Cross(geometry.OffsetA, impulse.V);
        bodies.B.Linear -= impulse.V * bodies.B.InverseMass;
        bodies.B.Angular -= bodies.B.InverseInertia * Vector3Wide.Cross(geometry.OffsetB, impulse.V);
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void InverseEffectiveMass(in BallSocketGeometry geometry, in TwoBodies bodies, out RowMatrix3 inverseMass) =>
        inverseMass.M = Symmetric3x3Wide.AddDiagonal(
            Symmetric3x3Wide.SkewSandwich(geometry.OffsetA, bodies.A.InverseInertia) + Symmetric3x3Wide.SkewSandwich(geometry.OffsetB, bodies.B.InverseInertia),
            bodies.A.InverseMass + bodies.B.InverseMass);

    /// <inheritdoc/>
    public static bool HoldsPoints => true;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void PointLoad(
        in BallSocketGeometry geometry, in Rows3 impulses, out Vector3Wide impulse, out Vector3Wide offsetA, out Vector3Wide offsetB)
    {
        impulse = impulses.V;
        offsetA = geometry.OffsetA;
        offsetB = geometry.OffsetB;
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static SpringSettingsWide Spring(in BallSocketWide prestep) => prestep.SpringSettings;
}
