using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.Collidables;

/// <summary>A bundle of planes that bound a convex hull, one per face: the hull is where dot(normal, point) is at most the offset.</summary>
public struct HullBoundingPlanes
{
    /// <summary>Unit normals that point out of the hull.</summary>
    public Vector3Wide Normal;
    /// <summary>Distances from the centre of mass to the planes, m; positive.</summary>
    public Vector<float> Offset;
}
