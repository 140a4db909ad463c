using System.Numerics;
using BepuUtilities;

namespace BepuPhysics;

/// <summary>Where what moves freely will be: the way of a body at constant velocities, or of a sweep.</summary>
/// <remarks>The same bits on every CPU. Nothing is checked: what is not finite gives what is not finite.</remarks>
public static class PoseIntegration
{
    /// <summary>Where a point gets to at a constant velocity.</summary>
    /// <param name="position">Position at the start, m.</param>
    /// <param name="linearVelocity">Velocity, m/s.</param>
    /// <param name="dt">Time, s; negative for where it came from.</param>
    /// <param name="integratedPosition">Position after that time, m.</param>
    public static void Integrate(Vector3 position, Vector3 linearVelocity, float dt, out Vector3 integratedPosition) =>
        integratedPosition = position + linearVelocity * dt;

    /// <summary>How far something turns at a constant angular velocity.</summary>
    /// <param name="orientation">Orientation at the start; unit length.</param>
    /// <param name="angularVelocity">Angular velocity in the world, rad/s.</param>
    /// <param name="dt">Time, s; negative for where it came from.</param>
    /// <param name="integratedOrientation">Orientation after that time; unit length.</param>
    public static void Integrate(Quaternion orientation, Vector3 angularVelocity, float dt, out Quaternion integratedOrientation)
    {
        var turned = FreeRotation.Turn(QuaternionWide.Broadcast(orientation), Vector3Wide.Broadcast(angularVelocity), new Vector<float>(dt));
        integratedOrientation = new(turned.X.ToScalar(), turned.Y.ToScalar(), turned.Z.ToScalar(), turned.W.ToScalar());
    }

    /// <summary>Where a body gets to at constant velocities.</summary>
    /// <param name="pose">Pose at the start.</param>
    /// <param name="velocity">Velocity and angular velocity.</param>
    /// <param name="dt">Time, s; negative for where it came from.</param>
    /// <param name="integratedPose">Pose after that time; may be the variable that <paramref name="pose"/> refers to.</param>
    public static void Integrate(in RigidPose pose, in BodyVelocity velocity, float dt, out RigidPose integratedPose)
    {
        Integrate(pose.Position, velocity.Linear, dt, out var position);
        Integrate(pose.Orientation, velocity.Angular, dt, out var orientation);
        integratedPose = new(position, orientation);
    }
}
