using System;
using System.Numerics;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>Copies hulls through a linear map, which keeps the centre of mass where it is.</summary>
static unsafe class HullTransform
{
    public static void Copy(HullHeader* source, in Matrix3x3 transform, BufferPool pool, out ConvexHull target)
    {
        HullPoint x = Widen(transform.X), y = Widen(transform.Y), z = Widen(transform.Z);
        // Normals go by the cofactors, which is the inverse transpose but for a factor.
        HullPoint normalX = HullPoint.Cross(y, z), normalY = HullPoint.Cross(z, x), normalZ = HullPoint.Cross(x, y);
        var determinant = HullPoint.Dot(x, normalX);
        var isRegular = double.IsFinite(determinant) && determinant != 0;
        if (!isRegular)
            throw new ArgumentException($"A convex hull is transformed by a finite matrix of full rank, not by {transform.X}, {transform.Y}, {transform.Z}.", nameof(transform));

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
            source->GetPlane(face, out var normal, out _);
            var moved = (normalX * normal.X + normalY * normal.Y + normalZ * normal.Z) * Math.Sign(determinant);
            HullBlock.SetPlane(header, face, moved * (1 / HullPoint.Length(moved)));
        }
        HullBlock.Finish(header);
    }

    static HullPoint Widen(in Vector3 v) => new(v.X, v.Y, v.Z);
}
