using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>A rope from body A over two wheels of a body C to body B: <c>lengthA + Ratio lengthB</c> stays at most a length, the rope may be slack.</summary>
/// <remarks>
/// The lengths are those from the bodies' anchors to the wheels, which are points without a size. A ratio of 2 is a block and tackle of two parts at B: B
/// moves half as far as A and is pulled twice as hard. C may be kinematic: then the wheels hang from the world.
/// </remarks>
public struct Pulley : IThreeBodyConstraintDescription<Pulley>
{
    /// <summary>Anchor in A's frame, m.</summary>
    public Vector3 LocalOffsetA;
    /// <summary>Anchor in B's frame, m.</summary>
    public Vector3 LocalOffsetB;
    /// <summary>Wheel over which the part of A runs, in C's frame, m.</summary>
    public Vector3 LocalWheelA;
    /// <summary>Wheel over which the part of B runs, in C's frame, m.</summary>
    public Vector3 LocalWheelB;
    /// <summary>Parts of rope at B for one at A; positive, at most 10,000.</summary>
    public float Ratio;
    /// <summary>Greatest length of A's part plus ratio times B's, m; not negative.</summary>
    public float MaximumLength;
    /// <summary>Stiffness of the rope; the default is rigid.</summary>
    public SpringSettings SpringSettings;

    /// <inheritdoc/>
    public static int ConstraintTypeId => ConstraintTypeIds.Pulley;
    /// <inheritdoc/>
    public static TypeProcessor CreateTypeProcessor() =>
        new TypeProcessor<ThreeBodies, PulleyWide, Rows1, JointConstraint<ThreeBodies, PulleyWide, HousedRow, Rows1, Rows1, PulleyJoint>>();
    /// <inheritdoc/>
    public static void Validate(in Pulley description)
    {
        ConstraintChecks.Offset(description.LocalOffsetA, nameof(LocalOffsetA));
        ConstraintChecks.Offset(description.LocalOffsetB, nameof(LocalOffsetB));
        ConstraintChecks.Offset(description.LocalWheelA, nameof(LocalWheelA));
        ConstraintChecks.Offset(description.LocalWheelB, nameof(LocalWheelB));
        ConstraintChecks.RopeRatio(description.Ratio, nameof(Ratio));
        ConstraintChecks.Distance(description.MaximumLength, nameof(MaximumLength));
        ConstraintChecks.Spring(description.SpringSettings, nameof(SpringSettings));
    }
}

/// <summary>A bundle of <see cref="Pulley"/>.</summary>
struct PulleyWide : IWide<Pulley>
{
    /// <inheritdoc cref="Pulley.LocalOffsetA"/>
    public Vector3Wide LocalOffsetA;
    /// <inheritdoc cref="Pulley.LocalOffsetB"/>
    public Vector3Wide LocalOffsetB;
    /// <inheritdoc cref="Pulley.LocalWheelA"/>
    public Vector3Wide LocalWheelA;
    /// <inheritdoc cref="Pulley.LocalWheelB"/>
    public Vector3Wide LocalWheelB;
    /// <inheritdoc cref="Pulley.Ratio"/>
    public Vector<float> Ratio;
    /// <inheritdoc cref="Pulley.MaximumLength"/>
    public Vector<float> MaximumLength;
    /// <inheritdoc cref="Pulley.SpringSettings"/>
    public SpringSettingsWide SpringSettings;
}

/// <summary>Row of <see cref="Pulley"/>.</summary>
// C = maximum - (|dA| + ratio |dB|) >= 0,  d from an anchor to its wheel
// J = [ uA, rA x uA, ratio uB, ratio rB x uB, -(uA + ratio uB), -(wA x uA + ratio wB x uB) ],  u = d / |d|, w from C's centre to the wheel
// An anchor in its wheel has no u; it is the world's Y axis by definition, and the rope cannot push it.
readonly struct PulleyJoint : IJacobianJoint<ThreeBodies, PulleyWide, HousedRow, Rows1, Rows1>
{
    /// <inheritdoc/>
    public static bool TurnsByError => true;
    /// <inheritdoc/>
    public static RowKind Kind => RowKind.Inequality;
    /// <inheritdoc/>
    public static bool CarriesBodies => true;

    /// <inheritdoc/>
    // A JIT root of its own: beside three bodies it would take more locals than the JIT tracks.
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static void Prepare(in ThreeBodies bodies, in PulleyWide prestep, out HousedRow geometry)
    {
        var lengthA = Part(
            bodies.A, bodies.C, prestep.LocalOffsetA, prestep.LocalWheelA, Vector<float>.One, out geometry.LinearA, out geometry.AngularA, out var onWheelA);
        var lengthB = Part(
            bodies.B, bodies.C, prestep.LocalOffsetB, prestep.LocalWheelB, prestep.Ratio, out geometry.LinearB, out geometry.AngularB, out var onWheelB);
        geometry.AngularC = -(onWheelA + onWheelB);
        geometry.Value = prestep.MaximumLength - (lengthA + prestep.Ratio * lengthB);
    }

    // The length of a part of the rope, and its rows times a factor.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<float> Part(
        in SolverBodyWide body, in SolverBodyWide housing, in Vector3Wide localOffset, in Vector3Wide localWheel, Vector<float> factor,
        out Vector3Wide linear, out Vector3Wide angular, out Vector3Wide onWheel)
    {
        var offset = body.Orientation * localOffset;
        var wheel = housing.Orientation * localWheel;
        // The positions are subtracted first: far from the origin their difference is still exact.
        var difference = (housing.Position - body.Position) + (wheel - offset);
        var lengthSquared = difference.LengthSquared();
        var length = Vector.SquareRoot(lengthSquared);
        linear = LinearRow.DirectionOf(difference, lengthSquared, length, factor);
        angular = Vector3Wide.Cross(offset, linear);
        onWheel = Vector3Wide.Cross(wheel, linear);
        return length;
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void PositionError(in ThreeBodies bodies, in PulleyWide prestep, in HousedRow geometry, out Rows1 error) => error.X = geometry.Value;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static SpringSettingsWide Spring(in PulleyWide prestep) => prestep.SpringSettings;
}
