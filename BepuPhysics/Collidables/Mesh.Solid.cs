using System;
using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.Collidables;

// The inside of a closed mesh.
public unsafe partial struct Mesh
{
    /// <summary>Whether what is inside of the mesh is pushed out to the nearest part of its surface; false unless it is set.</summary>
    /// <remarks>
    /// <para>A mesh that is not solid is a thin skin: what has come through it, or was put inside, moves freely there. Of a solid one each convex
    /// shape, and each convex child of a compound, whose origin is behind the surface meets the plane through the nearest point of the surface in place of
    /// triangles, and leaves at the speed at which its material recovers from overlaps. Triangles of other meshes and of height fields have no such
    /// middle: two meshes touch with their skins.</para>
    /// <para>It costs a search for the nearest triangle, each time that a pair is tested whose other shape has its origin in the bounds of the mesh.</para>
    /// <para>As a child of a compound a mesh is a skin, solid or not.</para>
    /// <para>It belongs to each copy, as <see cref="Scale"/> does.</para>
    /// </remarks>
    /// <exception cref="InvalidOperationException">The mesh is not closed, see <see cref="MeshReport.IsClosed"/>.</exception>
    /// <exception cref="ArgumentException">The triangles are inside out, or enclose nothing.</exception>
    public bool Solid
    {
        readonly get => solid;
        set
        {
            if (value)
                CheckSolid();
            solid = value;
        }
    }

    readonly void CheckSolid()
    {
        Validate();
        if (!Report.IsClosed)
            throw new InvalidOperationException(
                $"Only a closed mesh can be solid. This one has {Report.BorderEdgeCount} edges of one triangle only, {Report.FlippedEdgeCount} between " +
                $"triangles of which one is inside out, and {Report.CrowdedEdgeCount} of three triangles or more.");
        ComputeClosedCenterOfMass(out _, out _);
    }

    // A point this near to the surface, as a part of the largest coordinate, is on it: from where a test of two shapes looks it may be behind.
    const float OnSurface = 1e-6f;
    // Cosine from which on the way to the nearest point is along the normal, which is known better.
    const float AlongNormal = 0.999999f;

    static bool IContainer.MayBeSolid => true;

    readonly bool IContainer.IsSolid => solid;

    readonly bool IContainer.FindWayOut(Vector3 point, out WayOut way)
    {
        way = default;
        GetScaledBounds(out var min, out var max);
        if (!BoundingBox.IntersectsUnsafe(point, point, min, max))
            return false;
        var nearest = new MeshNearest(this, point);
        var tolerance = Exact.Max(Vector3.Abs(min), Vector3.Abs(max)).Largest() * OnSurface;
        if (nearest.Triangle < 0 || nearest.Height > tolerance)
            return false;
        var distance = Exact.Length(nearest.Offset);
        way.Child = nearest.Triangle;
        way.Place = point + nearest.Offset;
        way.Normal = distance <= tolerance || -nearest.Height >= distance * AlongNormal ? nearest.Normal : nearest.Offset * (1 / distance);
        return true;
    }
}
