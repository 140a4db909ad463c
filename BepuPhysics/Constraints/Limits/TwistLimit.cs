using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Keeps the angle by which body B is turned against body A about their twist axes in a range.</summary>
public struct TwistLimit : ITwoBodyConstraintDescription<TwistLimit>
{
    /// <summary>Rotation from the joint's frame to A's; its Z axis is the twist axis, X is angle 0, Y a quarter turn; unit length.</summary>
    public Quaternion LocalBasisA;
    /// <summary>Rotation from the joint's frame to B's; its Z axis is the twist axis, X is what is measured; unit length.</summary>
    public Quaternion LocalBasisB;
    /// <summary>Least angle from A to B, radians.</summary>
    public float MinimumAngle;
    /// <summary>Greatest angle from A to B, radians. Below the least, the range is the one from the least upwards through half a turn.</summary>
    public float MaximumAngle;
    /// <summary>Stiffness of the limits; the default is rigid.</summary>
    public SpringSettings SpringSettings;

    /// <inheritdoc/>
    public static int ConstraintTypeId => ConstraintTypeIds.TwistLimit;
    /// <inheritdoc/>
    public static TypeProcessor CreateTypeProcessor() => new TypeProcessor<
        TwoBodies, TwistLimitWide, Rows1, JointConstraint<TwoBodies, TwistLimitWide, TwistLimitGeometry, Rows1, Rows1, TwistLimitJoint>>();
    /// <inheritdoc/>
    public static void Validate(in TwistLimit description)
    {
        ConstraintChecks.Unit(description.LocalBasisA, nameof(LocalBasisA));
        ConstraintChecks.Unit(description.LocalBasisB, nameof(LocalBasisB));
        ConstraintChecks.Order(description.MinimumAngle, description.MaximumAngle, nameof(MinimumAngle), nameof(MaximumAngle));
        ConstraintChecks.Spring(description.SpringSettings, nameof(SpringSettings));
    }
}

/// <summary>A bundle of <see cref="TwistLimit"/>.</summary>
struct TwistLimitWide : IWide<TwistLimit>
{
    /// <inheritdoc cref="TwistLimit.LocalBasisA"/>
    public QuaternionWide LocalBasisA;
    /// <inheritdoc cref="TwistLimit.LocalBasisB"/>
    public QuaternionWide LocalBasisB;
    /// <inheritdoc cref="TwistLimit.MinimumAngle"/>
    public Vector<float> MinimumAngle;
    /// <inheritdoc cref="TwistLimit.MaximumAngle"/>
    public Vector<float> MaximumAngle;
    /// <inheritdoc cref="TwistLimit.SpringSettings"/>
    public SpringSettingsWide SpringSettings;
}

/// <summary>The side of a twist limit that is nearer, in world axes.</summary>
struct TwistLimitGeometry
{
    /// <summary>Angular Jacobian of A; of B it is the opposite.</summary>
    public Vector3Wide Axis;
    /// <summary>Angle that is left to the nearer limit, radians; negative beyond it.</summary>
    public Vector<float> Slack;
}

/// <summary>Row of <see cref="TwistLimit"/>.</summary>
// q = rotation from B's basis to A's basis;  twist = 2 atan2(q.Z, q.W): what remains of q when B's twist axis has been swung onto A's
//     the shortest way
// C = maximum - twist >= 0  or  twist - minimum >= 0, whichever limit is nearer around the circle
// J = [ 0, s t^T, 0, -s t^T ]   over (vA, wA, vB, wB), with t = (zA + zB) / (1 + zA zB), zA and zB the twist axes, s = 1 for the maximum,
//     -1 for the minimum; in the frame of A's basis, 1 + zA zB = 2 (q.Z^2 + q.W^2) and (zA + zB) / 2 = (q.X q.Z + q.Y q.W, q.Y q.Z - q.X q.W, q.Z^2 + q.W^2)
// K = t (IA^-1 + IB^-1) t
// Axes that point against each other have no twist: it spins around the circle ever faster as they come near that. Within 3.6 degrees
// of it the limit lets go (J = 0). A range of a whole turn or more limits nothing.
readonly struct TwistLimitJoint : IJoint<TwoBodies, TwistLimitWide, TwistLimitGeometry, Rows1, Rows1>
{
    // Square of the cosine of half the angle between the twist axes: (sin 1.8 degrees)^2. There, t is 32 times as long as at rest.
    const float LeastDefined = 1e-3f;

    /// <inheritdoc/>
    public static RowKind Kind => RowKind.Inequality;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Prepare(in TwoBodies bodies, in TwistLimitWide prestep, out TwistLimitGeometry geometry)
    {
        var basisA = QuaternionWide.Concatenate(prestep.LocalBasisA, bodies.A.Orientation);
        var basisB = QuaternionWide.Concatenate(prestep.LocalBasisB, bodies.B.Orientation);
        var q = QuaternionWide.Concatenate(basisB, QuaternionWide.Conjugate(basisA));

        // The two quaternions of a rotation give angles a turn apart; with W not negative the angle is within half a turn.
        var halfTwist = Wide.Atan2(q.Z * Wide.Sign(q.W), Vector.Abs(q.W));
        var turn = new Vector<float>(MathHelper.TwoPi);
        var turns = new Vector<float>(1 / MathHelper.TwoPi);
        var range = prestep.MaximumAngle - prestep.MinimumAngle;
        range -= Wide.Select(Vector.LessThan(range, Vector<float>.Zero), Vector.Floor(range * turns) * turn, Vector<float>.Zero);
        var halfRange = range * 0.5f;
        var deviation = halfTwist + halfTwist - (prestep.MinimumAngle + halfRange);
        deviation -= Vector.Floor(deviation * turns + new Vector<float>(0.5f)) * turn;
        geometry.Slack = halfRange - Vector.Abs(deviation);

        var defined = q.Z * q.Z + q.W * q.W;
        var scale = Wide.Mask(Vector.GreaterThan(defined, new Vector<float>(LeastDefined)), Wide.Sign(deviation) / defined);
        geometry.Axis = basisA * (new Vector3Wide(q.X * q.Z + q.Y * q.W, q.Y * q.Z - q.X * q.W, defined) * scale);
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void PositionError(in TwoBodies bodies, in TwistLimitWide prestep, in TwistLimitGeometry geometry, out Rows1 error) =>
        error.X = geometry.Slack;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void RelativeVelocity(in TwistLimitGeometry geometry, in TwoBodies bodies, out Rows1 velocity) =>
        velocity.X = AngularRow.RelativeVelocity(geometry.Axis, bodies);

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void ApplyImpulse(in TwistLimitGeometry geometry, ref TwoBodies bodies, in Rows1 impulse) =>
        AngularRow.ApplyImpulse(geometry.Axis, ref bodies, impulse.X);

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void InverseEffectiveMass(in TwistLimitGeometry geometry, in TwoBodies bodies, out Rows1 inverseMass) =>
        inverseMass.X = AngularRow.InverseEffectiveMass(geometry.Axis, bodies);

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static SpringSettingsWide Spring(in TwistLimitWide prestep) => prestep.SpringSettings;
}
