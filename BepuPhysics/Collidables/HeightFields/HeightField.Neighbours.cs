using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.Collidables;

// What is next to a triangle follows from the heights around it, and is not stored.
public unsafe partial struct HeightField
{
    // Sine of an angle of normals that counts as flat: what rounding leaves of a plane.
    const float FlatSine = 1e-4f;

    /// <summary>Where the neighbours of a triangle begin. Its edges at the border of the field and at holes are free.</summary>
    /// <param name="x">Its cell.</param>
    /// <param name="z">Its cell.</param>
    /// <param name="isSecond">Which of the two of its cell.</param>
    /// <param name="triangle">The triangle, about a place near it.</param>
    /// <param name="from">That place.</param>
    // Edges AB, BC and CA of a cell's triangles, as they are made: with the falling diagonal front, diagonal, near and back, diagonal, far; with the
    // rising one front, far, diagonal and back, near, diagonal.
    readonly TriangleCone GetCone(int x, int z, bool isSecond, in Triangle triangle, Vector3 from)
    {
        var normal = NormalOf(triangle);
        var rises = HasCells && Cells[z * CellCountX + x].HasRisingDiagonal;
        var cone = new TriangleCone { Cosines = Vector3.One };
        var step = isSecond ? 1 : -1;
        AddNeighbour(ref cone, 0, triangle, normal, from, x, z + step, !isSecond);
        AddNeighbour(ref cone, rises ? 2 : 1, triangle, normal, from, x, z, !isSecond);
        // To the far side of a cell with the falling diagonal lies its second triangle, and to that of one with the rising diagonal its first.
        var sideX = x + (isSecond != rises ? 1 : -1);
        var isInside = (uint)sideX < (uint)CellCountX;
        var neighbourRises = isInside && HasCells && Cells[z * CellCountX + sideX].HasRisingDiagonal;
        AddNeighbour(ref cone, rises ? 1 : 2, triangle, normal, from, sideX, z, sideX > x ? neighbourRises : !neighbourRises);
        return cone;
    }

    readonly void AddNeighbour(
        ref TriangleCone cone, int edge, in Triangle triangle, Vector3 normal, Vector3 from, int otherX, int otherZ, bool otherIsSecond)
    {
        if ((uint)otherX >= (uint)CellCountX || (uint)otherZ >= (uint)CellCountZ || IsHole(otherX, otherZ))
        {
            cone.FreeMask |= 1 << edge;
            return;
        }
        var other = GetTriangle(otherX, otherZ, otherIsSecond, from.X, from.Y, from.Z);
        var otherNormal = NormalOf(other);
        var sine = Exact.Length(Exact.Cross(normal, otherNormal));
        // Two of its corners are shared, so the sum is how far the third one is below.
        var below = Exact.Dot(normal, triangle.A - other.A) + Exact.Dot(normal, triangle.A - other.B) + Exact.Dot(normal, triangle.A - other.C);
        if (sine <= FlatSine || below <= 0)
            return;
        cone.Sines[edge] = sine;
        cone.Cosines[edge] = Exact.Dot(normal, otherNormal);
    }

    static Vector3 NormalOf(in Triangle triangle) => Exact.Normalize(Exact.Cross(triangle.C - triangle.A, triangle.B - triangle.A));
}
