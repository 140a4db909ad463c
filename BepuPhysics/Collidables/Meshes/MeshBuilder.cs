using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>Builds the memory of a mesh: vertices are shared, triangles without a surface left out, edges and tree found.</summary>
/// <remarks>All temporary memory goes back to the pool, also when the input is refused.</remarks>
static unsafe class MeshBuilder
{
    /// <summary>Greatest number of triangles of a mesh.</summary>
    public const int MaximumTriangleCount = 1 << 26;

    /// <summary>Where the corners come from.</summary>
    interface ICornerSource
    {
        int TriangleCount { get; }

        /// <summary>Number of a corner's vertex.</summary>
        int GetVertex(int triangle, int corner, ref MeshWeld weld, in CornerCheck check);
    }

    /// <summary>Refuses corners that no mesh can have.</summary>
    readonly struct CornerCheck(Vector3 scale)
    {
        const float Limit = ShapeLimits.MaximumSize;

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public void Check(int triangle, int corner, Vector3 value)
        {
            // What is not a number is not within the limits; nor is what is infinite before it is scaled.
            if (!(Vector3.LessThanOrEqualAll(Vector3.Abs(value * scale), new(Limit)) && Vector3.LessThanOrEqualAll(Vector3.Abs(value), new(float.MaxValue))))
                Refuse(triangle, corner, value);
        }

        static void Refuse(int triangle, int corner, Vector3 value)
        {
            throw new ArgumentException(
                $"Corner {"ABC"[corner]} of triangle {triangle} is {value}; coordinates, scaled, must be from {-Limit} to {Limit} m.", nameof(value));
        }
    }

    readonly ref struct TriangleCorners(ReadOnlySpan<Triangle> triangles) : ICornerSource
    {
        readonly ReadOnlySpan<Triangle> triangles = triangles;

        public int TriangleCount => triangles.Length;

        public int GetVertex(int triangle, int corner, ref MeshWeld weld, in CornerCheck check)
        {
            ref readonly var source = ref triangles[triangle];
            var value = corner == 0 ? source.A : corner == 1 ? source.B : source.C;
            check.Check(triangle, corner, value);
            return weld.Add(value);
        }
    }

    readonly ref struct IndexedCorners(ReadOnlySpan<Vector3> vertices, ReadOnlySpan<int> indices, int* numbers) : ICornerSource
    {
        readonly ReadOnlySpan<Vector3> vertices = vertices;
        readonly ReadOnlySpan<int> indices = indices;
        // Of the vertices that have come already, plus one.
        readonly int* numbers = numbers;

        public int TriangleCount => indices.Length / 3;

        public int GetVertex(int triangle, int corner, ref MeshWeld weld, in CornerCheck check)
        {
            var index = indices[3 * triangle + corner];
            if ((uint)index >= (uint)vertices.Length)
            {
                throw new ArgumentException(
                    $"Corner {"ABC"[corner]} of triangle {triangle} has vertex {index}; there are {vertices.Length} vertices.");
            }
            ref var number = ref numbers[index];
            if (number == 0)
            {
                check.Check(triangle, corner, vertices[index]);
                number = weld.Add(vertices[index]) + 1;
            }
            return number - 1;
        }
    }

    /// <summary>Builds a mesh of triangles that each have corners of their own.</summary>
    public static Buffer<byte> Build(ReadOnlySpan<Triangle> triangles, Vector3 scale, BufferPool pool, IThreadDispatcher? dispatcher)
    {
        CheckCount(triangles.Length, nameof(triangles));
        var weld = new MeshWeld(triangles.Length / 2, pool);
        try
        {
            return Build(new TriangleCorners(triangles), ref weld, scale, [], pool, dispatcher);
        }
        finally
        {
            weld.Dispose();
        }
    }

    /// <summary>Builds a mesh of triangles with numbered vertices.</summary>
    public static Buffer<byte> Build(
        ReadOnlySpan<Vector3> vertices, ReadOnlySpan<int> indices, Vector3 scale, ReadOnlySpan<byte> materials, BufferPool pool,
        IThreadDispatcher? dispatcher)
    {
        if (indices.Length % 3 != 0)
            throw new ArgumentException($"There are {indices.Length} indices; a triangle has three.", nameof(indices));
        CheckCount(indices.Length / 3, nameof(indices));
        if (materials.Length != 0 && materials.Length != indices.Length / 3)
            throw new ArgumentException($"There are {materials.Length} materials for {indices.Length / 3} triangles.", nameof(materials));
        var weld = new MeshWeld(vertices.Length, pool);
        pool.TakeAtLeast<int>(Math.Max(1, vertices.Length), out var numbers);
        try
        {
            numbers.Clear(0, vertices.Length);
            return Build(new IndexedCorners(vertices, indices, numbers.Memory), ref weld, scale, materials, pool, dispatcher);
        }
        finally
        {
            pool.Return(ref numbers);
            weld.Dispose();
        }
    }

