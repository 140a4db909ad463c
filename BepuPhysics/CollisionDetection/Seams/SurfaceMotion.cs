using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>How something that a body touches moves: as it would at the centre of the body, if it reached to there.</summary>
/// <param name="motion">Where the thing is, and its velocity.</param>
/// <param name="place">Centre of the body.</param>
readonly struct SurfaceMotion(in MotionState motion, in Vector3 place)
{
    // Part of a velocity that may be rounding, of what computes velocities and of what moves bodies by them.
    const float Rounding = 1e-4f;

    readonly Vector3 linear = motion.Velocity.Linear + Exact.Cross(motion.Velocity.Angular, place - motion.Pose.Position);
    readonly Vector3 angular = motion.Velocity.Angular;
    readonly Vector3 center = motion.Pose.Position;

    /// <summary>Whether it turns.</summary>
    public bool IsTurning => angular != default;

    /// <summary>Whether two things move as one rigid body does.</summary>
    /// <remarks>
    /// The tiles of a turntable have velocities of their own, which fit each other, whether a game finds them from the axis or from where each tile is to be
    /// after the step. These differ by what a turn within the step is beside a straight way.
    /// </remarks>
    /// <param name="other">The other thing.</param>
    /// <param name="dt">Length of the step, s.</param>
    public bool IsThatOf(in SurfaceMotion other, float dt)
    {
        if (!IsTurning || !other.IsTurning)
            return angular == other.angular && linear == other.linear;
        var square = Exact.LengthSquared(angular);
        var share = MathHelper.Max(Rounding, dt * Exact.Length(angular));
        return Exact.DistanceSquared(angular, other.angular) <= Rounding * Rounding * square &&
            Exact.DistanceSquared(linear, other.linear) <= share * share * square * Exact.DistanceSquared(center, other.center);
    }
}
