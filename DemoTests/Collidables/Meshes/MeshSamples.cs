using System;
using System.Collections.Generic;
using System.Numerics;

namespace DemoTests.Collidables.Meshes;

/// <summary>Vertices and triangles, clockwise seen from their fronts.</summary>
sealed record MeshSample(Vector3[] Vertices, int[] Indices)
{
    public int TriangleCount => Indices.Length / 3;

    public MeshSample Moved(Vector3 offset) => new(Array.ConvertAll(Vertices, vertex => vertex + offset), Indices);

    /// <summary>Ground of cells of a metre with waves, its front upward.</summary>
    public static MeshSample Terrain(int cells, float height = 1)
    {
        var vertices = new List<Vector3>();
        var indices = new List<int>();
        for (int i = 0; i <= cells; ++i)
        {
            for (int j = 0; j <= cells; ++j)
            {
                float x = i - cells / 2, z = j - cells / 2;
                vertices.Add(new(x, height * (MathF.Sin(.2f * x) + MathF.Sin(.17f * z + 1) + MathF.Sin(.11f * (x + z))), z));
            }
        }
        for (int i = 0; i < cells; ++i)
        {
            for (int j = 0; j < cells; ++j)
            {
                int a = i * (cells + 1) + j, b = a + 1, c = a + cells + 1, d = c + 1;
                indices.AddRange([a, c, b, b, c, d]);
            }
        }
        return new([.. vertices], [.. indices]);
    }

    /// <summary>Triangles of about a size, anywhere in a box.</summary>
    public static MeshSample Soup(int count, int seed, float extent = 10, float size = 1)
    {
        var random = new Random(seed);
        Vector3 Next(float range) => new(
            ((float)random.NextDouble() * 2 - 1) * range, ((float)random.NextDouble() * 2 - 1) * range, ((float)random.NextDouble() * 2 - 1) * range);
        var vertices = new Vector3[3 * count];
        for (int i = 0; i < count; ++i)
        {
            var place = Next(extent);
            for (int j = 0; j < 3; ++j)
                vertices[3 * i + j] = place + Next(size);
        }
        var indices = new int[3 * count];
        for (int i = 0; i < indices.Length; ++i)
            indices[i] = i;
        return new(vertices, indices);
    }

    /// <summary>Box with its centre at the origin.</summary>
    public static MeshSample Box(Vector3 half)
    {
        var vertices = new Vector3[8];
        for (int i = 0; i < 8; ++i)
            vertices[i] = new((i & 1) != 0 ? half.X : -half.X, (i & 2) != 0 ? half.Y : -half.Y, (i & 4) != 0 ? half.Z : -half.Z);
        // Counterclockwise from outside, then turned over.
        int[] quads = [0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5];
        var indices = new List<int>();
        for (int i = 0; i < quads.Length; i += 4)
            indices.AddRange([quads[i], quads[i + 2], quads[i + 1], quads[i], quads[i + 3], quads[i + 2]]);
        return new(vertices, [.. indices]);
    }

    /// <summary>Closed tube around the y axis, bent into a ring: a torus.</summary>
    public static MeshSample Torus(float ring, float tube, int around, int along)
    {
        var vertices = new List<Vector3>();
        var indices = new List<int>();
        for (int i = 0; i < around; ++i)
        {
            for (int j = 0; j < along; ++j)
            {
                double u = 2 * Math.PI * i / around, v = 2 * Math.PI * j / along;
                var radius = ring + tube * Math.Cos(v);
                vertices.Add(new((float)(radius * Math.Cos(u)), (float)(tube * Math.Sin(v)), (float)(radius * Math.Sin(u))));
                int a = i * along + j, b = (i + 1) % around * along + j, c = i * along + (j + 1) % along, d = (i + 1) % around * along + (j + 1) % along;
                indices.AddRange([a, b, c, b, d, c]);
            }
        }
        return new([.. vertices], [.. indices]);
    }
}
