using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>Poses of a bundle of pairs, relative to A's centre, in world axes.</summary>
public struct PairPoseWide
{
    /// <summary>Position of B less that of A, m.</summary>
    public Vector3Wide OffsetB;
    /// <summary>Rotation from A's frame to the world; unit length.</summary>
    public QuaternionWide OrientationA;
    /// <summary>Rotation from B's frame to the world; unit length.</summary>
    public QuaternionWide OrientationB;
}
