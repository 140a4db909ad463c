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
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static void Find(in ConvexHullWide shape, in Vector3Wide direction, Vector<int> done, ref Vector3Wide vertices,
        out ContactFeatureWide feature) => Find(shape, direction, done, ref vertices, out feature, standsOnEdges: false);

    // Every lane is a loop over a hull of its own.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static void Find(in ConvexHullWide shape, in Vector3Wide direction, Vector<int> done, ref Vector3Wide vertices,
        out ContactFeatureWide feature, bool standsOnEdges)
    {
        feature = default;
        var faces = stackalloc int[Vector<float>.Count];
        var greatestCount = 0;
        for (int lane = 0; lane < Vector<float>.Count; ++lane)
        {
            var hull = shape.Hull(lane);
            if (hull == null || GatherScatter.Get(ref done, lane) != 0)
                continue;
            var face = FindFace(hull, Wide.Broadcast(direction.X, lane), Wide.Broadcast(direction.Y, lane), Wide.Broadcast(direction.Z, lane),
                standsOnEdges);
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
    static int FindFace(HullHeader* hull, Vector<float> x, Vector<float> y, Vector<float> z, bool standsOnEdges)
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
        var lane = Wide.LaneOfGreatest(greatest, nearest);
        var face = GatherScatter.Get(ref nearest, lane);
        return !standsOnEdges || GatherScatter.Get(ref greatest, lane) > LyingCosine ? face : FindFaceOnEdge(hull, face, x, y, z);
    }

    // Cosine of the angle, .014 rad, up to which a hull lies on its face.
    const float LyingCosine = 0.9999f;
    // Greatest slope of an edge on which a hull stands: what is steeper has its other end far away.
    const float StandingSlope = 0.1f;

    // What stands on an edge touches with both of its ends. A face at one of them alone may be nearer to the direction than those beside the edge: shown that
    // one, the other end is a contact as long as it is the deepest, and none as soon as it is not. So what leans on others, on an edge, was thrown up by it,
    // fell back on nothing, and rocked for ever. The two foremost vertices are those of an edge, as from the second one the first alone is uphill.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static int FindFaceOnEdge(HullHeader* hull, int face, Vector<float> x, Vector<float> y, Vector<float> z)
    {
        var (first, second) = FindForemost(hull, x, y, z);
        var edge = hull->GetPoint(second) - hull->GetPoint(first);
        if (!IsLevel(edge, edge.X * x[0] + edge.Y * y[0] + edge.Z * z[0]) || Holds(hull, face, first, second))
            return face;
        var greatest = float.MinValue;
        for (int i = 0; i < hull->FaceCount; ++i)
        {
            if (!Holds(hull, i, first, second))
                continue;
            hull->GetPlane(i, out var normal, out _);
            var along = normal.X * x[0] + normal.Y * y[0] + normal.Z * z[0];
            if (along > greatest)
                (greatest, face) = (along, i);
        }
        return face;
    }

    static bool IsLevel(Vector3 edge, float drop) => drop * drop < Exact.LengthSquared(edge) * (StandingSlope * StandingSlope);

    // The numbers of the two vertices that are farthest along the direction; of equally far ones the first.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static (int First, int Second) FindForemost(HullHeader* hull, Vector<float> x, Vector<float> y, Vector<float> z)
    {
        var greatest = new Vector<float>(float.MinValue);
        var next = greatest;
        var foremost = Vector<int>.Zero;
        var second = foremost;
        var number = Vector<int>.Indices;
        // Copies that fill up the last bundle are those of vertex 0.
        var count = new Vector<int>(hull->VertexCount);
        for (int i = 0; i < hull->VertexBundleCount; ++i)
        {
            ref var point = ref hull->Points[i];
            var along = Wide.Select(Vector.LessThan(number, count), point.X * x + point.Y * y + point.Z * z, new Vector<float>(float.MinValue));
            var farther = Vector.GreaterThan(along, greatest);
            var farFromSecond = Vector.GreaterThan(along, next);
            next = Wide.Select(farther, greatest, Wide.Select(farFromSecond, along, next));
            second = Wide.Select(farther, foremost, Wide.Select(farFromSecond, number, second));
            greatest = Wide.Select(farther, along, greatest);
            foremost = Wide.Select(farther, number, foremost);
            number += new Vector<int>(Vector<float>.Count);
        }
        var lane = Wide.LaneOfGreatest(greatest, foremost);
        var first = GatherScatter.Get(ref foremost, lane);
        // The second one of all is the second of its lane or the first of another.
        GatherScatter.Get(ref greatest, lane) = GatherScatter.Get(ref next, lane);
        GatherScatter.Get(ref foremost, lane) = GatherScatter.Get(ref second, lane);
        return (first, GatherScatter.Get(ref foremost, Wide.LaneOfGreatest(greatest, foremost)));
    }

    static bool Holds(HullHeader* hull, int face, int first, int second)
    {
        var held = 0;
        for (int i = hull->FaceStarts[face]; i < hull->FaceStarts[face + 1]; ++i)
        {
            var number = hull->FaceVertices[i].Number;
            held += number == first || number == second ? 1 : 0;
        }
        return held == 2;
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
