using System;
using System.Numerics;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>Copies hulls through a linear map, which keeps the centre of mass where it is.</summary>
static unsafe class HullTransform
{
    const double SameNormal = 1e-6;

    public static void Copy(HullHeader* source, in Matrix3x3 transform, BufferPool pool, out ConvexHull target)
    {
        HullPoint x = Widen(transform.X), y = Widen(transform.Y), z = Widen(transform.Z);
        // Normals go by the cofactors, which is the inverse transpose but for a factor.
        HullPoint normalX = HullPoint.Cross(y, z), normalY = HullPoint.Cross(z, x), normalZ = HullPoint.Cross(x, y);
        var determinant = HullPoint.Dot(x, normalX);
        var isRegular = double.IsFinite(determinant) && determinant != 0;
        if (!isRegular)
        {
            throw new ArgumentException(
                $"A convex hull is transformed by a finite matrix of full rank, not by {transform.X}, {transform.Y}, {transform.Z}.",
                nameof(transform));
        }

        var header = HullBlock.Allocate(source->VertexCount, source->FaceCount, source->FaceVertexCount, pool, out target);
        for (int i = 0; i < source->VertexCount; ++i)
        {
            var point = source->GetPoint(i);
            var moved = x * point.X + y * point.Y + z * point.Z;
            HullBlock.SetPoint(header, i, new((float)moved.X, (float)moved.Y, (float)moved.Z));
        }
        for (int face = 0; face <= source->FaceCount; ++face)
            header->FaceStarts[face] = source->FaceStarts[face];
        for (int face = 0; face < source->FaceCount; ++face)
        {
            int start = source->FaceStarts[face], end = source->FaceStarts[face + 1];
            header->FaceVertices[start] = source->FaceVertices[start];
            // A mirror turns faces around; the vertex that they begin with stays.
            for (int i = start + 1; i < end; ++i)
                header->FaceVertices[i] = source->FaceVertices[determinant > 0 ? i : start + end - i];
            var normal = FindNormal(source, face);
            var moved = (normalX * normal.X + normalY * normal.Y + normalZ * normal.Z) * Math.Sign(determinant);
            HullBlock.SetPlane(header, face, moved * (1 / HullPoint.Length(moved)));
        }
        HullBlock.Finish(header);
        if (header->IsShape)
            return;
        float inner = header->InnerRadius, extent = header->LargestHalfExtent;
        target.Dispose(pool);
        throw new ArgumentException(
            $"Transformed by {transform.X}, {transform.Y}, {transform.Z}, the hull has no size that shapes can have: " +
            $"{extent} m in half extent, {inner} m to the nearest face.", nameof(transform));
    }

    // A map that stretches makes more of the rounding of a normal; the vertices tell it without that, but for those of slivers.
    static HullPoint FindNormal(HullHeader* hull, int face)
    {
        hull->GetPlane(face, out var rounded, out _);
        var known = Widen(rounded);
        int start = hull->FaceStarts[face], end = hull->FaceStarts[face + 1];
        var origin = Widen(hull->GetPoint(hull->FaceVertices[start].Number));
        var previous = Widen(hull->GetPoint(hull->FaceVertices[start + 1].Number)) - origin;
        var normal = default(HullPoint);
        for (int i = start + 2; i < end; ++i)
        {
            var current = Widen(hull->GetPoint(hull->FaceVertices[i].Number)) - origin;
            normal += HullPoint.Cross(previous, current);
            previous = current;
        }
        var length = HullPoint.Length(normal);
        return length > 0 && HullPoint.Length(normal * (1 / length) - known) < SameNormal ? normal * (1 / length) : known;
    }

    static HullPoint Widen(in Vector3 v) => new(v.X, v.Y, v.Z);
}
