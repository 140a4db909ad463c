using System.Numerics;

namespace BepuPhysics.Collidables;

public unsafe partial struct ConvexHull
{
    /// <summary>The faces of a hull, cut into triangles that are clockwise seen from outside, as <see cref="MeshInertiaHelper"/> takes them.</summary>
    /// <remarks>A view: the hull must not be disposed while it is used. Of the default hull there are no triangles.</remarks>
    /// <param name="hull">The hull.</param>
    public struct ConvexHullTriangleSource(in ConvexHull hull) : ITriangleSource
    {
        readonly ConvexHull hull = hull;
        int face;
        // Number of the triangle within the face, which is a fan around the face's first vertex.
        int triangle;

        /// <inheritdoc/>
        public bool GetNextTriangle(out Vector3 a, out Vector3 b, out Vector3 c)
        {
            if (face >= hull.FaceCount)
            {
                a = b = c = default;
                return false;
            }
            hull.GetVertexIndicesForFace(face, out var vertices);
            // Backwards, since faces are counterclockwise.
            hull.GetPoint(vertices[0], out a);
            hull.GetPoint(vertices[triangle + 2], out b);
            hull.GetPoint(vertices[triangle + 1], out c);
            if (++triangle >= vertices.Length - 2)
            {
                triangle = 0;
                ++face;
            }
            return true;
        }
    }
}
