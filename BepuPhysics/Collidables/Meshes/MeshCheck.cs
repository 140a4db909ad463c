using System.Numerics;

namespace BepuPhysics.Collidables;

/// <summary>Whether the memory of a mesh is one that its queries can walk without leaving it.</summary>
static unsafe class MeshCheck
{
    /// <summary>Number of bytes of a mesh with these counts; -1 if no mesh has them.</summary>
    public static long ByteCount(in MeshHeader header)
    {
        var triangles = header.TriangleCount;
        if (triangles is < 1 or > MeshBuilder.MaximumTriangleCount || header.PlacedCount < 1 || header.PlacedCount > triangles ||
            header.VertexCount < 3 || header.VertexCount > 3L * triangles || header.NodeCount < 1 || header.NodeCount > header.PlacedCount ||
            header.HasMaterials is not (0 or 1))
            return -1;
        return header.TotalByteCount <= int.MaxValue ? header.TotalByteCount : -1;
    }

    /// <summary>What is wrong with a mesh whose counts fit its memory; null if nothing is.</summary>
    public static string? FindFault(MeshHeader* mesh)
    {
        var vertices = mesh->Vertices;
        for (int i = 0; i < mesh->VertexCount; ++i)
        {
            if (!IsInside(vertices[i], mesh->Min, mesh->Max))
                return $"vertex {i} is {vertices[i]}, outside of the bounds of all";
        }
        // Each number says where it is found: so all are different, and there is no other.
        for (int place = 0; place < mesh->TriangleCount; ++place)
        {
            var triangle = mesh->Triangles.Get(place);
            if ((uint)triangle.Number >= (uint)mesh->TriangleCount || mesh->GetPlace(triangle.Number) != place)
                return $"place {place} has triangle {triangle.Number}";
            if ((uint)triangle.A >= (uint)mesh->VertexCount || (uint)triangle.B >= (uint)mesh->VertexCount || (uint)triangle.C >= (uint)mesh->VertexCount)
                return $"triangle {triangle.Number} has vertices {triangle.A}, {triangle.B} and {triangle.C} of {mesh->VertexCount}";
        }
        // Radius and middle are of the vertices.
        var measured = *mesh;
        MeshBuilder.Measure(ref measured, vertices);
        if (measured.Middle != mesh->Middle || measured.OuterRadius != mesh->OuterRadius)
            return $"its middle and radius are not {mesh->Middle} and {mesh->OuterRadius}";
        return FindTreeFault(mesh);
    }

    // A node's first child that is a node follows those of the nodes before it, and its first triangle theirs: so each is reached once, and the height is
    // that which is counted here.
    static string? FindTreeFault(MeshHeader* mesh)
    {
        var walk = new Walk { Mesh = mesh, NodeEnd = 1 };
        var fault = walk.Visit(0, 1, new(float.NegativeInfinity), new(float.PositiveInfinity));
        if (fault is not null)
            return fault;
        return walk.NodeEnd == mesh->NodeCount && walk.PlaceEnd == mesh->PlacedCount
            ? null
            : $"the tree reaches {walk.NodeEnd} of {mesh->NodeCount} nodes and {walk.PlaceEnd} of {mesh->PlacedCount} triangles";
    }

    struct Walk
    {
        public MeshHeader* Mesh;
        public int NodeEnd, PlaceEnd;

        public string? Visit(int nodeIndex, int height, Vector3 low, Vector3 high)
        {
            var node = Mesh->Nodes + nodeIndex;
            if (height > MeshTree.MaximumHeight || !node->HasValidGrid || !node->HasValidCounts)
                return $"node {nodeIndex} is none";
            var nodeCount = BitOperations.PopCount((uint)node->NodeMask);
            if (node->FirstNode != NodeEnd || nodeCount > Mesh->NodeCount - NodeEnd)
                return $"node {nodeIndex} has nodes from {node->FirstNode} on, of {Mesh->NodeCount}";
            if (node->FirstPlace != PlaceEnd || node->TotalTriangleCount > Mesh->PlacedCount - PlaceEnd)
                return $"node {nodeIndex} has triangles from place {node->FirstPlace} on, of {Mesh->PlacedCount}";
            NodeEnd += nodeCount;
            PlaceEnd += node->TotalTriangleCount;
            for (int child = 0; child < MeshNode.Width; ++child)
            {
                node->GetBounds(child, out var min, out var max);
                if ((node->NodeMask >> child & 1) != 0)
                {
                    if (Visit(node->Node(child), height + 1, min, max) is { } fault)
                        return fault;
                    continue;
                }
                for (int i = 0; i < node->TriangleCount(child); ++i)
                {
                    Mesh->GetCornersAt(node->Place(child) + i, out var a, out var b, out var c);
                    if (!IsInside(a, min, max) || !IsInside(b, min, max) || !IsInside(c, min, max) ||
                        !IsInside(a, low, high) || !IsInside(b, low, high) || !IsInside(c, low, high))
                        return $"triangle {Mesh->Triangles.GetNumber(node->Place(child) + i)} is outside of the box of its leaf";
                }
            }
            return null;
        }
    }

    static bool IsInside(Vector3 point, Vector3 min, Vector3 max) =>
        point.X >= min.X && point.Y >= min.Y && point.Z >= min.Z && point.X <= max.X && point.Y <= max.Y && point.Z <= max.Z &&
        float.IsFinite(point.X) && float.IsFinite(point.Y) && float.IsFinite(point.Z);
}
