using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Collidables;

/// <summary>Scalar queries of convex shapes, answered by the first lane of the wide form.</summary>
/// <remarks>
/// So that geometry is written once and a single query agrees with a bundle bit for bit. A vector instruction takes the time of its
/// scalar twin; what it costs is the broadcast of the inputs, one instruction each.
/// </remarks>
static class OneLane
{
    public static void ComputeBounds<TShape, TShapeWide>(in TShape shape, in Quaternion orientation, out Vector3 min, out Vector3 max)
        where TShape : unmanaged, IConvexShape where TShapeWide : unmanaged, IShapeWide<TShape>
    {
        var shapes = Lanes.Broadcast<TShape, TShapeWide>(shape);
        ComputeFirstBounds<TShape, TShapeWide>(ref shapes, orientation, out min, out max);
    }

    public static bool RayTest<TShape, TShapeWide>(
        in TShape shape, in RigidPose pose, in Vector3 origin, in Vector3 direction, out float t, out Vector3 normal)
        where TShape : unmanaged, IConvexShape where TShapeWide : unmanaged, IShapeWide<TShape>
    {
        var shapes = Lanes.Broadcast<TShape, TShapeWide>(shape);
        return RayTestFirst<TShape, TShapeWide>(ref shapes, pose, origin, direction, out t, out normal);
    }

    /// <summary>Bounds of the first shape of a bundle.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void ComputeFirstBounds<TShape, TShapeWide>(ref TShapeWide shapes, in Quaternion orientation, out Vector3 min, out Vector3 max)
        where TShape : unmanaged, IConvexShape where TShapeWide : unmanaged, IShapeWide<TShape>
    {
        shapes.GetBounds(Lanes.Broadcast<Quaternion, QuaternionWide>(orientation), out _, out _, out var mins, out var maxes);
        min = First(mins);
        max = First(maxes);
    }

    /// <summary>A ray against the first shape of a bundle.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static bool RayTestFirst<TShape, TShapeWide>(
        ref TShapeWide shapes, in RigidPose pose, in Vector3 origin, in Vector3 direction, out float t, out Vector3 normal)
        where TShape : unmanaged, IConvexShape where TShapeWide : unmanaged, IShapeWide<TShape>
    {
        var poses = new RigidPoseWide
        {
            Position = Lanes.Broadcast<Vector3, Vector3Wide>(pose.Position),
            Orientation = Lanes.Broadcast<Quaternion, QuaternionWide>(pose.Orientation),
        };
        var rays = new RayWide
        {
            Origin = Lanes.Broadcast<Vector3, Vector3Wide>(origin),
            Direction = Lanes.Broadcast<Vector3, Vector3Wide>(direction),
        };
        shapes.RayTest(poses, rays, out var hitMask, out var ts, out var normals);
        t = ts[0];
        normal = First(normals);
        return hitMask[0] != 0;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector3 First(in Vector3Wide v) => new(v.X[0], v.Y[0], v.Z[0]);
}