    static void CheckCount(int triangleCount, string name)
    {
        if (triangleCount is < 1 or > MaximumTriangleCount)
            throw new ArgumentException($"A mesh has from 1 to {MaximumTriangleCount} triangles, not {triangleCount}.", name);
    }

    static Buffer<byte> Build<TSource>(
        TSource source, ref MeshWeld weld, Vector3 scale, ReadOnlySpan<byte> materials, BufferPool pool, IThreadDispatcher? dispatcher)
        where TSource : ICornerSource, allows ref struct
    {
        CheckScale(scale);
        var count = source.TriangleCount;
        Buffer<int> indices = default, order = default;
        Buffer<byte> edges = default;
        Buffer<Vector3> normals = default;
        QuickList<MeshNode> nodes = default;
        try
        {
            pool.TakeAtLeast(3 * count, out indices);
            var check = new CornerCheck(scale);
            for (int triangle = 0; triangle < count; ++triangle)
            {
                for (int corner = 0; corner < 3; ++corner)
                    indices.Memory[3 * triangle + corner] = source.GetVertex(triangle, corner, ref weld, check);
            }
            pool.TakeAtLeast(3 * count, out edges);
            pool.TakeAtLeast(count, out normals);
            edges.AsSpan()[..(3 * count)].Fill(MeshEdges.Free);
            var header = new MeshHeader { VertexCount = weld.Count, TriangleCount = count, HasMaterials = materials.Length > 0 ? 1 : 0 };
            header.Report.DegenerateTriangleCount = FindNormals(indices.Memory, count, weld.Points, scale, normals.Memory);
            MeshEdges.Find(indices.Memory, count, weld.Points, weld.Count, normals.Memory, edges.Memory, ref header.Report, pool);
            header.PlacedCount = count - header.Report.DegenerateTriangleCount - header.Report.DuplicateTriangleCount;
            if (header.PlacedCount == 0)
            {
                throw new ArgumentException($"None of the {count} triangles has a surface: " +
                    $"triangle 0 has corners {weld.Points[indices[0] & ~MeshEdges.LeftOut]}, " +
                    $"{weld.Points[indices[1]]}, {weld.Points[indices[2]]}.");
            }
            pool.TakeAtLeast(header.PlacedCount, out order);
            nodes = new(header.PlacedCount / 8 + 1, pool);
            MeshTree.Build(indices.Memory, count, weld.Points, header.PlacedCount, ref nodes, order.Memory, pool, dispatcher);
            header.NodeCount = nodes.Count;
            if (header.TotalByteCount > int.MaxValue)
                throw new ArgumentException(
                    $"A mesh of {count} triangles and {weld.Count} vertices takes {header.TotalByteCount} bytes; the limit is {int.MaxValue}.");
            pool.Take<byte>((int)header.TotalByteCount, out var data);
            var target = (MeshHeader*)data.Memory;
            new Span<byte>(target, MeshHeader.ByteCount).Clear();
            *target = header;
            nodes.AsSpan().CopyTo(new(target->Nodes, header.NodeCount));
            Place(target, indices.Memory, order.Memory, weld.Points, pool);
            Measure(ref *target, target->Vertices);
            edges.AsSpan()[..(3 * count)].CopyTo(new(target->Edges, 3 * count));
            materials.CopyTo(new(target->Materials, materials.Length));
            MeshTree.Refit(target);
            return data;
        }
        finally
        {
            pool.ReturnIfTaken(ref indices);
            pool.ReturnIfTaken(ref order);
            pool.ReturnIfTaken(ref edges);
            pool.ReturnIfTaken(ref normals);
            pool.ReturnIfTaken(ref nodes.Span);
        }
    }

