using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>What a bundle of features is, besides its vertices.</summary>
public struct ContactFeatureWide
{
    /// <summary>Number of vertices: 1 is a point, 2 a segment, more a polygon.</summary>
    public Vector<int> VertexCount;
    /// <summary>
    /// Normal of the plane of the feature, of any length, in the shape's frame and out of it; of a segment, the part of the direction
    /// that is across it. Zero where there is none.
    /// </summary>
    public Vector3Wide PlaneNormal;
    /// <summary>Names the feature among those of its shape; the lowest 11 bits are used.</summary>
    public Vector<int> Id;
    /// <summary>How far the surface lies outside of the vertices, along the direction, m: the radius of a sphere or capsule, else zero.</summary>
    public Vector<float> Margin;
    /// <summary>Radius of the surface around a segment, m; zero for all else.</summary>
    public Vector<float> Roundness;
    /// <summary>Length that tolerances are relative to, m: the greatest distance of the shape's surface from its centre.</summary>
    public Vector<float> Size;
}
