using System.Numerics;

namespace BepuPhysics.Collidables;

/// <summary>Where the neighbours of a triangle of a mesh begin: for each of its edges, AB, BC and CA, the angle by which the surface bends away.</summary>
/// <remarks>
/// The angle is that from the triangle's normal to the neighbour's, and zero where the surface is flat or bends towards the front. Directions
/// from which something can touch the edge are between the two normals. A free edge has no neighbour that is known, and no such bound.
/// </remarks>
struct TriangleCone
{
    /// <summary>Cosines of the angles at AB, BC and CA; one where the edge is free.</summary>
    public Vector3 Cosines;
    /// <summary>Sines of the angles at AB, BC and CA; zero where the edge is free.</summary>
    public Vector3 Sines;
    /// <summary>Bits 0 to 2: edge AB, BC or CA is free.</summary>
    public int FreeMask;
}
