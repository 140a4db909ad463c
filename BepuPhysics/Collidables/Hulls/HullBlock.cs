using System;
using System.Numerics;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>Fills the memory of a hull.</summary>
static unsafe class HullBlock
{
    /// <summary>Products of vertices and faces up to which every vertex is held against every plane: some ten milliseconds.</summary>
    const long AffordableCount = 8_000_000;

    /// <summary>Takes memory and writes the counts; all else is to be written.</summary>
    public static HullHeader* Allocate(int vertexCount, int faceCount, int faceVertexCount, BufferPool pool, out ConvexHull hull)
    {
        var counts = new HullHeader
        {
            VertexCount = vertexCount,
            VertexBundleCount = BundleIndexing.GetBundleCount(vertexCount),
            FaceCount = faceCount,
            FaceBundleCount = BundleIndexing.GetBundleCount(faceCount),
            FaceVertexCount = faceVertexCount,
        };
        pool.Take<byte>((int)counts.TotalByteCount, out var data);
        // What is between and behind the arrays is zero too, so that equal hulls are equal bytes.
        data.AsSpan().Clear();
        hull = default;
        hull.Data = data;
        *hull.Header = counts;
        return hull.Header;
    }

    /// <summary>Writes a vertex.</summary>
    public static void SetPoint(HullHeader* hull, int vertex, in Vector3 point)
    {
        BundleIndexing.GetBundleIndices(vertex, out var bundle, out var lane);
        Lanes.Write(point, ref hull->Points[bundle], lane);
    }

    /// <summary>Writes the plane of a face: of a normal, through the farthest vertex of the face, or of the hull if that is affordable.</summary>
    // The normal of a single triangle has the whole hull on one side. The mean of several may not: that of a narrow face, joined of slivers
    // within the tolerance, may be tilted enough to cut off something at the far end.
    public static void SetPlane(HullHeader* hull, int face, in HullPoint normal)
    {
        BundleIndexing.GetBundleIndices(face, out var bundle, out var lane);
        ref var plane = ref hull->Planes[bundle];
        var rounded = new Vector3((float)normal.X, (float)normal.Y, (float)normal.Z);
        Lanes.Write(rounded, ref plane.Normal, lane);
        var offset = double.MinValue;
        for (int i = hull->FaceStarts[face]; i < hull->FaceStarts[face + 1]; ++i)
        {
            var point = hull->GetPoint(hull->FaceVertices[i].Number);
            offset = Math.Max(offset, Along(rounded, point));
        }
        var isJoined = hull->FaceStarts[face + 1] - hull->FaceStarts[face] > 3;
        for (int i = 0; isJoined && (long)hull->VertexCount * hull->FaceCount <= AffordableCount && i < hull->VertexCount; ++i)
            offset = Math.Max(offset, Along(rounded, hull->GetPoint(i)));
        GatherScatter.Get(ref plane.Offset, lane) = Rounded.Up(offset);
    }

    /// <summary>Fills the last bundles and writes what is known of the whole, once vertices and planes are written.</summary>
    public static void Finish(HullHeader* hull)
    {
        var first = hull->GetPoint(0);
        for (int i = hull->VertexCount; i < hull->VertexBundleCount * Vector<float>.Count; ++i)
            SetPoint(hull, i, first);
        for (int i = hull->FaceCount; i < hull->FaceBundleCount * Vector<float>.Count; ++i)
            Lanes.Copy(ref hull->Planes[0], 0, ref hull->Planes[hull->FaceBundleCount - 1], i & BundleIndexing.VectorMask);

        hull->Min = hull->Max = first;
        var squaredRadius = 0.0;
        for (int i = 0; i < hull->VertexCount; ++i)
        {
            var point = hull->GetPoint(i);
            hull->Min = Exact.Min(point, hull->Min);
            hull->Max = Exact.Max(point, hull->Max);
            squaredRadius = Math.Max(squaredRadius, (double)point.X * point.X + (double)point.Y * point.Y + (double)point.Z * point.Z);
        }
        hull->OuterRadius = Rounded.Up(Math.Sqrt(squaredRadius));
        hull->InnerRadius = float.MaxValue;
        for (int i = 0; i < hull->FaceCount; ++i)
        {
            hull->GetPlane(i, out _, out var offset);
            hull->InnerRadius = offset < hull->InnerRadius ? offset : hull->InnerRadius;
        }
    }

    static double Along(in Vector3 normal, in Vector3 point) =>
        (double)normal.X * point.X + (double)normal.Y * point.Y + (double)normal.Z * point.Z;
}
