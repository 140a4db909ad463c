using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>How far a joint that holds points together may turn its bodies by correcting its error.</summary>
// A joint that is off by C holds the energy of a spring, w^2 C K^-1 C / 2, with K for the poses of this substep. Correcting C turns the bodies on their
// arms, and K turns with them. As long as that is a small angle, the correction takes out the energy that was there. A light body under a heavy
// load, on arms of many times its radius of gyration, would be turned by a large part of a radian in one substep: K is then another one when it has
// arrived, C holds more energy than before, and so on, as long as the load hangs there.
//
// So a rigid joint that would turn a body far is damped until it turns it by a small angle. It keeps its stiffness, and with it the C at which it
// rests. Pulling a body along its arm turns nothing: chains and nets that are stretched are seldom concerned.
//
// Which joints that are is asked once per step, of the impulses l that their points bear, where the warm start of the first substep has them at hand: a
// joint at rest bears l = -(w h)^2 / h K^-1 C and corrects w h / (w h + 2) of C in a substep, so that the correction turns a body by
// h |I^-1 (r x l)| / (w h (w h + 2)). Rows between two points or along a line may be far off while they bear next to nothing: what they pull at swings
// past them. Of those it is C that is asked. The sweeps know it by a flag in the joint's first reference and work out the angle that C itself has.
static class JointTurn
{
    // Radians in a substep. Trees of joints gain energy with more of either; with less of the first, whips of chains that substeps resolve are concerned.
    const float Far = 0.03f;
    const float Near = 0.005f;

    /// <summary>Change of angular velocity, by the impulse of a joint at rest, from which on its correction turns a body far.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static float Limit(in Substep substep, in SubstepStiffness limits)
    {
        var frequencyDt = limits.RigidFrequencyDt;
        return Far * frequencyDt * (frequencyDt + 2) * substep.InverseDt;
    }

    /// <summary>Lanes in which the impulse of a joint at rest would be that of a correction that turns a body far.</summary>
    /// <param name="impulse">Impulse at the points, world axes; its sign does not matter.</param>
    /// <param name="armA">Arm of A's point, world axes.</param>
    /// <param name="inverseInertiaA">Inverse inertia of A, world axes.</param>
    /// <param name="armB">Arm of B's point.</param>
    /// <param name="inverseInertiaB">Inverse inertia of B.</param>
    /// <param name="limit">The <see cref="Limit"/> of the joint.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static Vector<int> IsFar(
        in Vector3Wide impulse, in Vector3Wide armA, in Symmetric3x3Wide inverseInertiaA, in Vector3Wide armB, in Symmetric3x3Wide inverseInertiaB,
        float limit)
    {
        var angularA = inverseInertiaA * Vector3Wide.Cross(armA, impulse);
        var angularB = inverseInertiaB * Vector3Wide.Cross(armB, impulse);
        return Vector.GreaterThan(Wide.Max(angularA.LengthSquared(), angularB.LengthSquared()), new Vector<float>(limit * limit));
    }

    /// <summary>Lanes in which a correction turns a body far.</summary>
    /// <param name="turnSquared">Square of the angle, rad, by which correcting all of the error would turn a body.</param>
    /// <param name="limits">Stiffness of the joints.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static Vector<int> IsFar(Vector<float> turnSquared, in SubstepStiffness limits)
    {
        // A substep corrects w h / (w h + 2) of it.
        var limit = Far * (limits.RigidFrequencyDt + 2) / limits.RigidFrequencyDt;
        return Vector.GreaterThan(turnSquared, new Vector<float>(limit * limit));
    }

    /// <summary>Part of a correction that would turn a body by more than a small angle which turns it by no more; one of others.</summary>
    /// <param name="turnSquared">Square of the angle, rad, by which correcting all of the error would turn a body.</param>
    /// <param name="dt">Length of the substep, s.</param>
    /// <param name="lanes">Lanes that are concerned.</param>
    /// <param name="softness">That of the joint.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static Vector<float> PartOf(Vector<float> turnSquared, float dt, Vector<int> lanes, in SoftnessWide softness)
    {
        var angle = Vector.SquareRoot(turnSquared) * softness.ErrorToVelocity * new Vector<float>(dt);
        var near = new Vector<float>(Near);
        return Wide.Select(lanes & Vector.GreaterThan(angle, near), near / angle, Vector<float>.One);
    }

    /// <summary>Damps a correction, so that it is a part of itself, and keeps its stiffness.</summary>
    /// <param name="part">The part; lanes in which it is one stay as they are.</param>
    /// <param name="softness">What is damped.</param>
    // More damping c at the same stiffness k: ErrorToVelocity = k / (h k + c) becomes a part of itself, and h (h k + c) grows by as much.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static void Damp(Vector<float> part, ref SoftnessWide softness)
    {
        var lanes = Vector.LessThan(part, Vector<float>.One);
        var massScale = softness.MassScale / (softness.MassScale + part * softness.ImpulseScale);
        softness.ErrorToVelocity *= part;
        softness.MassScale = Wide.Select(lanes, massScale, softness.MassScale);
        softness.ImpulseScale = Wide.Select(lanes, Vector<float>.One - massScale, softness.ImpulseScale);
    }
}
