using System;
using System.Linq;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.Collidables.Meshes;

/// <summary>The triangles of a mesh as they are kept.</summary>
public sealed unsafe class MeshTrianglesTests
{
    /// <summary>Up to as many as three bytes can name, and beyond; the neighbours of what is written stay as they were.</summary>
    [Theory]
    [InlineData(1, 3), InlineData(1 << 24, 3), InlineData((1 << 24) + 1, 4), InlineData(3 << 26, 4)]
    public void What_is_written_is_read(int count, int expectedSize)
    {
        Assert.Equal(expectedSize, MeshTriangles.ByteCountOf(count));
        var size = MeshTriangles.TriangleByteCount(count);
        var bytes = new byte[5 * size];
        Array.Fill(bytes, (byte)0xA5);
        fixed (byte* first = bytes)
        {
            var triangles = new MeshTriangles(first, count);
            var last = new MeshTriangle(count - 1, count / 2, 0, count - 1);
            triangles.Set(1, new(0, count - 1, count / 3, count / 5));
            triangles.Set(2, last);
            triangles.SetPlace(first + 3 * size, 1, count - 1);
            Assert.Equal(new(0, count - 1, count / 3, count / 5), triangles.Get(1));
            Assert.Equal((last, count - 1), (triangles.Get(2), triangles.GetNumber(2)));
            Assert.Equal(count - 1, triangles.GetPlace(first + 3 * size, 1));
        }
        Assert.All(bytes.Take(size), value => Assert.Equal(0xA5, value));
        Assert.All(bytes.Skip(3 * size).Take(expectedSize).Concat(bytes.Skip(3 * size + 2 * expectedSize)), value => Assert.Equal(0xA5, value));
    }

    /// <summary>Whatever the order of the tree: each number has the corners that it was given with, those included that are left out.</summary>
    [Fact]
    public void Numbers_and_places_name_each_other()
    {
        using var pool = new BufferPool();
        var soup = MeshSample.Soup(300, 4);
        // Every tenth a line, the last the same as the first.
        var indices = soup.Indices.Select((vertex, i) => i % 30 == 2 ? soup.Indices[i - 1] : vertex).ToArray();
        indices.AsSpan(3, 3).CopyTo(indices.AsSpan(897));
        var mesh = new Mesh(soup.Vertices, indices, Vector3.One, pool);
        var header = mesh.Header;
        Assert.Equal(300, Enumerable.Range(0, 300).Select(i => mesh.Header->GetPlace(i)).Distinct().Count());
        for (int i = 0; i < 300; ++i)
        {
            Assert.Equal(i, header->Triangles.GetNumber(header->GetPlace(i)));
            Assert.Equal(i % 10 == 0 || i == 299, mesh.IsLeftOut(i));
            mesh.GetLocalChild(i, out var child);
            Assert.Equal((soup.Vertices[indices[3 * i]], soup.Vertices[indices[3 * i + 1]], soup.Vertices[indices[3 * i + 2]]), (child.A, child.B, child.C));
        }
        mesh.Dispose(pool);
    }
}
