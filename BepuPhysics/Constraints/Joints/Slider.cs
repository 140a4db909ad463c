using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Lets body B slide along a line of body A, and nothing else: it neither turns against A nor leaves the line. A prismatic joint.</summary>
/// <remarks>Limits, a spring or a drive along the line are a <see cref="LinearAxisLimit"/>, <see cref="LinearAxisServo"/> or <see cref="LinearAxisMotor"/>
/// beside it.</remarks>
public struct Slider : ITwoBodyConstraintDescription<Slider>
{
    /// <summary>A point of the line in A's frame, m.</summary>
    public Vector3 LocalOffsetA;
    /// <summary>Direction of the line in A's frame; unit length.</summary>
    public Vector3 LocalAxisA;
    /// <summary>Anchor in B's frame, which stays on the line, m.</summary>
    public Vector3 LocalOffsetB;
    /// <summary>Orientation of B in A's frame: the rotation from B's frame to A's; unit length.</summary>
    public Quaternion LocalOrientation;
    /// <summary>Stiffness of the connection; the default is rigid.</summary>
    public SpringSettings SpringSettings;

    /// <inheritdoc/>
    public static int ConstraintTypeId => ConstraintTypeIds.Slider;
    /// <inheritdoc/>
    public static TypeProcessor CreateTypeProcessor() => new TypeProcessor<
        TwoBodies, SliderWide, Rows5, JointConstraint<TwoBodies, SliderWide, AngularAndTangentRows, Rows5, RowMatrix5, SliderJoint>>();
    /// <inheritdoc/>
    public static void Validate(in Slider description)
    {
        ConstraintChecks.Offset(description.LocalOffsetA, nameof(LocalOffsetA));
        ConstraintChecks.Unit(description.LocalAxisA, nameof(LocalAxisA));
        ConstraintChecks.Offset(description.LocalOffsetB, nameof(LocalOffsetB));
        ConstraintChecks.Unit(description.LocalOrientation, nameof(LocalOrientation));
        ConstraintChecks.Spring(description.SpringSettings, nameof(SpringSettings));
    }
}

/// <summary>A bundle of <see cref="Slider"/>.</summary>
struct SliderWide : IWide<Slider>
{
    /// <inheritdoc cref="Slider.LocalOffsetA"/>
    public Vector3Wide LocalOffsetA;
    /// <inheritdoc cref="Slider.LocalAxisA"/>
    public Vector3Wide LocalAxisA;
    /// <inheritdoc cref="Slider.LocalOffsetB"/>
    public Vector3Wide LocalOffsetB;
    /// <inheritdoc cref="Slider.LocalOrientation"/>
    public QuaternionWide LocalOrientation;
    /// <inheritdoc cref="Slider.SpringSettings"/>
    public SpringSettingsWide SpringSettings;
}

/// <summary>Rows of <see cref="Slider"/>: the angular ones of <see cref="Weld"/> and those of <see cref="PointOnLineServo"/>.</summary>
// C = [ e ; tx (pA - pB) ; ty (pA - pB) ]   e the rotation vector that turns B to where it belongs, pA and pB the points in the world,
//                                           (tx, ty, axis) a frame fixed to A
// The tangents turn with A, so that its arm ends where B's point is.
readonly struct SliderJoint : IJacobianJoint<TwoBodies, SliderWide, AngularAndTangentRows, Rows5, RowMatrix5>
{
    /// <inheritdoc/>
    public static bool PullsAtPoints => true;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void PointLoad(
        in AngularAndTangentRows geometry, in Rows5 impulses, out Vector3Wide impulse, out Vector3Wide offsetA, out Vector3Wide offsetB) =>
        geometry.Tangents.Load(impulses.Angular, out impulse, out offsetA, out offsetB);

    /// <inheritdoc/>
    public static bool TurnsByError => true;
    /// <inheritdoc/>
    public static bool CarriesBodies => true;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Prepare(in TwoBodies bodies, in SliderWide prestep, out AngularAndTangentRows geometry)
    {
        // Built in A's frame: built in the world the tangents would jump somewhere as the line turns, and the impulses with them.
        Vector3Wide.BuildOrthonormalBasis(prestep.LocalAxisA, out var tangentX, out var tangentY);
        geometry.Tangents.OffsetB = bodies.B.Orientation * prestep.LocalOffsetB;
        geometry.Tangents.OffsetA = (bodies.B.Position - bodies.A.Position) + geometry.Tangents.OffsetB;
        geometry.Tangents.TangentX = bodies.A.Orientation * tangentX;
        geometry.Tangents.TangentY = bodies.A.Orientation * tangentY;
    }

    /// <inheritdoc/>
    // A JIT root of its own: with it, the kernel runs out of the inliner's budget.
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static void PositionError(in TwoBodies bodies, in SliderWide prestep, in AngularAndTangentRows geometry, out Rows5 error)
    {
        var target = QuaternionWide.Concatenate(prestep.LocalOrientation, bodies.A.Orientation);
        error.Linear = AngularRows.RotationVector(QuaternionWide.Concatenate(QuaternionWide.Conjugate(bodies.B.Orientation), target));
        var separation = bodies.A.Orientation * prestep.LocalOffsetA - geometry.Tangents.OffsetA;
        error.Angular = new(Vector3Wide.Dot(geometry.Tangents.TangentX, separation), Vector3Wide.Dot(geometry.Tangents.TangentY, separation));
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static SpringSettingsWide Spring(in SliderWide prestep) => prestep.SpringSettings;
}
