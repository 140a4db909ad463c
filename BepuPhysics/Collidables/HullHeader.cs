using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using BepuUtilities;

namespace BepuPhysics.Collidables;

/// <summary>First bytes of a convex hull's memory: how much of what follows, and what is often asked of the whole.</summary>
/// <remarks>
/// In this order follow the vertices in bundles, the planes of the faces in bundles, for each face the place of its first vertex in the
/// list that comes last (and one number more, the end of the last face), and the vertices of all faces.
/// The last bundle of vertices is filled up with copies of vertex 0, the last bundle of planes with copies of plane 0: no copy is ever
/// farther or nearer than its original, and where ties go to the lowest number none is ever chosen.
/// There are no addresses inside, so that the memory may be copied as it is.
/// </remarks>
[StructLayout(LayoutKind.Sequential, Size = ByteCount)]
unsafe struct HullHeader
{
    /// <summary>Size of the header: the arrays behind it begin on a cache line.</summary>
    public const int ByteCount = 128;

    /// <summary>Number of vertices, without the copies in the last bundle.</summary>
    public int VertexCount;
    /// <summary>Number of bundles of vertices.</summary>
    public int VertexBundleCount;
    /// <summary>Number of faces, without the copies in the last bundle.</summary>
    public int FaceCount;
    /// <summary>Number of bundles of planes.</summary>
    public int FaceBundleCount;
    /// <summary>Number of vertices of all faces together: twice the number of edges.</summary>
    public int FaceVertexCount;
    /// <summary>Radius of the greatest ball around the centre of mass that is inside: the least offset of a plane, m.</summary>
    public float InnerRadius;
    /// <summary>Distance from the centre of mass to the farthest vertex, m.</summary>
    public float OuterRadius;
    /// <summary>Least coordinates of the vertices, m.</summary>
    public Vector3 Min;
    /// <summary>Greatest coordinates of the vertices, m.</summary>
    public Vector3 Max;

    /// <summary>Half of the largest side of the box, m.</summary>
    public readonly float LargestHalfExtent
    {
        get
        {
            var extent = (Max - Min) * 0.5f;
            var largest = extent.X > extent.Y ? extent.X : extent.Y;
            return largest > extent.Z ? largest : extent.Z;
        }
    }

    /// <summary>Whether the hull can be added as a shape.</summary>
    public readonly bool IsShape => ShapeLimits.IsSize(InnerRadius) && ShapeLimits.IsSize(LargestHalfExtent);

    /// <summary>Vertices in bundles. As all that follows, only for a header that is where it belongs: at the start of its hull's memory.</summary>
    public readonly Vector3Wide* Points
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => (Vector3Wide*)((byte*)Unsafe.AsPointer(ref Unsafe.AsRef(in this)) + ByteCount);
    }

    /// <summary>Planes of the faces in bundles.</summary>
    public readonly HullBoundingPlanes* Planes
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => (HullBoundingPlanes*)(Points + VertexBundleCount);
    }

    /// <summary>Place of the first vertex of each face in <see cref="FaceVertices"/>, and the end of the last face.</summary>
    public readonly int* FaceStarts
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => (int*)(Planes + FaceBundleCount);
    }

    /// <summary>Vertices of the faces, counterclockwise seen from outside.</summary>
    public readonly HullVertexIndex* FaceVertices
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => (HullVertexIndex*)(FaceStarts + FaceCount + 1);
    }

    /// <summary>Size of header and arrays together.</summary>
    public readonly long TotalByteCount => ByteCount + (long)VertexBundleCount * sizeof(Vector3Wide) +
        (long)FaceBundleCount * sizeof(HullBoundingPlanes) + (FaceCount + 1L) * sizeof(int) + (long)FaceVertexCount * sizeof(HullVertexIndex);

    /// <summary>A vertex by its number.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly Vector3 GetPoint(int vertex)
    {
        BundleIndexing.GetBundleIndices(vertex, out var bundle, out var lane);
        var x = (float*)(Points + bundle) + lane;
        return new(x[0], x[Vector<float>.Count], x[2 * Vector<float>.Count]);
    }

    /// <summary>The plane of a face.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly void GetPlane(int face, out Vector3 normal, out float offset)
    {
        BundleIndexing.GetBundleIndices(face, out var bundle, out var lane);
        var x = (float*)(Planes + bundle) + lane;
        normal = new(x[0], x[Vector<float>.Count], x[2 * Vector<float>.Count]);
        offset = x[3 * Vector<float>.Count];
    }
}
