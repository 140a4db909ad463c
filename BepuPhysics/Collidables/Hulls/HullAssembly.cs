using System;
using System.Numerics;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>From points to the indices of their hull, and from these to a shape.</summary>
static unsafe class HullAssembly
{
    // How far the normal of a face that is computed from its corners may be from the one that the builder knows.
    const double SameNormal = 1e-7;
    // Factor on the tolerance where the hull has too many vertices otherwise: points may be outside by 9e-5 of the size then.
    const double Coarse = 3;

    /// <summary>Finds the hull of points. The normals are those of the faces, as the builder knows them.</summary>
    public static HullFailure TryFind(ReadOnlySpan<Vector3> points, BufferPool pool, out HullData data, out Buffer<HullPoint> normals)
    {
        data = default;
        normals = default;
        var failure = HullGrid.TryCreate(points, pool, out var grid);
        if (failure != HullFailure.None)
            return failure;
        failure = HullBuilder.TryBuild(grid, 1, pool, out var builder);
        if (failure == HullFailure.TooManyVertices)
        {
            // Finer than it can be told apart: a hundred thousand points on a sphere become half as many.
            builder.Dispose();
            failure = HullBuilder.TryBuild(grid, Coarse, pool, out builder);
        }
        if (failure == HullFailure.None)
        {
            var faces = HullFaces.Create(grid, builder, pool);
            failure = TryNumber(faces, points.Length, pool, out data, out normals);
            faces.Dispose();
        }
        builder.Dispose();
        grid.Dispose(pool);
        return failure;
    }

    /// <summary>Numbers the vertices in the order of the points, and begins each face with its vertex of the lowest number.</summary>
    static HullFailure TryNumber(in HullFaces faces, int pointCount, BufferPool pool, out HullData data, out Buffer<HullPoint> normals)
    {
        data = default;
        normals = default;
        pool.Take<int>(pointCount, out var numbers);
        numbers.AsSpan().Clear();
        var cornerCount = 0;
        for (int face = 0; face < faces.Count; ++face)
        {
            cornerCount += faces.CornerCounts[face];
            var halfEdge = faces.Outlines[face];
            for (int i = 0; i < faces.CornerCounts[face]; ++i, halfEdge = faces.Next(halfEdge))
                numbers[faces.Corner(halfEdge)] = 1;
        }
        var vertexCount = 0;
        for (int i = 0; i < pointCount; ++i)
            vertexCount += numbers[i];
        if (vertexCount > ConvexHull.MaximumVertexCount)
        {
            pool.Return(ref numbers);
            return HullFailure.TooManyVertices;
        }

        pool.Take(vertexCount, out data.OriginalVertexMapping);
        pool.Take(faces.Count, out data.FaceStartIndices);
        pool.Take(cornerCount, out data.FaceVertexIndices);
        pool.Take(faces.Count, out normals);
        vertexCount = 0;
        for (int i = 0; i < pointCount; ++i)
        {
            if (numbers[i] == 0)
                continue;
            data.OriginalVertexMapping[vertexCount] = i;
            numbers[i] = vertexCount++;
        }
        cornerCount = 0;
        for (int face = 0; face < faces.Count; ++face)
        {
            var lowest = faces.Outlines[face];
            var halfEdge = lowest;
            for (int i = 0; i < faces.CornerCounts[face]; ++i, halfEdge = faces.Next(halfEdge))
                lowest = faces.Corner(halfEdge) < faces.Corner(lowest) ? halfEdge : lowest;
            data.FaceStartIndices[face] = cornerCount;
            for (int i = 0; i < faces.CornerCounts[face]; ++i, lowest = faces.Next(lowest))
                data.FaceVertexIndices[cornerCount++] = numbers[faces.Corner(lowest)];
            normals[face] = faces.Normals[face];
        }
        pool.Return(ref numbers);
        return HullFailure.None;
    }