    // Triangles in the order of the leaves, and vertices in the order in which these have them: what a leaf needs, and leaves side by side, lies together.
    static void Place(MeshHeader* mesh, int* indices, int* order, Vector3* points, BufferPool pool)
    {
        // Of vertices, plus one.
        pool.TakeAtLeast<int>(mesh->VertexCount, out var numbers);
        numbers.Clear(0, mesh->VertexCount);
        var vertexCount = 0;
        for (int place = 0; place < mesh->PlacedCount; ++place)
            PlaceTriangle(mesh, order[place], place, indices, points, numbers.Memory, ref vertexCount);
        var next = mesh->PlacedCount;
        for (int triangle = 0; triangle < mesh->TriangleCount; ++triangle)
        {
            if (indices[3 * triangle] < 0)
                PlaceTriangle(mesh, triangle, next++, indices, points, numbers.Memory, ref vertexCount);
        }
        pool.Return(ref numbers);
    }

    static void PlaceTriangle(MeshHeader* mesh, int triangle, int place, int* indices, Vector3* points, int* numbers, ref int vertexCount)
    {
        var corners = indices + 3 * triangle;
        var a = PlaceVertex(corners[0] & ~MeshEdges.LeftOut, mesh->Vertices, points, numbers, ref vertexCount);
        var b = PlaceVertex(corners[1], mesh->Vertices, points, numbers, ref vertexCount);
        var c = PlaceVertex(corners[2], mesh->Vertices, points, numbers, ref vertexCount);
        mesh->SetTriangle(place, new(a, b, c, triangle));
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static int PlaceVertex(int point, Vector3* vertices, Vector3* points, int* numbers, ref int count)
    {
        if (numbers[point] == 0)
        {
            vertices[count] = points[point];
            numbers[point] = ++count;
        }
        return numbers[point] - 1;
    }

    /// <summary>Refuses a scale that has no inverse.</summary>
    public static void CheckScale(Vector3 scale)
    {
        if (IsScale(scale.X) && IsScale(scale.Y) && IsScale(scale.Z))
            return;
        throw new ArgumentOutOfRangeException(nameof(scale), scale,
            $"Components of a mesh's scale must be from {LeastScale} to {1 / LeastScale}, or negative.");
    }

    const float LeastScale = 1e-9f;

    static bool IsScale(float scale) => MathF.Abs(scale) >= LeastScale && MathF.Abs(scale) <= 1 / LeastScale;

    // Normals before scaling; marks what is too thin when scaled, and returns the number of that.
    static int FindNormals(int* indices, int count, Vector3* vertices, Vector3 scale, Vector3* normals)
    {
        double scaleX = scale.X, scaleY = scale.Y, scaleZ = scale.Z;
        var thinCount = 0;
        for (int triangle = 0; triangle < count; ++triangle)
        {
            var corners = indices + 3 * triangle;
            Vector3 a = vertices[corners[0]], b = vertices[corners[1]], c = vertices[corners[2]];
            double abX = (double)b.X - a.X, abY = (double)b.Y - a.Y, abZ = (double)b.Z - a.Z;
            double acX = (double)c.X - a.X, acY = (double)c.Y - a.Y, acZ = (double)c.Z - a.Z;
            double x = acY * abZ - acZ * abY, y = acZ * abX - acX * abZ, z = acX * abY - acY * abX;
            var lengthSquared = x * x + y * y + z * z;
            if (!(lengthSquared > 0) || Triangle.IsThin(abX * scaleX, abY * scaleY, abZ * scaleZ, acX * scaleX, acY * scaleY, acZ * scaleZ, out _, out _))
            {
                corners[0] |= MeshEdges.LeftOut;
                ++thinCount;
                normals[triangle] = default;
                continue;
            }
            var inverse = 1 / Math.Sqrt(lengthSquared);
            normals[triangle] = new((float)(x * inverse), (float)(y * inverse), (float)(z * inverse));
        }
        return thinCount;
    }

    /// <summary>Middle and radius of the vertices.</summary>
    public static void Measure(ref MeshHeader header, Vector3* vertices)
    {
        double x = 0, y = 0, z = 0, squaredRadius = 0;
        for (int i = 0; i < header.VertexCount; ++i)
        {
            double vertexX = vertices[i].X, vertexY = vertices[i].Y, vertexZ = vertices[i].Z;
            x += vertexX;
            y += vertexY;
            z += vertexZ;
            squaredRadius = Math.Max(squaredRadius, vertexX * vertexX + vertexY * vertexY + vertexZ * vertexZ);
        }
        header.Middle = new((float)(x / header.VertexCount), (float)(y / header.VertexCount), (float)(z / header.VertexCount));
        header.OuterRadius = MathF.BitIncrement((float)Math.Sqrt(squaredRadius));
    }
}
