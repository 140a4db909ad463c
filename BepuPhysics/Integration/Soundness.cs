using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics;

/// <summary>Which bodies of a bundle have numbers that can be simulated: neither NaN nor infinite nor so great that squares would be.</summary>
/// <remarks>
/// All of a body is one sum of squares, and one comparison finds all three: no comparison holds of NaN, and an infinity or a great number
/// is above the limit. The limit lies above what a game may describe (1e12 in each component), and far below overflow.
/// </remarks>
static class Soundness
{
    /// <summary>Lanes with a sound pose and velocity.</summary>
    /// <param name="pose">The poses.</param>
    /// <param name="velocity">The velocities.</param>
    /// <param name="tolerance">How far the squared length of an orientation may be off one.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static Vector<int> OfBodies(in RigidPoseWide pose, in BodyVelocityWide velocity, float tolerance = UnitTolerance.Sound)
    {
        var deviation = Vector.Abs(LengthSquared(pose.Orientation) - Vector<float>.One);
        var motion = pose.Position.LengthSquared() + velocity.Linear.LengthSquared() + velocity.Angular.LengthSquared();
        return Vector.LessThanOrEqual(deviation, new Vector<float>(tolerance)) &
            Vector.LessThanOrEqual(motion, new Vector<float>(Limits.GreatestSoundSquare));
    }

    /// <summary>Lanes with a sound velocity.</summary>
    // Enough for a body that was sound and has moved since: no position gets out of bounds in one substep, and an orientation that turned
    // into NaN took the angular velocity along.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static Vector<int> OfVelocities(in BodyVelocityWide velocity) =>
        Vector.LessThanOrEqual(velocity.Linear.LengthSquared() + velocity.Angular.LengthSquared(), new Vector<float>(Limits.GreatestSoundSquare));

    /// <summary>Lanes with an inverse inertia of numbers.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static Vector<int> OfInertias(in BodyInertiaWide inertia)
    {
        var i = inertia.InverseInertiaTensor;
        var sum = (i.XX + i.YX + i.YY) + (i.ZX + i.ZY + i.ZZ) + inertia.InverseMass;
        return Vector.LessThan(Vector.Abs(sum), new Vector<float>(float.PositiveInfinity));
    }

    /// <summary>Whether any lane of a body that exists is not sound.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static bool IsNot(Vector<int> sound, Vector<int> exists, out Vector<int> unsound)
    {
        unsound = Vector.AndNot(exists, sound);
        return unsound != Vector<int>.Zero;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<float> LengthSquared(in QuaternionWide q) => q.X * q.X + q.Y * q.Y + q.Z * q.Z + q.W * q.W;

    /// <summary>Whether one pose is sound.</summary>
    internal static bool IsSound(in RigidPose pose) => Exact.LengthSquared(pose.Position) <= Limits.GreatestSoundSquare &&
        UnitTolerance.Holds(Exact.Dot(pose.Orientation, pose.Orientation), UnitTolerance.Sound);

    /// <summary>Whether one velocity is sound.</summary>
    internal static bool IsSound(in BodyVelocity velocity) =>
        Exact.LengthSquared(velocity.Linear) + Exact.LengthSquared(velocity.Angular) <= Limits.GreatestSoundSquare;

    /// <summary>Whether one inertia consists of numbers.</summary>
    internal static bool IsSound(in BodyInertia inertia)
    {
        ref readonly var i = ref inertia.InverseInertiaTensor;
        return float.IsFinite(i.XX) && float.IsFinite(i.YX) && float.IsFinite(i.YY) && float.IsFinite(i.ZX) && float.IsFinite(i.ZY) &&
            float.IsFinite(i.ZZ) && float.IsFinite(inertia.InverseMass);
    }
}
