using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>The face of a hull whose normal is nearest to the direction; of equally near ones the first.</summary>
/// <remarks>Of a face with more than 64 vertices 64 are used, evenly spread: the first and every so many that follow.</remarks>
public readonly unsafe struct ConvexHullFeature : IContactFeature<ConvexHullWide>
{
    /// <inheritdoc/>
    public static int MaximumVertexCount => 64;

    /// <inheritdoc/>
    // Every lane is a loop over a hull of its own.
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static void Find(in ConvexHullWide shape, in Vector3Wide direction, Vector<int> done, ref Vector3Wide vertices,
        out ContactFeatureWide feature)
    {
        feature = default;
        var faces = stackalloc int[Vector<float>.Count];
        var greatestCount = 0;
        for (int lane = 0; lane < Vector<float>.Count; ++lane)
        {
            var hull = shape.Hull(lane);
            if (hull == null || GatherScatter.Get(ref done, lane) != 0)
                continue;
            var face = FindFace(hull, Wide.Broadcast(direction.X, lane), Wide.Broadcast(direction.Y, lane), Wide.Broadcast(direction.Z, lane));
            faces[lane] = face;
            var count = hull->FaceStarts[face + 1] - hull->FaceStarts[face];
            count = count > MaximumVertexCount ? MaximumVertexCount : count;
            greatestCount = count > greatestCount ? count : greatestCount;
            hull->GetPlane(face, out var normal, out _);
            Lanes.Write(normal, ref feature.PlaneNormal, lane);
            GatherScatter.Get(ref feature.VertexCount, lane) = count;
            GatherScatter.Get(ref feature.Id, lane) = face;
            GatherScatter.Get(ref feature.Size, lane) = hull->OuterRadius;
        }
        for (int lane = 0; lane < Vector<float>.Count; ++lane)
        {
            var hull = shape.Hull(lane);
            if (hull != null && GatherScatter.Get(ref done, lane) == 0)
                WriteVertices(hull, faces[lane], greatestCount, ref vertices, lane);
        }
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static int FindFace(HullHeader* hull, Vector<float> x, Vector<float> y, Vector<float> z)
    {
        var greatest = new Vector<float>(-float.MaxValue);
        var nearest = Vector<int>.Zero;
        var number = Vector<int>.Indices;
        for (int i = 0; i < hull->FaceBundleCount; ++i)
        {
            ref var normal = ref hull->Planes[i].Normal;
            var along = normal.X * x + normal.Y * y + normal.Z * z;
            var nearer = Vector.GreaterThan(along, greatest);
            greatest = Wide.Select(nearer, along, greatest);
            nearest = Wide.Select(nearer, number, nearest);
            number += new Vector<int>(Vector<float>.Count);
        }
        return GatherScatter.Get(ref nearest, Wide.LaneOfGreatest(greatest, nearest));
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void WriteVertices(HullHeader* hull, int face, int greatestCount, ref Vector3Wide vertices, int lane)
    {
        var start = hull->FaceStarts[face];
        var all = hull->FaceStarts[face + 1] - start;
        var count = all > MaximumVertexCount ? MaximumVertexCount : all;
        for (int i = 0; i < greatestCount; ++i)
        {
            // Beyond the last comes the first again.
            var index = i >= count ? 0 : all == count ? i : i * all / count;
            var place = hull->FaceVertices[start + index];
            Lanes.Copy(ref hull->Points[place.BundleIndex], place.InnerIndex, ref Unsafe.Add(ref vertices, i), lane);
        }
    }
}
