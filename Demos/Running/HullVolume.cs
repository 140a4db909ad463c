using System;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuUtilities.Memory;

namespace Demos.Running;

/// <summary>Volume of a convex hull: the sum of the tetrahedra between its centre and the triangles of its faces.</summary>
static class HullVolume
{
    public static double Of(in ConvexHull hull)
    {
        double volume = 0;
        for (int face = 0; face < hull.FaceToVertexIndicesStart.Length; ++face)
        {
            hull.GetVertexIndicesForFace(face, out Buffer<HullVertexIndex> vertices);
            hull.GetPoint(vertices[0], out Vector3 first);
            for (int i = 2; i < vertices.Length; ++i)
            {
                hull.GetPoint(vertices[i - 1], out Vector3 second);
                hull.GetPoint(vertices[i], out Vector3 third);
                Vector3 normal = SceneMath.Cross(second, third);
                volume += Math.Abs((double)first.X * normal.X + (double)first.Y * normal.Y + (double)first.Z * normal.Z) / 6;
            }
        }
        return volume;
    }
}
