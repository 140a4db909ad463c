using System;
using System.Linq;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Memory;
using DemoTests.Support;
using Xunit;

namespace DemoTests.Collidables.Meshes;

/// <summary>Which triangles a box finds, against every triangle of the mesh.</summary>
public sealed class MeshQueryTests : IDisposable
{
    readonly BufferPool pool = new();

    public void Dispose()
    {
        pool.AssertEmpty();
        pool.Clear();
    }

    static readonly Vector3[] scales = [Vector3.One, new(2), new(.3f, 5, 1.7f), new(-1, 1, 1), new(-.01f, -3, -7)];

    [Theory]
    [InlineData(1), InlineData(2), InlineData(3), InlineData(7), InlineData(8), InlineData(9), InlineData(65), InlineData(1000)]
    public void A_box_finds_those_triangles_whose_boxes_it_meets(int triangleCount)
    {
        foreach (var scale in scales)
            Compare(MeshSample.Soup(triangleCount, triangleCount), scale, queryCount: 400, isExact: scale == Vector3.One);
    }

    [Fact]
    public void So_it_does_in_a_mesh_of_a_hundred_thousand() => Compare(MeshSample.Terrain(224), new(1, -1, 1), queryCount: 40, isExact: true);

    [Theory, InlineData(1e-3f, 1e4f), InlineData(1e6f, 1e-2f), InlineData(8e6f, 1e5f)]
    public void So_it_does_far_away_and_in_the_small(float distance, float size)
    {
        var sample = MeshSample.Soup(200, 5, size * 10, size).Moved(new(distance, -distance, distance / 3));
        Compare(sample, Vector3.One, queryCount: 400, isExact: true);
    }

    // What the mesh finds must hold all that the doubles find, and, unless corners were rounded by a scale, nothing else.
    void Compare(MeshSample sample, Vector3 scale, int queryCount, bool isExact)
    {
        var mesh = new Mesh(sample.Vertices, sample.Indices, scale, pool);
        var random = new Random(LevelSeeds.Of(17));
        mesh.ComputeBounds(Quaternion.Identity, out var low, out var high);
        var found = new QuickList<int>(4, pool);
        var total = 0;
        for (int i = 0; i < queryCount; ++i)
        {
            var size = (high - low) * (float)Math.Pow(10, -3 * random.NextDouble());
            var min = low - size + (high - low + size) * new Vector3((float)random.NextDouble(), (float)random.NextDouble(), (float)random.NextDouble());
            var max = min + size;
            // Every other one touches a corner exactly.
            if (i % 2 == 0)
            {
                mesh.GetLocalChild(random.Next(sample.TriangleCount), out var child);
                max = child.A;
                min = max - size;
            }
            found.Count = 0;
            mesh.FindLocalOverlaps(min, max, ref found, pool);
            var actual = found.AsSpan().ToArray().Order().ToArray();
            var expected = Enumerable.Range(0, sample.TriangleCount).Where(triangle => !mesh.IsLeftOut(triangle) &&
                Overlaps(mesh, triangle, min, max)).ToArray();
            total += expected.Length;
            if (isExact)
                Assert.Equal(expected, actual);
            else
                Assert.Empty(expected.Except(actual));
            Assert.Equal(actual.Length, actual.Distinct().Count());
        }
        Assert.True(total > queryCount / 4, $"{total} found by {queryCount} boxes");
        found.Dispose(pool);
        mesh.Dispose(pool);
    }

    static bool Overlaps(in Mesh mesh, int triangle, Vector3 min, Vector3 max)
    {
        mesh.GetLocalChild(triangle, out var child);
        for (int axis = 0; axis < 3; ++axis)
        {
            double a = child.A[axis], b = child.B[axis], c = child.C[axis];
            if (Math.Max(a, Math.Max(b, c)) < min[axis] || Math.Min(a, Math.Min(b, c)) > max[axis])
                return false;
        }
        return true;
    }

    [Fact]
    public void A_mesh_is_at_most_32_bytes_for_each_triangle_of_a_terrain()
    {
        var sample = MeshSample.Terrain(100);
        var mesh = new Mesh(sample.Vertices, sample.Indices, Vector3.One, pool);
        Assert.InRange(mesh.ByteCount / (double)mesh.ChildCount, 15, 32);
        mesh.Dispose(pool);
    }

    [Fact]
    public void Bounds_hold_all_corners_in_every_orientation()
    {
        var random = new Random(LevelSeeds.Of(3));
        foreach (var scale in scales)
        {
            var sample = MeshSample.Soup(300, 8).Moved(new(4, -30, 2));
            var mesh = new Mesh(sample.Vertices, sample.Indices, scale, pool);
            mesh.ComputeAngularExpansionData(out var radius, out var expansion);
            for (int i = 0; i < 50; ++i)
            {
                var orientation = Quaternion.Normalize(new(
                    (float)random.NextDouble() - .5f, (float)random.NextDouble() - .5f, (float)random.NextDouble() - .5f, (float)random.NextDouble() - .5f));
                mesh.ComputeBounds(orientation, out var min, out var max);
                mesh.ComputeBounds(Quaternion.Identity, out var low, out var high);
                foreach (var vertex in sample.Vertices)
                {
                    var placed = Exact.Rotate(vertex * scale, orientation);
                    Assert.True(Vector3.LessThanOrEqualAll(min, placed) && Vector3.LessThanOrEqualAll(placed, max), $"{placed} is not from {min} to {max}");
                    Assert.True((vertex * scale).Length() <= radius * 1.000001f);
                    // Nowhere does the surface get farther beyond the box of another orientation.
                    Assert.True(Vector3.LessThanOrEqualAll(placed, high + new Vector3(expansion)));
                    Assert.True(Vector3.LessThanOrEqualAll(low - new Vector3(expansion), placed));
                }
            }
            mesh.Dispose(pool);
        }
    }
}
