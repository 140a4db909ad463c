namespace BepuPhysics.Collidables;

/// <summary>What was found in the triangles of a mesh when it was built.</summary>
/// <remarks>
/// Edges are those of the triangles that are not left out; vertices are shared where their coordinates are equal. At an edge between two
/// triangles that face the same side contacts are smoothed; at all others each triangle is on its own.
/// </remarks>
public struct MeshReport
{
    /// <summary>Triangles that are thinner than a <see cref="Triangle"/> may be. They keep their numbers and collide with nothing.</summary>
    public int DegenerateTriangleCount;
    /// <summary>Triangles with the vertices and the front of an earlier one. They keep their numbers and collide with nothing.</summary>
    public int DuplicateTriangleCount;
    /// <summary>Edges between two triangles that face the same side.</summary>
    public int SharedEdgeCount;
    /// <summary>Edges that only one triangle has: the border of an open mesh, holes, and where a vertex lies on another triangle's edge.</summary>
    public int BorderEdgeCount;
    /// <summary>Edges between two triangles of which one is inside out.</summary>
    public int FlippedEdgeCount;
    /// <summary>Edges that three triangles or more have.</summary>
    public int CrowdedEdgeCount;

    /// <summary>Whether every edge is between two triangles that face the same side, so that there is an inside.</summary>
    public readonly bool IsClosed => SharedEdgeCount > 0 && BorderEdgeCount == 0 && FlippedEdgeCount == 0 && CrowdedEdgeCount == 0;
}
