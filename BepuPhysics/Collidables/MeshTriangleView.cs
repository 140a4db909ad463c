using System;

namespace BepuPhysics.Collidables;

/// <summary>Triangles of a mesh by their numbers, as they were given to it: before scaling, and those included that are left out.</summary>
/// <remarks>A view, valid until the mesh is disposed. A mesh keeps its corners packed, so a triangle is a copy: it is read, not written to.</remarks>
public readonly struct MeshTriangleView
{
    readonly Mesh unscaled;

    internal MeshTriangleView(in Mesh unscaled) => this.unscaled = unscaled;

    /// <summary>How many triangles there are: <see cref="Mesh.ChildCount"/>.</summary>
    public int Length => unscaled.ChildCount;

    /// <summary>A triangle by its number.</summary>
    /// <param name="triangleIndex">Number of the triangle, less than <see cref="Length"/>.</param>
    /// <exception cref="ArgumentOutOfRangeException">There is no such triangle.</exception>
    public Triangle this[int triangleIndex]
    {
        get
        {
            unscaled.GetLocalChild(triangleIndex, out var triangle);
            return triangle;
        }
    }
}
