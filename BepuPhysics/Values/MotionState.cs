using System.Runtime.InteropServices;

namespace BepuPhysics;

/// <summary>Where a body is and how it moves: one cache line.</summary>
[StructLayout(LayoutKind.Sequential, Size = 64)]
public struct MotionState
{
    /// <summary>Position and orientation.</summary>
    public RigidPose Pose;
    /// <summary>Linear and angular velocity.</summary>
    public BodyVelocity Velocity;
}
