using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

// The sweep of joints whose rows may push but not pull. Most limits are out of reach nearly all the time.
public readonly partial struct JointConstraint<TBodies, TPrestep, TGeometry, TRows, TMass, TJoint>
{
    [MethodImpl(MethodImplOptions.NoInlining)]
    static void SolveLimit(ref TBodies bodies, in Substep substep, ref TPrestep prestep, ref TRows impulses)
    {
        TJoint.Prepare(bodies, prestep, out var geometry);
        TJoint.RelativeVelocity(geometry, bodies, out var velocity);
        if (CanBeIdle)
        {
            TRows slack;
            if (TJoint.BoundsSlack)
                TJoint.LeastSlack(prestep, geometry, out slack);
            else
                TJoint.PositionError(bodies, prestep, geometry, out slack);
            if (AreOutOfReach(slack, velocity, impulses, substep))
                return;
        }
        TJoint.PositionError(bodies, prestep, geometry, out var error);
        var softness = Softness(ref bodies, substep, prestep);
        if (MayTurnFar && !substep.IsRelaxation)
        {
            if (!Vector.EqualsAll(BodySlots.At(ref bodies, 0).CorrectionFlags, Vector<int>.Zero))
                DampLimit(bodies, substep, geometry, error, impulses, ref softness);
        }
        // Slack that is left (C > 0) may be used up but not overdrawn: v >= -C / h. A violation is corrected as the spring says.
        // The first is the smaller of the two where C > 0, the second where C < 0, since ErrorToVelocity < 1 / h.
        var wanted = TRows.Min(error * -softness.ErrorToVelocity, error * new Vector<float>(-substep.InverseDt));
        var missing = (wanted - velocity) * softness.MassScale;
        var isIdle = Vector<int>.Zero;
        if (CanBeIdle)
        {
            // Without an impulse so far, and none to come.
            isIdle = Vector.Equals(TRows.Length(TRows.ClampToPositive(missing)) + TRows.Length(impulses), Vector<float>.Zero);
            if (Vector.EqualsAll(isIdle, new Vector<int>(-1)))
                return;
        }
        TJoint.InverseEffectiveMass(geometry, bodies, out var inverseMass);
        var sum = TRows.ClampToPositive(impulses + (TMass.Solve(inverseMass, missing) - impulses * softness.ImpulseScale));
        var change = sum - impulses;
        impulses = sum;
        ApplyWhere(~isIdle, geometry, ref bodies, change);
    }

    // Whether a substep at the present velocities ends short of all limits, so that none of them asks how soft it is. A lane for which this holds is idle by
    // what is asked above as well, to the last bit: there C is no less, both products with 1/h are rounded alike, and no softness changes the sign of what
    // is missing.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static bool AreOutOfReach(in TRows slack, in TRows velocity, in TRows impulses, in Substep substep) => Vector.EqualsAll(
        Vector.GreaterThanOrEqual(Only(slack), Vector<float>.Zero) &
        Vector.GreaterThanOrEqual(Only(velocity), Only(slack * new Vector<float>(-substep.InverseDt))) &
        Vector.Equals(Only(impulses), Vector<float>.Zero), new Vector<int>(-1));

    // The number of the only row.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<float> Only(in TRows rows) => Unsafe.As<TRows, Vector<float>>(ref Unsafe.AsRef(in rows));

    // Copies: a local whose address is taken is in memory all the time.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void DampLimit(
        in TBodies bodies, in Substep substep, in TGeometry geometry, in TRows error, in TRows impulses, ref SoftnessWide softness)
    {
        TGeometry arms = geometry;
        SoftnessWide damped = softness;
        TJoint.InverseEffectiveMass(arms, bodies, out var mass);
        Damp(bodies, substep, arms, mass, TRows.Min(error, default), impulses, ref damped);
        softness = damped;
    }

    // A single row: whether it has anything to do is clear before it is solved. (No limit has four bodies.)
    static bool CanBeIdle
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => Unsafe.SizeOf<TRows>() == Unsafe.SizeOf<Vector<float>>() && TBodies.Count < 4;
    }

    // Other lanes stay as they are to the last bit, as they do in a bundle of which all are idle: what zero is added to may be a zero of the other sign.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void ApplyWhere(Vector<int> lanes, in TGeometry geometry, ref TBodies bodies, in TRows change)
    {
        if (!CanBeIdle)
        {
            TJoint.ApplyImpulse(geometry, ref bodies, change);
            return;
        }
        Vector3Wide linearA = default, angularA = default, linearB = default, angularB = default, linearC = default, angularC = default;
        ReadVelocity(BodySlots.At(ref bodies, 0), ref linearA, ref angularA);
        if (TBodies.Count > 1) ReadVelocity(BodySlots.At(ref bodies, 1), ref linearB, ref angularB);
        if (TBodies.Count > 2) ReadVelocity(BodySlots.At(ref bodies, 2), ref linearC, ref angularC);
        TJoint.ApplyImpulse(geometry, ref bodies, change);
        WriteVelocity(lanes, linearA, angularA, ref BodySlots.At(ref bodies, 0));
        if (TBodies.Count > 1) WriteVelocity(lanes, linearB, angularB, ref BodySlots.At(ref bodies, 1));
        if (TBodies.Count > 2) WriteVelocity(lanes, linearC, angularC, ref BodySlots.At(ref bodies, 2));
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void ReadVelocity(in SolverBodyWide body, ref Vector3Wide linear, ref Vector3Wide angular)
    {
        if ((TJoint.Access & BodyAccess.Linear) != 0) linear = body.Linear;
        if ((TJoint.Access & BodyAccess.Angular) != 0) angular = body.Angular;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void WriteVelocity(Vector<int> lanes, in Vector3Wide linear, in Vector3Wide angular, ref SolverBodyWide body)
    {
        if ((TJoint.Access & BodyAccess.Linear) != 0) body.Linear = Vector3Wide.Select(lanes, body.Linear, linear);
        if ((TJoint.Access & BodyAccess.Angular) != 0) body.Angular = Vector3Wide.Select(lanes, body.Angular, angular);
    }
}
