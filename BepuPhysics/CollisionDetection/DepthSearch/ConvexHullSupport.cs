using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>A convex hull is its own core. Of equally far vertices it shows the first.</summary>
// Each lane has a hull of its own, so it is the vertices of one hull that are compared at once. All of them: hulls are small, and climbing
// from neighbour to neighbour would wait for memory at each step.
public readonly unsafe struct ConvexHullSupport : ISupport<ConvexHullWide>
{
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector<float> Margin(in ConvexHullWide shape) => Vector<float>.Zero;

    /// <inheritdoc/>
    public static void GetExtents(in ConvexHullWide shape, out Vector3Wide center, out Vector<float> inner, out Vector<float> outer)
    {
        center = Vector3Wide.Zero;
        inner = outer = Vector<float>.Zero;
        for (int lane = 0; lane < Vector<float>.Count; ++lane)
        {
            var hull = shape.Hull(lane);
            if (hull == null)
                continue;
            GatherScatter.Get(ref inner, lane) = hull->InnerRadius;
            GatherScatter.Get(ref outer, lane) = hull->OuterRadius;
        }
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static Vector3Wide Support(in ConvexHullWide shape, in Vector3Wide direction, Vector<int> doneMask)
    {
        var result = Vector3Wide.Zero;
        for (int lane = 0; lane < Vector<float>.Count; ++lane)
        {
            if (GatherScatter.Get(ref doneMask, lane) != 0)
                continue;
            var hull = shape.Hull(lane);
            if (hull == null)
                continue;
            var vertex = FindFarthest(hull, Wide.Broadcast(direction.X, lane), Wide.Broadcast(direction.Y, lane), Wide.Broadcast(direction.Z, lane));
            GatherScatter.Get(ref result.X, lane) = vertex[0];
            GatherScatter.Get(ref result.Y, lane) = vertex[Vector<float>.Count];
            GatherScatter.Get(ref result.Z, lane) = vertex[2 * Vector<float>.Count];
        }
        return result;
    }

    /// <summary>Address of the X of the farthest vertex.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static float* FindFarthest(HullHeader* hull, Vector<float> x, Vector<float> y, Vector<float> z)
    {
        var points = hull->Points;
        var farthest = points->X * x + points->Y * y + points->Z * z;
        var farthestBundle = Vector<int>.Zero;
        var bundle = Vector<int>.Zero;
        for (int i = 1; i < hull->VertexBundleCount; ++i)
        {
            bundle += Vector<int>.One;
            var point = points + i;
            var along = point->X * x + point->Y * y + point->Z * z;
            var farther = Vector.GreaterThan(along, farthest);
            farthest = Wide.Select(farther, along, farthest);
            farthestBundle = Wide.Select(farther, bundle, farthestBundle);
        }
        var lane = Wide.LaneOfGreatest(farthest, farthestBundle);
        return (float*)(points + GatherScatter.Get(ref farthestBundle, lane)) + lane;
    }
}
