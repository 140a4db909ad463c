using System.Numerics;
using System.Runtime.InteropServices;
using BepuUtilities;

namespace BepuPhysics;

/// <summary>Position and orientation of a rigid body.</summary>
/// <remarks>32 bytes, so that a bundle of bodies is read by one transpose of eight floats each. Orientations are not normalised here.</remarks>
[StructLayout(LayoutKind.Sequential, Size = 32)]
public struct RigidPose(Vector3 position, Quaternion orientation)
{
    /// <summary>Rotation from the body's frame to the world; unit length.</summary>
    public Quaternion Orientation = orientation;
    /// <summary>Position of the centre of mass in the world, m.</summary>
    public Vector3 Position = position;

    /// <summary>At the origin, not rotated.</summary>
    public static RigidPose Identity => new(default, Quaternion.Identity);

    /// <summary>Pose without rotation.</summary>
    public RigidPose(Vector3 position) : this(position, Quaternion.Identity) { }

    /// <summary>Pose without rotation.</summary>
    public static implicit operator RigidPose(Vector3 position) => new(position);
    /// <summary>Pose at the origin.</summary>
    public static implicit operator RigidPose(Quaternion orientation) => new(default, orientation);
    /// <summary>Position and orientation.</summary>
    public static implicit operator RigidPose((Vector3 position, Quaternion orientation) pose) => new(pose.position, pose.orientation);

    /// <summary>Takes a point from the frame of the pose to the world.</summary>
    public static void Transform(Vector3 v, in RigidPose pose, out Vector3 result) =>
        result = Exact.Rotate(v, pose.Orientation) + pose.Position;

    /// <summary>Takes a point from the world to the frame of the pose.</summary>
    public static void TransformByInverse(Vector3 v, in RigidPose pose, out Vector3 result) =>
        result = Exact.Rotate(v - pose.Position, Quaternion.Conjugate(pose.Orientation));

    /// <summary>Pose that undoes another one.</summary>
    public static void Invert(in RigidPose pose, out RigidPose inverse)
    {
        var orientation = Quaternion.Conjugate(pose.Orientation);
        inverse = new(Exact.Rotate(-pose.Position, orientation), orientation);
    }

    /// <summary>Pose that first applies <paramref name="a"/>, then <paramref name="b"/>.</summary>
    public static void MultiplyWithoutOverlap(in RigidPose a, in RigidPose b, out RigidPose result) =>
        result = new(Exact.Rotate(a.Position, b.Orientation) + b.Position, Exact.Concatenate(a.Orientation, b.Orientation));
}
