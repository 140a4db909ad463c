using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

// How far a joint turns its bodies: by its load, and by what it corrects (JointTurn.cs).
public readonly partial struct JointConstraint<TBodies, TPrestep, TGeometry, TRows, TMass, TJoint>
{
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static bool TryGetGeometricStiffness(
        in TBodies bodies, in Substep substep, in TPrestep prestep, in TRows impulses, out Symmetric3x3Wide stiffnessA, out Symmetric3x3Wide stiffnessB,
        out Vector<int> turnsFar)
    {
        TJoint.Prepare(bodies, prestep, out var geometry);
        turnsFar = TJoint.TurnsByError ? ErrorTurnsFar(bodies, substep, prestep, geometry) : Vector<int>.Zero;
        stiffnessA = stiffnessB = default;
        if (!CarriesPointLoad)
            return false;
        TJoint.PointLoad(geometry, impulses, out var impulse, out var offsetA, out var offsetB);
        ref var slots = ref Unsafe.AsRef(in bodies);
        ref var inverseInertiaA = ref BodySlots.At(ref slots, 0).InverseInertia;
        ref var inverseInertiaB = ref BodySlots.At(ref slots, TBodies.Count - 1).InverseInertia;
        var limit = JointTurn.Limit(substep, TJoint.Kind == RowKind.Servo ? substep.Servos : substep.Joints);
        // Most joints bear so little that neither can be, however the load lies to the arms.
        var turnSquared = impulse.LengthSquared() * Wide.Max(TurnSquared(offsetA, inverseInertiaA), TurnSquared(offsetB, inverseInertiaB));
        var least = MathHelper.Min(limit, GeometricStiffness.LeastTurn(substep));
        if (Vector.LessThanAll(turnSquared, new Vector<float>(SlightPart * least * least)))
            return false;
        if (TJoint.HoldsPoints)
            turnsFar |= IsCorrectedAtOnce(prestep) & JointTurn.IsFar(impulse, offsetA, inverseInertiaA, offsetB, inverseInertiaB, limit);
        var force = impulse * new Vector<float>(substep.InverseDt);
        var tensionA = GeometricStiffness.Tension(force, offsetA, inverseInertiaA, substep);
        var tensionB = GeometricStiffness.Tension(-force, offsetB, inverseInertiaB, substep);
        if (Vector.EqualsAll(tensionA + tensionB, Vector<float>.Zero))
            return false;
        stiffnessA = GeometricStiffness.Of(tensionA, offsetA);
        stiffnessB = GeometricStiffness.Of(tensionB, offsetB);
        return true;
    }

    // Less than one by more than what sums and products of these sizes are rounded by.
    const float SlightPart = 0.99f;

    // Square of the greatest angular velocity that a unit impulse on the arm can change: the trace is no less than the greatest inverse moment.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<float> TurnSquared(in Vector3Wide arm, in Symmetric3x3Wide inverseInertia)
    {
        var trace = inverseInertia.XX + inverseInertia.YY + inverseInertia.ZZ;
        return arm.LengthSquared() * (trace * trace);
    }

    // What slides on a line has an arm that changes, and with it what its bodies would be taken to have: a source of energy in itself.
    static bool IConstraint<TBodies, TPrestep, TRows>.TakesAlong
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => TJoint.HoldsPoints || (TJoint.PullsAtPoints && TJoint.Kind == RowKind.Motor);
    }

    static Vector<int> IConstraint<TBodies, TPrestep, TRows>.IsFirm(in TPrestep prestep)
    {
        var unlimited = new Vector<float>(float.MaxValue);
        if (TJoint.Kind == RowKind.Motor)
        {
            var motor = TJoint.Motor(prestep);
            return Vector.GreaterThanOrEqual(motor.MaximumForce, unlimited) & Vector.GreaterThanOrEqual(motor.Damping, unlimited);
        }
        var isRigid = HasRigidSpring(prestep);
        return TJoint.Kind == RowKind.Servo ? isRigid & Vector.GreaterThanOrEqual(TJoint.Servo(prestep).MaximumForce, unlimited) : isRigid;
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    static void IConstraint<TBodies, TPrestep, TRows>.ReadArms(
        in TBodies bodies, in TPrestep prestep, in TRows impulses, out Vector3Wide armA, out Vector3Wide armB)
    {
        TJoint.Prepare(bodies, prestep, out var geometry);
        TJoint.PointLoad(geometry, impulses, out _, out armA, out armB);
    }

    // Whether an error may be corrected otherwise than a game asked for: springs and speeds that it chose are what it gets.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<int> IsCorrectedAtOnce(in TPrestep prestep)
    {
        var isRigid = HasRigidSpring(prestep);
        if (TJoint.Kind == RowKind.Servo)
            isRigid &= Vector.Equals(TJoint.Servo(prestep).MaximumSpeed, new Vector<float>(float.MaxValue));
        return isRigid;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<int> HasRigidSpring(in TPrestep prestep) => Vector.Equals(TJoint.Spring(prestep).AngularFrequency, Vector<float>.Zero);

    // A limit corrects only what is beyond it.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static Vector<int> ErrorTurnsFar(in TBodies bodies, in Substep substep, in TPrestep prestep, in TGeometry geometry)
    {
        TJoint.PositionError(bodies, prestep, geometry, out var error);
        if (TJoint.Kind == RowKind.Inequality)
            error = TRows.Min(error, default);
        TJoint.InverseEffectiveMass(geometry, bodies, out var inverseMass);
        var turnSquared = TurnSquared(bodies, geometry, inverseMass, error);
        return IsCorrectedAtOnce(prestep) & JointTurn.IsFar(turnSquared, TJoint.Kind == RowKind.Servo ? substep.Servos : substep.Joints);
    }

    // Square of the greatest angle by which correcting all of C turns a body: what it does to rotations is M^-1 J^T K^-1 C.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<float> TurnSquared(in TBodies bodies, in TGeometry geometry, in TMass inverseMass, in TRows error)
    {
        var still = bodies;
        BodySlots.At(ref still, 0).Angular = Vector3Wide.Zero;
        if (TBodies.Count > 1) BodySlots.At(ref still, 1).Angular = Vector3Wide.Zero;
        if (TBodies.Count > 2) BodySlots.At(ref still, 2).Angular = Vector3Wide.Zero;
        TJoint.ApplyImpulse(geometry, ref still, TMass.Solve(inverseMass, error));
        var greatest = BodySlots.At(ref still, 0).Angular.LengthSquared();
        if (TBodies.Count > 1) greatest = Wide.Max(greatest, BodySlots.At(ref still, 1).Angular.LengthSquared());
        if (TBodies.Count > 2) greatest = Wide.Max(greatest, BodySlots.At(ref still, 2).Angular.LengthSquared());
        return greatest;
    }
}
