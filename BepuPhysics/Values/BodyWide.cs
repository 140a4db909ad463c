using System.Numerics;
using BepuUtilities;

namespace BepuPhysics;

/// <summary>A bundle of poses.</summary>
public struct RigidPoseWide
{
    /// <inheritdoc cref="RigidPose.Position"/>
    public Vector3Wide Position;
    /// <inheritdoc cref="RigidPose.Orientation"/>
    public QuaternionWide Orientation;

    /// <summary>The same pose in all lanes.</summary>
    public static void Broadcast(in RigidPose pose, out RigidPoseWide poses)
    {
        poses.Position = Vector3Wide.Broadcast(pose.Position);
        poses.Orientation = QuaternionWide.Broadcast(pose.Orientation);
    }
}

/// <summary>A bundle of velocities.</summary>
public struct BodyVelocityWide
{
    /// <inheritdoc cref="BodyVelocity.Linear"/>
    public Vector3Wide Linear;
    /// <inheritdoc cref="BodyVelocity.Angular"/>
    public Vector3Wide Angular;
}

/// <summary>A bundle of inertias.</summary>
public struct BodyInertiaWide
{
    /// <inheritdoc cref="BodyInertia.InverseInertiaTensor"/>
    public Symmetric3x3Wide InverseInertiaTensor;
    /// <inheritdoc cref="BodyInertia.InverseMass"/>
    public Vector<float> InverseMass;
}
