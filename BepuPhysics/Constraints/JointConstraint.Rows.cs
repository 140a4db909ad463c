using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

// What other solvers read of a joint, from the same parts as the sweeps. The coefficients are composed here a second time: shared with Solve they
// would take more locals than the JIT tracks in it. A test steps by these rows and compares with the sweeps.
public readonly partial struct JointConstraint<TBodies, TPrestep, TGeometry, TRows, TMass, TJoint>
{
    const int CoordinatesPerBody = 6;

    static bool IConstraint<TBodies, TPrestep, TRows>.HasError => MakesHubs && TJoint.Kind != RowKind.Servo;

    static BodyAccess IConstraint<TBodies, TPrestep, TRows>.ErrorAccess => BodyAccess.Pose | TJoint.ArmAccess;

    // The distance between points that are held together; of limits the greatest violation. A servo may be on its way.
    static Vector<float> IConstraint<TBodies, TPrestep, TRows>.Error(in TBodies bodies, in TPrestep prestep)
    {
        if (TJoint.Kind == RowKind.Servo)
            return Vector<float>.Zero;
        if (!TJoint.HoldsPoints && TJoint.Kind != RowKind.Inequality)
            return Vector<float>.Zero;
        ReadSeparation(bodies, prestep, out var linear, out _);
        return Wide.Mask(Vector.Equals(TJoint.Spring(prestep).AngularFrequency, Vector<float>.Zero), linear);
    }

    static bool IConstraint<TBodies, TPrestep, TRows>.HasPlaces => TJoint.HasPlaces;

    static void IConstraint<TBodies, TPrestep, TRows>.ShiftOrigin(ref TPrestep prestep, in Vector3Wide shift) =>
        TJoint.ShiftOrigin(ref prestep, shift);

    static bool IConstraint<TBodies, TPrestep, TRows>.HasSeparation => true;

    static void IConstraint<TBodies, TPrestep, TRows>.Separation(
        in TBodies bodies, in TPrestep prestep, out Vector<float> linear, out Vector<float> angular) =>
        ReadSeparation(bodies, prestep, out linear, out angular);

    // Lengths of what the rows of a kind are off by together; of limits only what is violated. A motor holds no place.
    static void ReadSeparation(in TBodies bodies, in TPrestep prestep, out Vector<float> linear, out Vector<float> angular)
    {
        linear = angular = Vector<float>.Zero;
        if (TJoint.Kind == RowKind.Motor)
            return;
        TJoint.Prepare(bodies, prestep, out var geometry);
        TJoint.PositionError(bodies, prestep, geometry, out var error);
        for (int i = 0; i < RowCount; ++i)
        {
            var row = Row(ref error, i);
            if (TJoint.Kind == RowKind.Inequality)
                row = Wide.Min(row, Vector<float>.Zero);
            if (TJoint.IsLinear(i))
                linear += row * row;
            else
                angular += row * row;
        }
        linear = Vector.SquareRoot(linear);
        angular = Vector.SquareRoot(angular);
    }

    static int RowCount => Unsafe.SizeOf<TRows>() / Unsafe.SizeOf<Vector<float>>();

    static int IConstraint<TBodies, TPrestep, TRows>.RowCount => RowCount;

    static bool IConstraint<TBodies, TPrestep, TRows>.IsLinear(int row) => TJoint.IsLinear(row);

    static RowLimit IConstraint<TBodies, TPrestep, TRows>.LimitOf(int row) =>
        TJoint.Kind == RowKind.Inequality ? RowLimit.Positive : IsLimited ? RowLimit.Length : RowLimit.None;

    static bool IsLimited => TJoint.Kind == RowKind.Servo || TJoint.Kind == RowKind.Motor;

    static void IConstraint<TBodies, TPrestep, TRows>.ReadRows(
        in TBodies bodies, in Substep substep, in TPrestep prestep, in TRows impulses, Span<ConstraintRowWide> rows)
    {
        TJoint.Prepare(bodies, prestep, out var geometry);
        TJoint.PositionError(bodies, prestep, geometry, out var error);
        TJoint.LeanRows(bodies, prestep, ref geometry);
        Aim(bodies, substep, prestep, geometry, error, impulses, out var target, out var softness, out var isHard);
        if (IsLimited && substep.IsRelaxation)
            softness = default;
        var greatest = new Vector<float>(float.PositiveInfinity);
        if (TJoint.Kind == RowKind.Servo)
            greatest = TJoint.Servo(prestep).MaximumForce * substep.Dt;
        if (TJoint.Kind == RowKind.Motor)
            greatest = TJoint.Motor(prestep).MaximumForce * substep.Dt;
        var accumulated = impulses;
        for (int i = 0; i < rows.Length; ++i)
        {
            ref var row = ref rows[i];
            row.PositionError = Row(ref error, i);
            row.TargetVelocity = Row(ref target, i);
            row.MassScale = softness.MassScale;
            row.ImpulseScale = softness.ImpulseScale;
            row.Impulse = Row(ref accumulated, i);
            row.MinimumImpulse = TJoint.Kind == RowKind.Inequality ? Vector<float>.Zero : -greatest;
            row.MaximumImpulse = greatest;
            row.HardMask = isHard;
        }
        // The bodies are the caller's own copy, of which nothing else is read.
        ReadJacobian(geometry, ref Unsafe.AsRef(in bodies), rows);
    }

    static void IConstraint<TBodies, TPrestep, TRows>.WriteImpulses(
        in TPrestep prestep, ReadOnlySpan<Vector<float>> rows, Vector<int> lanes, ref TRows impulses)
    {
        for (int i = 0; i < rows.Length; ++i)
            Row(ref impulses, i) = Wide.Select(lanes, rows[i], Row(ref impulses, i));
    }

    // J column by column: what the joint sees of a unit velocity. One that is not read is seen as none at all is.
    static void ReadJacobian(in TGeometry geometry, ref TBodies bodies, Span<ConstraintRowWide> rows)
    {
        for (int slot = 0; slot < TBodies.Count; ++slot)
        {
            ref var body = ref BodySlots.At(ref bodies, slot);
            body.Linear = body.Angular = default;
        }
        TJoint.RelativeVelocity(geometry, bodies, out var unseen);
        for (int slot = 0; slot < TBodies.Count; ++slot)
        {
            // Linear and angular velocity lie side by side, in bodies as in Jacobians.
            ref var coordinates = ref Unsafe.As<Vector3Wide, Vector<float>>(ref BodySlots.At(ref bodies, slot).Linear);
            for (int i = 0; i < CoordinatesPerBody; ++i)
            {
                var column = unseen;
                if ((TJoint.Access & (i < CoordinatesPerBody / 2 ? BodyAccess.Linear : BodyAccess.Angular)) != 0)
                {
                    Unsafe.Add(ref coordinates, i) = Vector<float>.One;
                    TJoint.RelativeVelocity(geometry, bodies, out column);
                    Unsafe.Add(ref coordinates, i) = Vector<float>.Zero;
                }
                for (int row = 0; row < rows.Length; ++row)
                    Unsafe.Add(ref Unsafe.As<RowJacobianWide, Vector<float>>(ref rows[row].Of(slot)), i) = Row(ref column, row);
            }
        }
    }

    // The velocity that Solve wants, and how softly.
    static void Aim(
        in TBodies bodies, in Substep substep, in TPrestep prestep, in TGeometry geometry, in TRows error, in TRows impulses,
        out TRows target, out SoftnessWide softness, out Vector<int> isHard)
    {
        if (TJoint.Kind == RowKind.Motor)
        {
            TJoint.TargetVelocity(bodies, prestep, geometry, out target);
            softness = TJoint.Motor(prestep).ForSubstep(substep);
            isHard = Vector.Equals(softness.ImpulseScale, Vector<float>.Zero);
            return;
        }
        isHard = Vector.Equals(TJoint.Spring(prestep).AngularFrequency, Vector<float>.Zero);
        var slots = bodies;
        softness = Softness(ref slots, substep, prestep);
        if (MayTurnFar && !substep.IsRelaxation && !Vector.EqualsAll(BodySlots.At(ref slots, 0).CorrectionFlags, Vector<int>.Zero))
        {
            TJoint.InverseEffectiveMass(geometry, bodies, out var inverseMass);
            var off = TJoint.Kind == RowKind.Inequality ? TRows.Min(error, default) : error;
            Damp(bodies, substep, geometry, inverseMass, off, impulses, ref softness);
        }
        target = error * -softness.ErrorToVelocity;
        if (TJoint.Kind == RowKind.Inequality)
            target = TRows.Min(target, error * new Vector<float>(-substep.InverseDt));
        if (TJoint.Kind == RowKind.Servo)
            target = LimitSpeed(error, target, substep, TJoint.Servo(prestep));
    }

    static ref Vector<float> Row(ref TRows rows, int index) => ref Unsafe.Add(ref Unsafe.As<TRows, Vector<float>>(ref rows), index);
}
