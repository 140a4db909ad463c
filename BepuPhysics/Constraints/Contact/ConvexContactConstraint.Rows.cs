using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints.Contact;

// What other solvers read of a contact: the normals, two rows of friction, and one of twist, which does nothing where a contact is alone and has no lever. The
// coefficients are composed a second time: the kernels are as the JIT likes them. A test steps by these rows and compares with the sweeps.
readonly partial struct ConvexContactConstraint<TBodies, TContacts, TNormals>
{
    static int FirstFriction => TContacts.Count;

    static bool IConstraint<TBodies, ConvexContactPrestepWide<TContacts>, ConvexContactImpulsesWide<TNormals>>.HasError => true;

    static BodyAccess IConstraint<TBodies, ConvexContactPrestepWide<TContacts>, ConvexContactImpulsesWide<TNormals>>.ErrorAccess =>
        BodyAccess.Displacement;

    // The depth of the deepest contact.
    static Vector<float> IConstraint<TBodies, ConvexContactPrestepWide<TContacts>, ConvexContactImpulsesWide<TNormals>>.Error(
        in TBodies bodies, in ConvexContactPrestepWide<TContacts> prestep)
    {
        // A copy: what is read through "in" by an index is copied each time.
        var patch = prestep;
        ConstraintRowWide row = default;
        var deepest = Vector<float>.Zero;
        for (int i = 0; i < TContacts.Count; ++i)
        {
            WriteJacobian(ref row, patch.Normal, patch.Contacts[i].OffsetA, patch.OffsetB);
            deepest = Wide.Max(deepest, patch.Contacts[i].Depth - Displacement(bodies, row));
        }
        // What a game gave a frequency is no error. That of held contacts is minus the band in which they know no overlap.
        var frequency = patch.Material.SpringSettings.AngularFrequency;
        return Wide.Mask(Vector.LessThanOrEqual(frequency, Vector<float>.Zero), deepest + frequency);
    }

    static int IConstraint<TBodies, ConvexContactPrestepWide<TContacts>, ConvexContactImpulsesWide<TNormals>>.RowCount =>
        TContacts.Count + 3;

    static RowLimit IConstraint<TBodies, ConvexContactPrestepWide<TContacts>, ConvexContactImpulsesWide<TNormals>>.LimitOf(int row) =>
        row < FirstFriction ? RowLimit.Positive : row < FirstFriction + 2 ? RowLimit.Friction : RowLimit.Twist;

    static void IConstraint<TBodies, ConvexContactPrestepWide<TContacts>, ConvexContactImpulsesWide<TNormals>>.ReadRows(
        in TBodies bodies, in Substep substep, in ConvexContactPrestepWide<TContacts> prestep, in ConvexContactImpulsesWide<TNormals> impulses,
        Span<ConstraintRowWide> rows)
    {
        // Copies: what is read through "in" by an index is copied each time.
        var patch = prestep;
        var accumulated = impulses;
        var n = patch.Normal;
        var center = PatchCenter(bodies, ref patch);
        var load = Vector<float>.Zero;
        var moment = Vector<float>.Zero;
        var turned = bodies;
        var pressed = Vector<float>.Zero;
        var mayCarry = MayCarry(bodies);
        if (IsFlat && mayCarry)
        {
            TurnSurface(ref turned, substep, n, out var towards);
            pressed = -Vector3Wide.Dot(towards, n);
        }
        for (int i = 0; i < TContacts.Count; ++i)
        {
            ref var row = ref rows[i];
            var arm = patch.Contacts[i].OffsetA;
            WriteJacobian(ref row, n, arm, patch.OffsetB);
            row.Impulse = accumulated.Normals[i];
            row.Lever = (arm - center).Length();
            row.PositionError = Displacement(turned, row) - patch.Contacts[i].Depth;
            row.MaximumImpulse = new(float.PositiveInfinity);
            row.HardMask = Vector.LessThanOrEqual(patch.Material.SpringSettings.AngularFrequency, Vector<float>.Zero);
            AimNormal(turned, substep, patch.Material, ref row);
            row.TargetVelocity -= pressed;
            load += row.Impulse;
            moment += row.Impulse * row.Lever;
        }
        var coefficient = Coefficient(ref patch);
        Vector3Wide.BuildOrthonormalBasis(n, out var x, out var y);
        WriteFriction(ref rows[FirstFriction], Vector3Wide.Dot(accumulated.Friction, x), coefficient, load);
        Vector3Wide rubbedA = center, rubbedB = default;
        if (TBodies.Count > 1)
        {
            rubbedB = center - patch.OffsetB;
            if (mayCarry)
                GoAlong(bodies, substep, n, ref rubbedA, ref rubbedB);
            TurnTogether(bodies, substep, n, patch.Material.TurnsAlong, ref rubbedA, ref rubbedB);
        }
        WriteJacobian(ref rows[FirstFriction], x, rubbedA, rubbedA - rubbedB);
        WriteFriction(ref rows[FirstFriction + 1], Vector3Wide.Dot(accumulated.Friction, y), coefficient, load);
        WriteJacobian(ref rows[FirstFriction + 1], y, rubbedA, rubbedA - rubbedB);
        ref var twist = ref rows[FirstFriction + 2];
        WriteFriction(ref twist, accumulated.Twist, coefficient, moment);
        if (TContacts.Count == 1)
            twist.MassScale = Wide.Mask(JoinsFriction(ref patch), twist.MassScale);
        twist.A.Angular = n;
        if (TBodies.Count > 1)
            twist.B.Angular = -n;
    }

    static void IConstraint<TBodies, ConvexContactPrestepWide<TContacts>, ConvexContactImpulsesWide<TNormals>>.WriteImpulses(
        in ConvexContactPrestepWide<TContacts> prestep, ReadOnlySpan<Vector<float>> rows, Vector<int> lanes, ref ConvexContactImpulsesWide<TNormals> impulses)
    {
        for (int i = 0; i < TNormals.Count; ++i)
            impulses.Normals[i] = Wide.Select(lanes, rows[i], impulses.Normals[i]);
        Vector3Wide.BuildOrthonormalBasis(prestep.Normal, out var x, out var y);
        impulses.Friction = Vector3Wide.Select(lanes, x * rows[FirstFriction] + y * rows[FirstFriction + 1], impulses.Friction);
        impulses.Twist = Wide.Select(lanes, rows[FirstFriction + 2], impulses.Twist);
    }

    // An impulse along a direction at an arm from A, and the opposite on B.
    static void WriteJacobian(ref ConstraintRowWide row, in Vector3Wide direction, in Vector3Wide arm, in Vector3Wide offsetB)
    {
        row.A.Linear = direction;
        row.A.Angular = Vector3Wide.Cross(arm, direction);
        if (TBodies.Count == 1)
            return;
        row.B.Linear = -direction;
        row.B.Angular = Vector3Wide.Cross(direction, arm - offsetB);
    }

    static void WriteFriction(ref ConstraintRowWide row, Vector<float> impulse, Vector<float> coefficient, Vector<float> load)
    {
        row.Impulse = impulse;
        row.MassScale = Vector<float>.One;
        row.FrictionCoefficient = coefficient;
        row.MaximumImpulse = coefficient * load;
        row.MinimumImpulse = -row.MaximumImpulse;
        row.HardMask = new(-1);
    }

    // How far the surfaces have parted since collision detection.
    static Vector<float> Displacement(in TBodies bodies, in ConstraintRowWide row)
    {
        ref var slots = ref Unsafe.AsRef(in bodies);
        ref var a = ref BodySlots.At(ref slots, 0);
        var apart = Vector3Wide.Dot(a.Translation, row.A.Linear) + Vector3Wide.Dot(a.Rotation, row.A.Angular);
        if (TBodies.Count > 1)
        {
            ref var b = ref BodySlots.At(ref slots, 1);
            apart += Vector3Wide.Dot(b.Translation, row.B.Linear) + Vector3Wide.Dot(b.Rotation, row.B.Angular);
        }
        return apart;
    }

    // How fast the surfaces part, and how much faster by an impulse of one.
    static (Vector<float> Velocity, Vector<float> InverseMass) Motion(in TBodies bodies, in ConstraintRowWide row)
    {
        ref var slots = ref Unsafe.AsRef(in bodies);
        ref var a = ref BodySlots.At(ref slots, 0);
        var velocity = Vector3Wide.Dot(a.Linear, row.A.Linear) + Vector3Wide.Dot(a.Angular, row.A.Angular);
        var inverseMass = a.InverseMass + Vector3Wide.Dot(a.InverseInertia * row.A.Angular, row.A.Angular);
        if (TBodies.Count > 1)
        {
            ref var b = ref BodySlots.At(ref slots, 1);
            velocity += Vector3Wide.Dot(b.Linear, row.B.Linear) + Vector3Wide.Dot(b.Angular, row.B.Angular);
            inverseMass += b.InverseMass + Vector3Wide.Dot(b.InverseInertia * row.B.Angular, row.B.Angular);
        }
        return (velocity, inverseMass);
    }

    // The velocity that SolveNormal wants, and how softly. Where recovery is limited that depends on the velocity, which the contacts before this one change.
    static void AimNormal(in TBodies bodies, in Substep substep, in ContactMaterialWide material, ref ConstraintRowWide row)
    {
        var softness = material.SpringSettings.ForSubstep(substep, substep.Contacts);
        var band = Harden(material.IsHeld, substep, material.SpringSettings.AngularFrequency, ref softness);
        var depth = -row.PositionError;
        depth -= Wide.Clamp(depth, -band, band);
        var recovery = depth * softness.ErrorToVelocity;
        var isLimited = Vector.GreaterThan(recovery, material.MaximumRecoveryVelocity);
        row.TargetVelocity = Wide.Min(depth * new Vector<float>(substep.InverseDt), Wide.Min(recovery, material.MaximumRecoveryVelocity));
        row.MassScale = softness.MassScale;
        row.ImpulseScale = softness.ImpulseScale;
        if (!Vector.EqualsAll(isLimited, Vector<int>.Zero))
        {
            var (velocity, inverseMass) = Motion(bodies, row);
            var kept = KeptSoftness(material.MaximumRecoveryVelocity, recovery, velocity, row.Impulse * inverseMass);
            Stiffen(isLimited, kept, ref row.MassScale, ref row.ImpulseScale);
        }
        if (substep.IsRelaxation)
            row.MassScale = Wide.Mask(Vector.GreaterThan(row.Impulse, Vector<float>.Zero), row.MassScale);
    }
}
