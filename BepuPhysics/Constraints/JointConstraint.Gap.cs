using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

// Joints whose correction is damped: where it turns a body far (JointTurn.cs), and while a gap closes (JointGap.cs).
public readonly partial struct JointConstraint<TBodies, TPrestep, TGeometry, TRows, TMass, TJoint>
{
    [MethodImpl(MethodImplOptions.NoInlining)]
    static void Damp(
        in TBodies bodies, in Substep substep, in TGeometry geometry, in TMass inverseMass, in TRows error, in TRows impulses,
        ref SoftnessWide softness)
    {
        var turnsFar = BodySlots.At(ref Unsafe.AsRef(in bodies), 0).TurnMask;
        var part = JointTurn.PartOf(TurnSquared(bodies, geometry, inverseMass, error), substep.Dt, turnsFar, softness);
        var hasGap = BodySlots.At(ref Unsafe.AsRef(in bodies), 0).GapMask;
        if (!Vector.EqualsAll(hasGap, Vector<int>.Zero))
        {
            var waySquared = WaySquared(bodies, geometry, Beyond(TMass.Solve(inverseMass, error), impulses, softness));
            part = Wide.Select(hasGap, Wide.Min(part, JointGap.PartOf(waySquared, softness)), part);
        }
        JointTurn.Damp(part, ref softness);
    }

    // What a servo is off by is what it is there for, and it has a greatest speed of its own where a game wants one.
    static bool IConstraint<TBodies, TPrestep, TRows>.ClosesGaps => ClosesGaps;

    static bool ClosesGaps
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => MayTurnFar && (TJoint.Kind == RowKind.Equality || TJoint.Kind == RowKind.Inequality);
    }

    // At rest a joint is off by what its load l makes of it, K^-1 C = -l ImpulseScale / (MassScale ErrorToVelocity). What K^-1 C is beyond that closes, by a
    // part ErrorToVelocity of it in a second, however the joint is damped.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static TRows Beyond(in TRows correction, in TRows impulses, in SoftnessWide softness) =>
        correction + impulses * (softness.ImpulseScale / (softness.MassScale * softness.ErrorToVelocity));

    // Only what a joint is off by in the same direction as it closes is a gap: a load that is not borne yet opens it.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static Vector<float> IConstraint<TBodies, TPrestep, TRows>.GapSquared(
        in TBodies bodies, in Substep substep, in TPrestep prestep, in TRows impulses, out Vector<int> opens)
    {
        opens = Vector<int>.Zero;
        if (!ClosesGaps)
            return Vector<float>.Zero;
        TJoint.Prepare(bodies, prestep, out var geometry);
        TJoint.PositionError(bodies, prestep, geometry, out var error);
        if (TJoint.Kind == RowKind.Inequality)
            error = TRows.Min(error, default);
        TJoint.LeanRows(bodies, prestep, ref geometry);
        TJoint.InverseEffectiveMass(geometry, bodies, out var inverseMass);
        var slots = bodies;
        var softness = Softness(ref slots, substep, prestep);
        var correction = TMass.Solve(inverseMass, error);
        var beyond = Beyond(correction, impulses, softness);
        TJoint.RelativeVelocity(geometry, bodies, out var velocity);
        Vector<float> along = default, speed = default;
        for (int i = 0; i < RowCount; ++i)
        {
            along += Row(ref error, i) * Row(ref beyond, i);
            speed += Row(ref correction, i) * Row(ref velocity, i);
        }
        opens = Vector.GreaterThan(speed, Vector<float>.Zero);
        var waySquared = WaySquared(bodies, geometry, correction);
        var isGap = HasRigidSpring(prestep) & Vector.GreaterThan(along, Vector<float>.Zero) &
            JointGap.IsFar(waySquared) & JointGap.IsFar(WaySquared(bodies, geometry, beyond));
        return Wide.Mask(isGap, waySquared);
    }

    // Of the body that goes farthest by what impulses make of bodies at rest, in a second.
    static Vector<float> WaySquared(in TBodies bodies, in TGeometry geometry, in TRows impulses)
    {
        var still = bodies;
        for (int slot = 0; slot < TBodies.Count; ++slot)
            BodySlots.At(ref still, slot).Linear = BodySlots.At(ref still, slot).Angular = default;
        TJoint.ApplyImpulse(geometry, ref still, impulses);
        var waySquared = Vector<float>.Zero;
        for (int slot = 0; slot < TBodies.Count; ++slot)
            waySquared = Wide.Max(waySquared, JointGap.WaySquared(BodySlots.At(ref still, slot)));
        return waySquared;
    }
}
