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

    /// <summary>Closed ball of about a metre: an icosahedron whose triangles were split in four, and whose vertices were moved in and out.</summary>
    public static MeshSample Ball(int splits, float roughness = 0, int seed = 0)
    {
        var random = new Random(seed);
        var golden = (1 + MathF.Sqrt(5)) / 2;
        List<Vector3> vertices = [];
        for (int i = 0; i < 12; ++i)
        {
            var (a, b) = ((i & 1) != 0 ? 1f : -1, (i & 2) != 0 ? golden : -golden);
            vertices.Add(Vector3.Normalize((i / 4) switch { 0 => new(0, a, b), 1 => new(a, b, 0), _ => new Vector3(b, 0, a) }));
        }
        List<int> indices = [];
        for (int i = 0; i < 12; ++i)
        {
            for (int j = i + 1; j < 12; ++j)
            {
                for (int k = j + 1; k < 12; ++k)
                {
                    // Neighbours are as far apart as the edges are long.
                    if (IsEdge(i, j) && IsEdge(j, k) && IsEdge(i, k))
                        indices.AddRange([i, j, k]);
                }
            }
        }
        for (; splits > 0; --splits)
            indices = Split(vertices, indices);
        for (int i = 0; i < indices.Count; i += 3)
        {
            var (a, b, c) = (vertices[indices[i]], vertices[indices[i + 1]], vertices[indices[i + 2]]);
            if (Vector3.Dot(Vector3.Cross(c - a, b - a), a) < 0)
                (indices[i + 1], indices[i + 2]) = (indices[i + 2], indices[i + 1]);
        }
        return new([.. vertices.ConvertAll(vertex => vertex * (1 + roughness * (2 * random.NextSingle() - 1)))], [.. indices]);

        bool IsEdge(int i, int j) => (vertices[i] - vertices[j]).Length() < 1.1f;
    }

    static List<int> Split(List<Vector3> vertices, List<int> indices)
    {
        var middles = new Dictionary<(int, int), int>();
        List<int> result = [];
        for (int i = 0; i < indices.Count; i += 3)
        {
            var (a, b, c) = (indices[i], indices[i + 1], indices[i + 2]);
            var (ab, bc, ca) = (Middle(a, b), Middle(b, c), Middle(c, a));
            result.AddRange([a, ab, ca, b, bc, ab, c, ca, bc, ab, bc, ca]);
        }
        return result;

        int Middle(int i, int j)
        {
            var key = (Math.Min(i, j), Math.Max(i, j));
            if (!middles.TryGetValue(key, out var middle))
            {
                vertices.Add(Vector3.Normalize(vertices[i] + vertices[j]));
                middles.Add(key, middle = vertices.Count - 1);
            }
            return middle;
        }
    }

    /// <summary>Closed prism whose ground is a star, two metres wide and as high: edges that bend in and out by turns.</summary>
    public static MeshSample Star(int tips, float inner)
    {
        var vertices = new List<Vector3> { new(0, -1, 0), new(0, 1, 0) };
        var indices = new List<int>();
        for (int i = 0; i < 2 * tips; ++i)
        {
            var (sine, cosine) = Math.SinCos(Math.PI * i / tips);
            var radius = i % 2 == 0 ? 1 : inner;
            vertices.Add(new((float)(radius * cosine), -1, (float)(radius * sine)));
            vertices.Add(new((float)(radius * cosine), 1, (float)(radius * sine)));
            int low = 2 + 2 * i, high = low + 1, nextLow = 2 + 2 * ((i + 1) % (2 * tips)), nextHigh = nextLow + 1;
            indices.AddRange([0, nextLow, low, 1, high, nextHigh, low, nextLow, high, nextLow, nextHigh, high]);
        }
        return new([.. vertices], [.. indices]);
    }

    /// <summary>Surface of the solid cells of a grid: closed, two triangles for each side of a cell that is next to none.</summary>
    /// <param name="x">Borders of the cells along X, in ascending order, m; the others alike.</param>
    /// <param name="y">Those along Y.</param>
    /// <param name="z">Those along Z.</param>
    /// <param name="isSolid">Whether a cell is solid, by its indices. No two solid cells may meet in an edge alone.</param>
    public static MeshSample Blocks(float[] x, float[] y, float[] z, Func<int, int, int, bool> isSolid)
    {
        float[][] lines = [x, y, z];
        var numbers = new Dictionary<(int, int, int), int>();
        var vertices = new List<Vector3>();
        var indices = new List<int>();
        bool Has(int[] cell) => cell[0] >= 0 && cell[1] >= 0 && cell[2] >= 0 && cell[0] < x.Length - 1 && cell[1] < y.Length - 1 && cell[2] < z.Length - 1
            && isSolid(cell[0], cell[1], cell[2]);
        for (int i = 0; i < (x.Length - 1) * (y.Length - 1) * (z.Length - 1) * 6; ++i)
        {
            int face = i % 6, rest = i / 6;
            int[] cell = [rest % (x.Length - 1), rest / (x.Length - 1) % (y.Length - 1), rest / (x.Length - 1) / (y.Length - 1)];
            int axis = face / 2, upper = face % 2;
            int[] next = [.. cell];
            next[axis] += 2 * upper - 1;
            if (!Has(cell) || Has(next))
                continue;
            int a = Number(0, 0), b = Number(1, 0), c = Number(0, 1), d = Number(1, 1);
            // Clockwise from outside.
            indices.AddRange(upper == 1 ? [a, c, b, b, c, d] : [a, b, c, b, d, c]);

            int Number(int u, int v)
            {
                int[] corner = [.. cell];
                corner[axis] += upper;
                corner[(axis + 1) % 3] += u;
                corner[(axis + 2) % 3] += v;
                var key = (corner[0], corner[1], corner[2]);
                if (!numbers.TryGetValue(key, out var number))
                {
                    vertices.Add(new(lines[0][corner[0]], lines[1][corner[1]], lines[2][corner[2]]));
                    numbers.Add(key, number = vertices.Count - 1);
                }
                return number;
            }
        }
        return new([.. vertices], [.. indices]);
    }
}
