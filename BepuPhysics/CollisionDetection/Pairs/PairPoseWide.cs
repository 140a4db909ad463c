using System.Runtime.CompilerServices;
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

    /// <summary>The poses in A's frame.</summary>
    /// <param name="axesA">Axes of A in the world, in the rows.</param>
    /// <param name="axesB">Axes of B in A's frame, in the rows.</param>
    /// <param name="offsetB">Position of B in A's frame.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal readonly void GetLocal(out Matrix3x3Wide axesA, out Matrix3x3Wide axesB, out Vector3Wide offsetB)
    {
        var axes = Matrix3x3Wide.FromQuaternion(OrientationA);
        var worldAxesB = Matrix3x3Wide.FromQuaternion(OrientationB);
        axesB = new(axes * worldAxesB.X, axes * worldAxesB.Y, axes * worldAxesB.Z);
        offsetB = axes * OffsetB;
        axesA = axes;
    }
}
