using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Gears two wheels A and B that turn in a housing C: <c>TeethA angleA + TeethB angleB</c> stays zero. The wheels need hinges of their own.</summary>
/// <remarks>
/// Angles are those of the wheels against the housing about the Z axes of their bases. Teeth are whole numbers, so the sum is the same after any number
/// of whole turns, and none have to be counted: wheels may turn for ever and keep their place. As with real wheels, what pushes them apart by more than
/// half a tooth lets them go on a tooth further. Positive counts are wheels that turn against each other about axes that point the same way; with one
/// negative they turn the same way, as a ring and the wheel within it. The housing, which may be kinematic, bears the torque that the wheels do not cancel.
/// </remarks>
public struct Gear : IThreeBodyConstraintDescription<Gear>
{
    /// <summary>Rotation from the joint's frame to A's; its Z axis is the wheel's axis, X is what is measured; unit length.</summary>
    public Quaternion LocalBasisA;
    /// <summary>Rotation from the joint's frame to B's; its Z axis is the wheel's axis, X is what is measured; unit length.</summary>
    public Quaternion LocalBasisB;
    /// <summary>Rotation from the joint's frame to that of the housing, for A: its Z axis is A's, X is angle 0, Y a quarter turn; unit length.</summary>
    public Quaternion LocalHousingBasisA;
    /// <summary>Rotation from the joint's frame to that of the housing, for B: its Z axis is B's, X is angle 0, Y a quarter turn; unit length.</summary>
    public Quaternion LocalHousingBasisB;
    /// <summary>Teeth of A: a whole number from 1 to 1000, or its negative.</summary>
    public float TeethA;
    /// <summary>Teeth of B: a whole number from 1 to 1000, or its negative.</summary>
    public float TeethB;
    /// <summary>Stiffness of the teeth; the default is rigid.</summary>
    public SpringSettings SpringSettings;

    /// <inheritdoc/>
    public static int ConstraintTypeId => ConstraintTypeIds.Gear;
    /// <inheritdoc/>
    public static TypeProcessor CreateTypeProcessor() =>
        new TypeProcessor<ThreeBodies, GearWide, Rows1, JointConstraint<ThreeBodies, GearWide, HousedRow, Rows1, Rows1, GearJoint>>();
    /// <inheritdoc/>
    public static void Validate(in Gear description)
    {
        ConstraintChecks.Unit(description.LocalBasisA, nameof(LocalBasisA));
        ConstraintChecks.Unit(description.LocalBasisB, nameof(LocalBasisB));
        ConstraintChecks.Unit(description.LocalHousingBasisA, nameof(LocalHousingBasisA));
        ConstraintChecks.Unit(description.LocalHousingBasisB, nameof(LocalHousingBasisB));
        ConstraintChecks.Teeth(description.TeethA, nameof(TeethA));
        ConstraintChecks.Teeth(description.TeethB, nameof(TeethB));
        ConstraintChecks.Spring(description.SpringSettings, nameof(SpringSettings));
    }
}

/// <summary>A bundle of <see cref="Gear"/>.</summary>
struct GearWide : IWide<Gear>
{
    /// <inheritdoc cref="Gear.LocalBasisA"/>
    public QuaternionWide LocalBasisA;
    /// <inheritdoc cref="Gear.LocalBasisB"/>
    public QuaternionWide LocalBasisB;
    /// <inheritdoc cref="Gear.LocalHousingBasisA"/>
    public QuaternionWide LocalHousingBasisA;
    /// <inheritdoc cref="Gear.LocalHousingBasisB"/>
    public QuaternionWide LocalHousingBasisB;
    /// <inheritdoc cref="Gear.TeethA"/>
    public Vector<float> TeethA;
    /// <inheritdoc cref="Gear.TeethB"/>
    public Vector<float> TeethB;
    /// <inheritdoc cref="Gear.SpringSettings"/>
    public SpringSettingsWide SpringSettings;
}

/// <summary>Row of <see cref="Gear"/>.</summary>
// C = (nA twistA + nB twistB less whole turns) / n   n the greater of |nA| and |nB|: radians of the larger wheel, within half a tooth of it
// A twist jumps by a turn somewhere; n times that is whole turns, which do not count.
readonly struct GearJoint : IJacobianJoint<ThreeBodies, GearWide, HousedRow, Rows1, Rows1>
{
    /// <inheritdoc/>
    public static bool IsLinear(int row) => false;

    /// <inheritdoc/>
    // A JIT root of its own: beside three bodies it would take more locals than the JIT tracks.
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static void Prepare(in ThreeBodies bodies, in GearWide prestep, out HousedRow geometry)
    {
        var scale = Vector<float>.One / Wide.Max(Vector.Abs(prestep.TeethA), Vector.Abs(prestep.TeethB));
        var angleA = HousedRow.Turn(
            bodies.A, bodies.C, prestep.LocalBasisA, prestep.LocalHousingBasisA, prestep.TeethA * scale, out geometry.AngularA, out var heldA);
        var angleB = HousedRow.Turn(
            bodies.B, bodies.C, prestep.LocalBasisB, prestep.LocalHousingBasisB, prestep.TeethB * scale, out geometry.AngularB, out var heldB);
        geometry.AngularC = -(geometry.AngularA + geometry.AngularB);
        geometry.LinearA = geometry.LinearB = Vector3Wide.Zero;
        geometry.Value = TwistAngle.WithinHalfATurn(prestep.TeethA * angleA + prestep.TeethB * angleB) * (scale * (heldA * heldB));
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void PositionError(in ThreeBodies bodies, in GearWide prestep, in HousedRow geometry, out Rows1 error) => error.X = geometry.Value;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static SpringSettingsWide Spring(in GearWide prestep) => prestep.SpringSettings;
}
