using System;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuUtilities.Memory;

namespace Demos.Accuracy;

/// <summary>The inside of a cylinder of flat sides along Z, as a mesh: a drum, or a part of one as a trough.</summary>
static class FacetedCylinder
{
    /// <param name="pool">Source of the triangles, two for each side.</param>
    /// <param name="radius">Distance from the axis to the edges, m.</param>
    /// <param name="halfLength">Half of its length, m.</param>
    /// <param name="sideCount">Number of sides.</param>
    /// <param name="angle">Angle that the sides take up from -X on by way of -Y, rad; of a whole turn the last edge is the first, bit for bit.</param>
    public static Mesh Create(BufferPool pool, float radius, float halfLength, int sideCount, double angle)
    {
        pool.Take(2 * sideCount, out Buffer<Triangle> triangles);
        var across = new Vector3(0, 0, halfLength);
        for (int i = 0; i < sideCount; ++i)
        {
            var (a, b) = (Edge(i), Edge(angle == Math.Tau ? (i + 1) % sideCount : i + 1));
            triangles[2 * i] = new(a - across, b - across, a + across);
            triangles[2 * i + 1] = new(b - across, b + across, a + across);
        }
        return new Mesh(triangles, Vector3.One, pool);

        Vector3 Edge(int i)
        {
            var at = angle * i / sideCount;
            return new((float)(-radius * Math.Cos(at)), (float)(-radius * Math.Sin(at)), 0);
        }
    }
}
