using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>The sequential solver's way to hold a joint: one soft, clamped, block solve of all its rows per sweep.</summary>
public readonly partial struct JointConstraint<TBodies, TPrestep, TGeometry, TRows, TMass, TJoint> : IConstraint<TBodies, TPrestep, TRows>
    where TBodies : unmanaged, IBodySlots where TPrestep : unmanaged where TGeometry : unmanaged
    where TRows : unmanaged, IRows<TRows> where TMass : unmanaged, IRowMatrix<TMass, TRows>
    where TJoint : unmanaged, IJoint<TBodies, TPrestep, TGeometry, TRows, TMass>
{
    /// <inheritdoc/>
    public static BodyAccess WarmStartAccess
    {
        // A call otherwise, and what it says would not be known when the loops are compiled.
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => TJoint.Access;
    }
    /// <inheritdoc/>
    public static BodyAccess SolveAccess
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => TJoint.Access | TJoint.ErrorAccess | BodyAccess.Hub;
    }

    /// <inheritdoc/>
    public static bool CarriesPointLoad
    {
        // Calls in the loops of the solver otherwise.
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => TJoint.HoldsPoints || TJoint.PullsAtPoints;
    }
    /// <inheritdoc/>
    public static bool MayTurnFar
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => TJoint.HoldsPoints || TJoint.TurnsByError;
    }
    /// <inheritdoc/>
    public static bool MakesHubs
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => TJoint.HoldsPoints || TJoint.CarriesBodies;
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void WarmStart(ref TBodies bodies, in Substep substep, ref TPrestep prestep, ref TRows impulses)
    {
        if (substep.WarmStartScale != 1)
            impulses *= new Vector<float>(substep.WarmStartScale);
        TJoint.Prepare(bodies, prestep, out var geometry);
        TJoint.LeanRows(bodies, prestep, ref geometry);
        TJoint.ApplyImpulse(geometry, ref bodies, impulses);
    }

    /// <inheritdoc/>
    // Three kernels of which the JIT keeps one: a branch inside would take locals that the largest joint has none left of.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Solve(ref TBodies bodies, in Substep substep, ref TPrestep prestep, ref TRows impulses)
    {
        if (TJoint.Kind == RowKind.Motor)
            SolveVelocity(ref bodies, substep, ref prestep, ref impulses);
        else if (TJoint.Kind == RowKind.Inequality)
            SolveLimit(ref bodies, substep, ref prestep, ref impulses);
        else
            SolvePosition(ref bodies, substep, ref prestep, ref impulses);
    }

    // A kernel of this size is its own JIT root: inlined into the loop it would run out of the inliner's budget.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static void SolvePosition(ref TBodies bodies, in Substep substep, ref TPrestep prestep, ref TRows impulses)
    {
        // A servo's velocity is what it was asked for, and not left over from a correction.
        if (TJoint.Kind == RowKind.Servo && substep.IsRelaxation)
            return;
        TJoint.Prepare(bodies, prestep, out var geometry);
        TJoint.PositionError(bodies, prestep, geometry, out var error);
        // A dozen operations of springs wait for each other and for nothing else: of short kernels they begin early, of long ones where registers are free
        // again. Sizes are compared here and not by a property, or the JIT would take up both before it leaves one out.
        SoftnessWide softness = default;
        if (Unsafe.SizeOf<TRows>() == Unsafe.SizeOf<Vector<float>>())
            softness = Softness(ref bodies, substep, prestep);
        TJoint.LeanRows(bodies, prestep, ref geometry);
        TJoint.RelativeVelocity(geometry, bodies, out var velocity);
        TJoint.InverseEffectiveMass(geometry, bodies, out var inverseMass);
        if (Unsafe.SizeOf<TRows>() != Unsafe.SizeOf<Vector<float>>())
            softness = Softness(ref bodies, substep, prestep);

        if (MayTurnFar && !substep.IsRelaxation)
        {
            if (!Vector.EqualsAll(BodySlots.At(ref bodies, 0).CorrectionFlags, Vector<int>.Zero))
            {
                // Copies: a local whose address is taken is in memory all the time.
                TGeometry arms = geometry;
                TMass mass = inverseMass;
                TRows off = error;
                SoftnessWide damped = softness;
                Damp(bodies, substep, arms, mass, off, impulses, ref damped);
                softness = damped;
            }
        }
        var wanted = error * -softness.ErrorToVelocity;
        if (TJoint.Kind == RowKind.Servo)
            wanted = LimitSpeed(error, wanted, substep, TJoint.Servo(prestep));

        var change = TMass.Solve(inverseMass, (wanted - velocity) * softness.MassScale) - impulses * softness.ImpulseScale;
        if (TJoint.Kind == RowKind.Servo)
        {
            var sum = LimitLength(impulses + change, TJoint.Servo(prestep).MaximumForce * substep.Dt);
            change = sum - impulses;
            impulses = sum;
        }
        else
        {
            impulses += change;
        }
        TJoint.ApplyImpulse(geometry, ref bodies, change);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static SoftnessWide Softness(ref TBodies bodies, in Substep substep, in TPrestep prestep)
    {
        var isHub = BodySlots.At(ref bodies, 0).HubMask;
        if (TBodies.Count > 1) isHub |= BodySlots.At(ref bodies, 1).HubMask;
        if (TBodies.Count > 2) isHub |= BodySlots.At(ref bodies, 2).HubMask;
        if (TBodies.Count > 3) isHub |= BodySlots.At(ref bodies, 3).HubMask;
        var spring = TJoint.Spring(prestep);
        // How springs swing is not asked where there are none.
        var coupling = spring.AreRigid ? Vector<float>.Zero : Coupling(prestep, isHub);
        return TJoint.Kind == RowKind.Servo ?
            spring.ForSubstep(substep, substep.Servos, substep.RigidServos, isHub, coupling) :
            spring.ForSubstep(substep, substep.Joints, substep.RigidJoints, isHub, coupling);
    }

    // How springs swing. A limit uses up its slack, and a servo has a speed of its own where that is limited: neither is a spring that is left to swing, and
    // an explicit step of these would want more than all of an error in a substep. Joints that make no hubs are not counted, so many may be on a body.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<float> Coupling(in TPrestep prestep, Vector<int> isHub)
    {
        var isImplicit = new Vector<float>(SpringSettingsWide.ImplicitCoupling);
        if (TJoint.Kind == RowKind.Inequality)
            return isImplicit;
        var hub = new Vector<float>(SpringSettingsWide.HubCoupling);
        var coupling = MakesHubs ? Wide.Select(isHub, hub, new Vector<float>(SpringSettingsWide.AloneCoupling)) : hub;
        return TJoint.Kind == RowKind.Servo ? Wide.Select(HasLimitedSpeed(TJoint.Servo(prestep)), isImplicit, coupling) : coupling;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<int> HasLimitedSpeed(in ServoSettingsWide servo) =>
        Vector.GreaterThan(servo.BaseSpeed, Vector<float>.Zero) | Vector.LessThan(servo.MaximumSpeed, new Vector<float>(float.MaxValue));

    // A motor corrects no position: relaxation has nothing to take back, and hubs bear as much of it as chains.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static void SolveVelocity(ref TBodies bodies, in Substep substep, ref TPrestep prestep, ref TRows impulses)
    {
        if (substep.IsRelaxation)
            return;
        TJoint.Prepare(bodies, prestep, out var geometry);
        TJoint.TargetVelocity(bodies, prestep, geometry, out var wanted);
        TJoint.RelativeVelocity(geometry, bodies, out var velocity);
        TJoint.InverseEffectiveMass(geometry, bodies, out var inverseMass);
        var motor = TJoint.Motor(prestep);
        var softness = motor.ForSubstep(substep);
        var sum = impulses + (TMass.Solve(inverseMass, (wanted - velocity) * softness.MassScale) - impulses * softness.ImpulseScale);
        sum = LimitLength(sum, motor.MaximumForce * substep.Dt);
        var change = sum - impulses;
        impulses = sum;
        TJoint.ApplyImpulse(geometry, ref bodies, change);
    }

    // The speed of approach is at least the base speed, as long as that does not overshoot within the substep, and at most the maximum.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static TRows LimitSpeed(in TRows error, in TRows wanted, in Substep substep, in ServoSettingsWide servo)
    {
        // Most have no such limits, and need none of their roots and divisions.
        var isLimited = HasLimitedSpeed(servo);
        if (Vector.EqualsAll(isLimited, Vector<int>.Zero))
            return wanted;
        var errorLength = TRows.Length(error);
        var speed = TRows.Length(wanted);
        var baseSpeed = Wide.Min(servo.BaseSpeed, errorLength * substep.InverseDt);
        var limited = Wide.Min(Wide.Max(speed, baseSpeed), servo.MaximumSpeed);
        var scale = Vector.ConditionalSelect(Vector.GreaterThan(errorLength, Vector<float>.Zero), limited / errorLength, Vector<float>.Zero);
        return TRows.Select(isLimited, error * -scale, wanted);
    }

    // Brings a length down to a maximum. Most are below: then neither the division nor the product has to be waited for.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static TRows LimitLength(in TRows rows, Vector<float> maximum)
    {
        var length = TRows.Length(rows);
        var isLonger = Vector.GreaterThan(length, maximum);
        return Vector.EqualsAll(isLonger, Vector<int>.Zero) ? rows : rows * Wide.Select(isLonger, maximum / length, Vector<float>.One);
    }
}