    /// <summary>Makes a shape of the hull of points.</summary>
    public static void Assemble(ReadOnlySpan<Vector3> points, in HullData data, in Buffer<HullPoint> normals, BufferPool pool,
        out Vector3 center, out ConvexHull hull)
    {
        var middle = FindCenter(points, data);
        center = new((float)middle.X, (float)middle.Y, (float)middle.Z);
        var faceCount = data.FaceStartIndices.Length;
        var header = HullBlock.Allocate(data.OriginalVertexMapping.Length, faceCount, data.FaceVertexIndices.Length, pool, out hull);
        for (int i = 0; i < data.OriginalVertexMapping.Length; ++i)
        {
            var offset = Position(points, data.OriginalVertexMapping[i]) - middle;
            HullBlock.SetPoint(header, i, new((float)offset.X, (float)offset.Y, (float)offset.Z));
        }
        for (int i = 0; i < data.FaceVertexIndices.Length; ++i)
            header->FaceVertices[i] = HullVertexIndex.FromNumber(data.FaceVertexIndices[i]);
        for (int face = 0; face < faceCount; ++face)
            header->FaceStarts[face] = data.FaceStartIndices[face];
        header->FaceStarts[faceCount] = data.FaceVertexIndices.Length;
        for (int face = 0; face < faceCount; ++face)
            HullBlock.SetPlane(header, face, FindNormal(points, data, face, normals[face]));
        HullBlock.Finish(header);
    }

    static HullPoint Position(ReadOnlySpan<Vector3> points, int index) => new(points[index].X, points[index].Y, points[index].Z);

    static HullPoint FindCenter(ReadOnlySpan<Vector3> points, in HullData data)
    {
        // From a vertex, and in units of a size, because sums of products of coordinates far from the origin lose the hull.
        var origin = Position(points, data.OriginalVertexMapping[0]);
        var size = 0.0;
        for (int i = 0; i < data.OriginalVertexMapping.Length; ++i)
            size = Math.Max(size, HullPoint.Length(Position(points, data.OriginalVertexMapping[i]) - origin));
        var scale = 1 / size;
        var mass = default(MassIntegrals);
        for (int face = 0; face < data.FaceStartIndices.Length; ++face)
        {
            data.GetFace(face, out var corners);
            var a = Corner(points, data, corners[0]);
            var b = Corner(points, data, corners[1]);
            for (int i = 2; i < corners.Length; ++i)
            {
                var c = Corner(points, data, corners[i]);
                mass.AddTetrahedron(a, b, c);
                b = c;
            }
        }
        var center = mass.Center;
        return origin + new HullPoint(center.X, center.Y, center.Z) * size;

        (double X, double Y, double Z) Corner(ReadOnlySpan<Vector3> points, in HullData data, int vertex)
        {
            var offset = (Position(points, data.OriginalVertexMapping[vertex]) - origin) * scale;
            return (offset.X, offset.Y, offset.Z);
        }
    }

    // The builder's normals are right even for a sliver whose own corners do not tell; those of the corners are not off by the builder's
    // moving points about, and are exactly those of an axis where they should be.
    static HullPoint FindNormal(ReadOnlySpan<Vector3> points, in HullData data, int face, in HullPoint known)
    {
        data.GetFace(face, out var corners);
        var origin = Position(points, data.OriginalVertexMapping[corners[0]]);
        var previous = Position(points, data.OriginalVertexMapping[corners[1]]) - origin;
        var normal = default(HullPoint);
        for (int i = 2; i < corners.Length; ++i)
        {
            var current = Position(points, data.OriginalVertexMapping[corners[i]]) - origin;
            normal += HullPoint.Cross(previous, current);
            previous = current;
        }
        var length = HullPoint.Length(normal);
        if (length == 0)
            return known;
        normal *= 1 / length;
        var isSame = HullPoint.Length(HullPoint.Cross(normal, known)) <= SameNormal && HullPoint.Dot(normal, known) > 0;
        return isSame ? normal : known;
    }
}
