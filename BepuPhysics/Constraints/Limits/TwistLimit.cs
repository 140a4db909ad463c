using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Keeps the angle by which body B is turned against body A about their twist axes in a range.</summary>
/// <remarks>Beside a <see cref="Hinge"/> it limits the angle of a door or a knee, beside a <see cref="BallSocket"/> the twist of a limb. Use
/// <see cref="SwingLimit"/> for the angle between axes.</remarks>
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
        TwoBodies, TwistLimitWide, Rows1, JointConstraint<TwoBodies, TwistLimitWide, AngularRow, Rows1, Rows1, TwistLimitJoint>>();
    /// <inheritdoc/>
    public static void Validate(in TwistLimit description)
    {
        ConstraintChecks.Unit(description.LocalBasisA, nameof(LocalBasisA));
        ConstraintChecks.Unit(description.LocalBasisB, nameof(LocalBasisB));
        ConstraintChecks.Angle(description.MinimumAngle, nameof(MinimumAngle));
        ConstraintChecks.Angle(description.MaximumAngle, nameof(MaximumAngle));
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

/// <summary>Row of <see cref="TwistLimit"/>.</summary>
// C = maximum - twist >= 0  or  twist - minimum >= 0, whichever limit is nearer around the circle
// J = [ 0, s t^T, 0, -s t^T ]   over (vA, wA, vB, wB), with t as for the twist, s = 1 for the maximum, -1 for the minimum
// A range of a whole turn or more limits nothing.
readonly struct TwistLimitJoint : IJacobianJoint<TwoBodies, TwistLimitWide, AngularRow, Rows1, Rows1>
{
    /// <inheritdoc/>
    public static RowKind Kind => RowKind.Inequality;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Prepare(in TwoBodies bodies, in TwistLimitWide prestep, out AngularRow geometry)
    {
        TwistAngle.Measure(bodies, prestep.LocalBasisA, prestep.LocalBasisB, out var twist);
        var turn = new Vector<float>(MathHelper.TwoPi);
        var turns = new Vector<float>(1 / MathHelper.TwoPi);
        var range = prestep.MaximumAngle - prestep.MinimumAngle;
        range -= Wide.Select(Vector.LessThan(range, Vector<float>.Zero), Vector.Floor(range * turns) * turn, Vector<float>.Zero);
        var halfRange = range * 0.5f;
        var deviation = TwistAngle.WithinHalfATurn(twist.Angle - (prestep.MinimumAngle + halfRange));
        geometry.Angle = halfRange - Vector.Abs(deviation);
        geometry.Axis = twist.Axis(Wide.Sign(deviation));
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void PositionError(in TwoBodies bodies, in TwistLimitWide prestep, in AngularRow geometry, out Rows1 error) =>
        error.X = geometry.Angle;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static SpringSettingsWide Spring(in TwistLimitWide prestep) => prestep.SpringSettings;
}
