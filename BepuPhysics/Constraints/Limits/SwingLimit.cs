using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Keeps the angle between an axis of body A and an axis of body B below a maximum.</summary>
/// <remarks>A cone in which an arm or a leg may swing; beside a <see cref="BallSocket"/>. Use <see cref="TwistLimit"/> for turns about the axis
/// itself.</remarks>
public struct SwingLimit : ITwoBodyConstraintDescription<SwingLimit>
{
    /// <summary>Axis in A's frame; unit length.</summary>
    public Vector3 AxisLocalA;
    /// <summary>Axis in B's frame; unit length.</summary>
    public Vector3 AxisLocalB;
    /// <summary>Cosine of the greatest angle between the axes, -1 to 1.</summary>
    public float MinimumDot;
    /// <summary>Stiffness of the limit; the default is rigid.</summary>
    public SpringSettings SpringSettings;

    /// <summary>Greatest angle between the axes, 0 to pi radians; stored as its cosine.</summary>
    public float MaximumSwingAngle
    {
        readonly get => MathHelper.Acos(MinimumDot);
        set => MinimumDot = MathHelper.Clamp(MathHelper.Cos(value), -1, 1);
    }

    /// <inheritdoc/>
    public static int ConstraintTypeId => ConstraintTypeIds.SwingLimit;
    /// <inheritdoc/>
    public static TypeProcessor CreateTypeProcessor() => new TypeProcessor<
        TwoBodies, SwingLimitWide, Rows1, JointConstraint<TwoBodies, SwingLimitWide, AxesRow, Rows1, Rows1, SwingLimitJoint>>();
    /// <inheritdoc/>
    public static void Validate(in SwingLimit description)
    {
        ConstraintChecks.Unit(description.AxisLocalA, nameof(AxisLocalA));
        ConstraintChecks.Unit(description.AxisLocalB, nameof(AxisLocalB));
        ConstraintChecks.Cosine(description.MinimumDot, nameof(MinimumDot));
        ConstraintChecks.Spring(description.SpringSettings, nameof(SpringSettings));
    }
}

/// <summary>A bundle of <see cref="SwingLimit"/>.</summary>
struct SwingLimitWide : IWide<SwingLimit>
{
    /// <inheritdoc cref="SwingLimit.AxisLocalA"/>
    public Vector3Wide AxisLocalA;
    /// <inheritdoc cref="SwingLimit.AxisLocalB"/>
    public Vector3Wide AxisLocalB;
    /// <inheritdoc cref="SwingLimit.MinimumDot"/>
    public Vector<float> MinimumDot;
    /// <inheritdoc cref="SwingLimit.SpringSettings"/>
    public SpringSettingsWide SpringSettings;
}

/// <summary>Row of <see cref="SwingLimit"/>.</summary>
// C = maximum angle - angle(a, b) >= 0   the same limit as dot(a, b) >= MinimumDot, but measured in radians: a deviation of the cosine is
//                                        a quadratic measure near 0 and pi, where a limit in it would be soft or have no slope at all
readonly struct SwingLimitJoint : IJacobianJoint<TwoBodies, SwingLimitWide, AxesRow, Rows1, Rows1>
{
    /// <inheritdoc/>
    public static RowKind Kind => RowKind.Inequality;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Prepare(in TwoBodies bodies, in SwingLimitWide prestep, out AxesRow geometry) =>
        AxesRow.Prepare(bodies, prestep.AxisLocalA, prestep.AxisLocalB, out geometry);

    /// <inheritdoc/>
    public static bool BoundsSlack => true;

    // Square of the length of (cosine, sine), less one: of axes that have unit length. Half of it, and what an arc tangent is rounded by, are less than the
    // margin.
    const float UnitTolerance = 1f / 1024;
    const float CosineMargin = 1f / 1024;

    /// <inheritdoc/>
    // Cosines differ by no more than their angles do. What a game has described as a unit vector, or written into a body, need not be one.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void LeastSlack(in SwingLimitWide prestep, in AxesRow geometry, out Rows1 slack)
    {
        var lengthSquared = geometry.Cosine * geometry.Cosine + geometry.Sine * geometry.Sine;
        var areUnit = Vector.LessThan(Vector.Abs(lengthSquared - Vector<float>.One), new Vector<float>(UnitTolerance));
        slack.X = Wide.Select(areUnit, geometry.Cosine - prestep.MinimumDot - new Vector<float>(CosineMargin), -Vector<float>.One);
    }

    /// <inheritdoc/>
    // The difference of two angles by one arc tangent: of its sine and its cosine, from those of the two.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void PositionError(in TwoBodies bodies, in SwingLimitWide prestep, in AxesRow geometry, out Rows1 error)
    {
        var limitSine = Wide.SquareRootOrZero((Vector<float>.One - prestep.MinimumDot) * (Vector<float>.One + prestep.MinimumDot));
        error.X = Wide.Atan2(
            limitSine * geometry.Cosine - prestep.MinimumDot * geometry.Sine,
            prestep.MinimumDot * geometry.Cosine + limitSine * geometry.Sine);
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static SpringSettingsWide Spring(in SwingLimitWide prestep) => prestep.SpringSettings;
}
