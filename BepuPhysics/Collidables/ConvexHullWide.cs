using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Collidables;

/// <summary>A bundle of convex hulls.</summary>
/// <remarks>
/// Each lane has a loop over a hull of its own, which is vectorised over that hull's vertices or faces. A lane that holds zeros is empty
/// and is skipped; what remains of a lane may not be anything else than a hull.
/// </remarks>
public unsafe struct ConvexHullWide : IShapeWide<ConvexHull>
{
    /// <summary>Low half of the address of the hull's memory.</summary>
    public Vector<int> MemoryLow;
    /// <summary>High half of the address of the hull's memory.</summary>
    public Vector<int> MemoryHigh;
    /// <summary>Size of the hull's memory, bytes.</summary>
    public Vector<int> ByteCount;
    /// <summary>Id of the hull's memory in its pool.</summary>
    public Vector<int> BlockId;

    /// <summary>The hull of a lane; null for an empty one.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal readonly HullHeader* Hull(int lane) => (HullHeader*)((uint)MemoryLow[lane] | (ulong)(uint)MemoryHigh[lane] << 32);

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public readonly void GetBounds(in QuaternionWide orientation,
        out Vector<float> maximumRadius, out Vector<float> maximumAngularExpansion, out Vector3Wide min, out Vector3Wide max)
    {
        maximumRadius = maximumAngularExpansion = default;
        min = max = default;
        var axes = Matrix3x3Wide.FromQuaternion(orientation);
        for (int lane = 0; lane < Vector<float>.Count; ++lane)
        {
            var hull = Hull(lane);
            if (hull == null)
                continue;
            GatherScatter.Get(ref maximumRadius, lane) = hull->OuterRadius;
            GatherScatter.Get(ref maximumAngularExpansion, lane) = hull->OuterRadius - hull->InnerRadius;
            // World coordinates are inner products with the columns of the matrix whose rows are the hull's axes.
            GetInterval(hull, axes.X.X[lane], axes.Y.X[lane], axes.Z.X[lane], ref min.X, ref max.X, lane);
            GetInterval(hull, axes.X.Y[lane], axes.Y.Y[lane], axes.Z.Y[lane], ref min.Y, ref max.Y, lane);
            GetInterval(hull, axes.X.Z[lane], axes.Y.Z[lane], axes.Z.Z[lane], ref min.Z, ref max.Z, lane);
        }
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public readonly void RayTest(
        in RigidPoseWide pose, in RayWide ray, out Vector<int> hitMask, out Vector<float> t, out Vector3Wide normal)
    {
        var axes = Matrix3x3Wide.FromQuaternion(pose.Orientation);
        var line = new CenteredRayWide(ray, pose.Position);
        line.ToLocal(axes);
        var entry = new Vector<float>(float.MaxValue);
        var exit = new Vector<float>(float.MinValue);
        Vector<int> face = default;
        for (int lane = 0; lane < Vector<float>.Count; ++lane)
        {
            var hull = Hull(lane);
            if (hull != null)
                Clip(hull, Broadcast(line.Closest, lane), Broadcast(line.Direction, lane), lane, ref entry, ref exit, ref face);
        }
        line.Resolve(entry, exit, out hitMask, out var distance, out t);
        var startsInside = Vector.LessThan(entry, line.Start) & hitMask;
        var point = line.At(distance);
        Vector3Wide localNormal = default;
        for (int lane = 0; lane < Vector<float>.Count; ++lane)
        {
            if (hitMask[lane] == 0)
                continue;
            var hull = Hull(lane);
            hull->GetPlane(startsInside[lane] != 0 ? FindNearestFace(hull, Broadcast(point, lane)) : face[lane], out var outward, out _);
            Lanes.Write(outward, ref localNormal, lane);
        }
        normal = Vector3Wide.Mask(hitMask, Matrix3x3Wide.TransposeTimes(axes, localNormal));
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector3Wide Broadcast(in Vector3Wide v, int lane) =>
        new(new Vector<float>(v.X[lane]), new Vector<float>(v.Y[lane]), new Vector<float>(v.Z[lane]));

    /// <summary>Least and greatest inner product of a direction with the vertices.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void GetInterval(HullHeader* hull, float x, float y, float z, ref Vector<float> min, ref Vector<float> max, int lane)
    {
        var direction = new Vector3Wide(new Vector<float>(x), new Vector<float>(y), new Vector<float>(z));
        var points = hull->Points;
        var least = Vector3Wide.Dot(points[0], direction);
        var greatest = least;
        for (int i = 1; i < hull->VertexBundleCount; ++i)
        {
            var along = Vector3Wide.Dot(points[i], direction);
            least = Wide.Min(along, least);
            greatest = Wide.Max(along, greatest);
        }
        // Of zeros of both signs, which one is found depends on the order: adding zero leaves the positive one.
        GatherScatter.Get(ref min, lane) = 0f - Wide.SpreadGreatest(-least)[0];
        GatherScatter.Get(ref max, lane) = Wide.SpreadGreatest(greatest)[0] + 0f;
    }

    /// <summary>Part of a line that is inside all planes, and the face by which it enters.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void Clip(HullHeader* hull, in Vector3Wide position, in Vector3Wide direction, int lane,
        ref Vector<float> entry, ref Vector<float> exit, ref Vector<int> face)
    {
        var everything = new Vector<float>(float.MaxValue);
        var lastEntry = -everything;
        var firstExit = everything;
        Vector<int> lastFace = default;
        var planes = hull->Planes;
        var number = Vector<int>.Indices;
        for (int i = 0; i < hull->FaceBundleCount; ++i)
        {
            ref var plane = ref planes[i];
            var speed = Vector3Wide.Dot(plane.Normal, direction);
            var distance = plane.Offset - Vector3Wide.Dot(plane.Normal, position);
            // Of a parallel line everything is inside, or nothing.
            var parallel = Vector.LessThan(Vector.Abs(speed), new Vector<float>(CenteredRayWide.ParallelSpeed));
            var outside = Wide.Select(Vector.GreaterThanOrEqual(distance, Vector<float>.Zero), -everything, everything);
            var crossing = distance / speed;
            var enters = Wide.Select(parallel, outside, Wide.Select(Vector.LessThan(speed, Vector<float>.Zero), crossing, -everything));
            // NaN, of a direction that is none, is neither entry nor exit here, and nothing in Resolve.
            var exits = Wide.Select(parallel | Vector.LessThan(speed, Vector<float>.Zero), everything, crossing);
            var later = Vector.GreaterThan(enters, lastEntry);
            lastFace = Wide.Select(later, number, lastFace);
            lastEntry = Wide.Select(later, enters, lastEntry);
            firstExit = Wide.Min(exits, firstExit);
            number += new Vector<int>(Vector<float>.Count);
        }
        var best = PickGreatest(lastEntry, lastFace);
        var end = firstExit[0];
        for (int i = 1; i < Vector<float>.Count; ++i)
            end = firstExit[i] < end ? firstExit[i] : end;
        GatherScatter.Get(ref entry, lane) = lastEntry[best];
        GatherScatter.Get(ref exit, lane) = end;
        GatherScatter.Get(ref face, lane) = lastFace[best];
    }

    /// <summary>The face whose plane a point is least deep under.</summary>
    [MethodImpl(MethodImplOptions.NoInlining)]
    static int FindNearestFace(HullHeader* hull, in Vector3Wide point)
    {
        var nearest = new Vector<float>(float.MinValue);
        Vector<int> nearestFace = default;
        var planes = hull->Planes;
        var number = Vector<int>.Indices;
        for (int i = 0; i < hull->FaceBundleCount; ++i)
        {
            ref var plane = ref planes[i];
            var height = Vector3Wide.Dot(plane.Normal, point) - plane.Offset;
            var nearer = Vector.GreaterThan(height, nearest);
            nearestFace = Wide.Select(nearer, number, nearestFace);
            nearest = Wide.Select(nearer, height, nearest);
            number += new Vector<int>(Vector<float>.Count);
        }
        return nearestFace[PickGreatest(nearest, nearestFace)];
    }

    /// <summary>The lane with the greatest value; of equal ones the one with the lowest number, so that the width does not matter.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static int PickGreatest(Vector<float> values, Vector<int> numbers)
    {
        var best = 0;
        for (int i = 1; i < Vector<float>.Count; ++i)
        {
            if (values[i] > values[best] || (values[i] == values[best] && numbers[i] < numbers[best]))
                best = i;
        }
        return best;
    }
}
