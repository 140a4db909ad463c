using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;

namespace BepuPhysics.Collidables;

/// <summary>First bytes of a mesh's memory: how much of what follows, and what is often asked of the whole.</summary>
/// <remarks>
/// In this order follow the nodes of the tree, the triangles in the order of its leaves, then those that are in none, and the vertices in the order in which
/// these have them; then by the numbers that the game gave the triangles the place of each, three bytes for its edges
/// (<see cref="MeshEdges"/>) and, if there are any, its material.
/// There are no addresses inside, so the memory may be copied as it is, and no lane widths: a mesh is the same bytes on every machine.
/// </remarks>
[StructLayout(LayoutKind.Sequential, Size = ByteCount)]
unsafe struct MeshHeader
{
    /// <summary>Size of the header: the arrays behind it begin on a cache line.</summary>
    public const int ByteCount = 128;

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

    // What triangles and places are named with.
    readonly int NamedCount
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => TriangleCount > VertexCount ? TriangleCount : VertexCount;
    }

    /// <summary>The triangles by their places.</summary>
    public readonly MeshTriangles Triangles
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => new((byte*)(Nodes + NodeCount), NamedCount);
    }

    /// <summary>Vertices, before scaling. At least four bytes follow the last one, so that four floats may be read at each.</summary>
    public readonly Vector3* Vertices
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => (Vector3*)((byte*)(Nodes + NodeCount) + (nint)TriangleCount * MeshTriangles.TriangleByteCount(NamedCount));
    }

    // Places of triangles by their numbers.
    readonly byte* Places
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => (byte*)(Vertices + VertexCount);
    }

    /// <summary>Edges AB, BC and CA of each triangle.</summary>
    public readonly byte* Edges
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => Places + (nint)TriangleCount * MeshTriangles.ByteCountOf(NamedCount);
    }

    /// <summary>Material of each triangle, if there are materials.</summary>
    public readonly byte* Materials => Edges + 3 * TriangleCount;

    /// <summary>Size of header and arrays together.</summary>
    public readonly long TotalByteCount => ByteCount + (long)NodeCount * sizeof(MeshNode) + (long)VertexCount * sizeof(Vector3) +
        (MeshTriangles.TriangleByteCount(NamedCount) + MeshTriangles.ByteCountOf(NamedCount) + 3L + (HasMaterials != 0 ? 1 : 0)) * TriangleCount;

    /// <summary>Place of a triangle by its number.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly int GetPlace(int triangle) => Triangles.GetPlace(Places, triangle);

    /// <summary>Asks the processor to load what is kept by the number of a triangle: its place and its edges. Changes no result.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly void Prefetch(int triangle)
    {
        BepuUtilities.Memory.Prefetch.Read(Places + (nint)triangle * MeshTriangles.ByteCountOf(NamedCount));
        BepuUtilities.Memory.Prefetch.Read(Edges + 3 * (nint)triangle);
    }

    /// <summary>Writes a triangle, and that it is at this place.</summary>
    public readonly void SetTriangle(int place, in MeshTriangle triangle)
    {
        Triangles.Set(place, triangle);
        Triangles.SetPlace(Places, triangle.Number, place);
    }

    /// <summary>Corners of the triangle at a place, before scaling.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly void GetCornersAt(int place, out Vector3 a, out Vector3 b, out Vector3 c)
    {
        var triangle = Triangles.Get(place);
        var vertices = Vertices;
        a = vertices[triangle.A];
        b = vertices[triangle.B];
        c = vertices[triangle.C];
    }

    /// <summary>Corners of a triangle by its number, before scaling.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly void GetCorners(int triangle, out Vector3 a, out Vector3 b, out Vector3 c) => GetCornersAt(GetPlace(triangle), out a, out b, out c);

    /// <summary>Whether a triangle is not in the tree.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly bool IsLeftOut(int triangle) => GetPlace(triangle) >= PlacedCount;
}
