using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;

namespace BepuPhysics.Collidables;

/// <summary>First bytes of a mesh's memory: how much of what follows, and what is often asked of the whole.</summary>
/// <remarks>
/// In this order follow the nodes of the tree, the vertices, three vertex numbers for each triangle, the triangles in the order of the
/// tree's leaves, three bytes for the edges of each triangle (<see cref="MeshEdges"/>) and, if there are any, a material for each.
/// There are no addresses inside, so the memory may be copied as it is, and no lane widths: a mesh is the same bytes on every machine.
/// </remarks>
[StructLayout(LayoutKind.Sequential, Size = ByteCount)]
unsafe struct MeshHeader
{
    /// <summary>Size of the header: the arrays behind it begin on a cache line.</summary>
    public const int ByteCount = 128;

    /// <summary>Bit of a triangle's first vertex number: the triangle is no surface and not in the tree.</summary>
    public const int LeftOut = 1 << 31;

    /// <summary>Number of vertices, each of which some triangle has.</summary>
    public int VertexCount;
    /// <summary>Number of triangles, those that are left out included.</summary>
    public int TriangleCount;
    /// <summary>Number of nodes.</summary>
    public int NodeCount;
    /// <summary>Number of triangles in the tree.</summary>
    public int PlacedCount;
    /// <summary>One if triangles have materials, else zero.</summary>
    public int HasMaterials;
    /// <summary>What was found when the mesh was built.</summary>
    public MeshReport Report;
    /// <summary>Least coordinates of the vertices, before scaling.</summary>
    public Vector3 Min;
    /// <summary>Greatest coordinates of the vertices, before scaling.</summary>
    public Vector3 Max;
    /// <summary>Mean of the vertices, before scaling.</summary>
    public Vector3 Middle;
    /// <summary>Distance from the origin to the farthest vertex, before scaling.</summary>
    public float OuterRadius;

    /// <summary>The tree; node 0 is its top, and a node's number is less than those of its children.</summary>
    // As all that follows, only for a header that is where it belongs: at the start of its mesh's memory.
    public readonly MeshNode* Nodes
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => (MeshNode*)((byte*)Unsafe.AsPointer(ref Unsafe.AsRef(in this)) + ByteCount);
    }

    /// <summary>Vertices, before scaling. At least twelve bytes follow the last one, so that four floats may be read at each.</summary>
    public readonly Vector3* Vertices
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => (Vector3*)(Nodes + NodeCount);
    }

    /// <summary>Vertex numbers, three for each triangle in the order of the game.</summary>
    public readonly int* Indices
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => (int*)(Vertices + VertexCount);
    }

    /// <summary>Triangles in the order of the leaves.</summary>
    public readonly int* Order
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => Indices + 3 * TriangleCount;
    }

    /// <summary>Edges AB, BC and CA of each triangle.</summary>
    public readonly byte* Edges
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => (byte*)(Order + PlacedCount);
    }

    /// <summary>Material of each triangle, if there are materials.</summary>
    public readonly byte* Materials => Edges + 3 * TriangleCount;

    /// <summary>Size of header and arrays together.</summary>
    public readonly long TotalByteCount => ByteCount + (long)NodeCount * sizeof(MeshNode) + (long)VertexCount * sizeof(Vector3) +
        15L * TriangleCount + 4L * PlacedCount + (HasMaterials != 0 ? TriangleCount : 0L);

    /// <summary>Corners of a triangle, before scaling.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly void GetCorners(int triangle, out Vector3 a, out Vector3 b, out Vector3 c)
    {
        var indices = Indices + 3 * triangle;
        var vertices = Vertices;
        a = vertices[indices[0] & ~LeftOut];
        b = vertices[indices[1]];
        c = vertices[indices[2]];
    }

    /// <summary>Whether a triangle is not in the tree.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly bool IsLeftOut(int triangle) => Indices[3 * triangle] < 0;
}
