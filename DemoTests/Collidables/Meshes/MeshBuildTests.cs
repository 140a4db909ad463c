using System;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuUtilities.Collections;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.Collidables.Meshes;

/// <summary>Good, odd and bad input of meshes.</summary>
public sealed class MeshBuildTests : IDisposable
{
    readonly BufferPool pool = new();

    public void Dispose()
    {
        pool.AssertEmpty();
        pool.Clear();
    }

    [Fact]
    public void The_buffer_of_triangles_goes_back_to_the_pool_and_each_triangle_keeps_its_number()
    {
        var sample = MeshSample.Soup(50, 4);
        pool.Take<Triangle>(50, out var triangles);
        for (int i = 0; i < 50; ++i)
            triangles[i] = new(sample.Vertices[3 * i], sample.Vertices[3 * i + 1], sample.Vertices[3 * i + 2]);
        var mesh = new Mesh(triangles, new(1, 2, -3), pool);
        for (int i = 0; i < 50; ++i)
        {
            mesh.GetLocalChild(i, out var child);
            var scale = new Vector3(1, 2, -3);
            // A mirror image: the front is that of the image.
            Assert.Equal((sample.Vertices[3 * i] * scale, sample.Vertices[3 * i + 2] * scale, sample.Vertices[3 * i + 1] * scale), (child.A, child.B, child.C));
            mesh.GetPosedLocalChild(i, out var centered, out var pose);
            Assert.InRange((centered.B + pose.Position - child.B).Length(), 0, 1e-5f);
            Assert.InRange((centered.A + centered.B + centered.C).Length(), 0, 1e-5f);
        }
        mesh.Dispose(pool);
    }

    [Fact]
    public void Corners_with_equal_coordinates_are_one_vertex_and_unused_ones_none()
    {
        var mesh = new Mesh([new(0, 0, 0), new(1, 0, 0), new(0, 0, 1), new(-0f, 0, -0f), new(1, 0, 1), new(9, 9, 9)], [0, 1, 2, 1, 4, 2, 3, 2, 1],
            Vector3.One, pool, [5, 6, 7]);
        Assert.Equal((4, 3, 6), (mesh.VertexCount, mesh.ChildCount, mesh.GetMaterial(1)));
        mesh.Dispose(pool);
    }

    [Theory]
    [InlineData("triangle 3")]
    public void Bad_corners_are_refused_by_name_and_nothing_stays_taken(string name)
    {
        foreach (var bad in new[] { float.NaN, float.PositiveInfinity, 2e7f })
        {
            var sample = MeshSample.Soup(10, 4);
            sample.Vertices[10].Y = bad;
            var triangles = Enumerable.Range(0,
                10).Select(i => new Triangle(sample.Vertices[3 * i], sample.Vertices[3 * i + 1], sample.Vertices[3 * i + 2])).ToArray();
            foreach (var attempt in new Action[] { () => _ = new Mesh(sample.Vertices, sample.Indices, Vector3.One, pool),
                () => _ = new Mesh(triangles, Vector3.One, pool) })
            {
                var message = Assert.Throws<ArgumentException>(attempt).Message;
                Assert.Contains(name, message, StringComparison.Ordinal);
                Assert.Contains(sample.Vertices[10].ToString(), message, StringComparison.Ordinal);
                pool.AssertEmpty();
            }
        }
    }

    [Fact]
    public void Bad_counts_indices_and_scales_are_refused()
    {
        var sample = MeshSample.Soup(10, 4);
        foreach (var index in new[] { -1, 30, int.MinValue })
        {
            sample.Indices[17] = index;
            Assert.Contains($"triangle 5 has vertex {index}",
                Assert.Throws<ArgumentException>(() => new Mesh(sample.Vertices, sample.Indices, Vector3.One, pool)).Message, StringComparison.Ordinal);
        }
        sample.Indices[17] = 17;
        Assert.Throws<ArgumentException>(() => new Mesh(sample.Vertices, sample.Indices.AsSpan()[..29], Vector3.One, pool));
        Assert.Throws<ArgumentException>(() => new Mesh(sample.Vertices, [], Vector3.One, pool));
        Assert.Throws<ArgumentException>(() => new Mesh(default(Buffer<Triangle>), Vector3.One, pool));
        Assert.Throws<ArgumentException>(() => new Mesh(sample.Vertices, sample.Indices, Vector3.One, pool, new byte[9]));
        foreach (var scale in new[] { new Vector3(0, 1, 1), new(1, float.NaN, 1), new(1, 1, float.PositiveInfinity) })
        {
            Assert.Throws<ArgumentOutOfRangeException>(() => new Mesh(sample.Vertices, sample.Indices, scale, pool));
            var mesh = new Mesh(sample.Vertices, sample.Indices, Vector3.One, pool);
            Assert.Throws<ArgumentOutOfRangeException>(() => mesh.Scale = scale);
            Assert.Equal(Vector3.One, mesh.Scale);
            mesh.Dispose(pool);
        }
        Assert.Throws<ArgumentException>(() => default(Mesh).Validate());
        pool.AssertEmpty();
    }

    [Fact]
    public void Too_many_triangles_are_refused_before_any_is_looked_at()
    {
        // A view of that many triangles that are not there.
        unsafe
        {
            var triangles = new Buffer<Triangle>((void*)64, (1 << 26) + 1);
            var message = Assert.Throws<ArgumentException>(() => new Mesh(triangles, Vector3.One, pool)).Message;
            Assert.Contains("67108865", message, StringComparison.Ordinal);
        }
    }

    [Fact]
    public void Triangles_without_a_surface_are_left_out_and_a_mesh_of_nothing_else_is_refused()
    {
        Vector3[] vertices = [new(0, 0, 0), new(1, 0, 0), new(2, 0, 0), new(0, 0, 1), new(1, 0, 1e-6f)];
        var mesh = new Mesh(vertices, [0, 1, 2, 0, 1, 3, 0, 0, 3, 0, 1, 4], Vector3.One, pool);
        Assert.Equal(3, mesh.Report.DegenerateTriangleCount);
        var found = new QuickList<int>(4, pool);
        mesh.FindLocalOverlaps(new(-9), new(9), ref found, pool);
        Assert.Equal([1], found.AsSpan().ToArray());
        found.Dispose(pool);
        mesh.Dispose(pool);
        Assert.Contains("triangle 0", Assert.Throws<ArgumentException>(() => new Mesh(vertices, [0, 1, 2], Vector3.One, pool)).Message,
            StringComparison.Ordinal);
    }

    public static TheoryData<string> OddSets => ["equal", "line", "point", "huge"];

    /// <summary>
    /// A tree that is built from the top down looks at each triangle once on each level above it: the sum of depths is its work. Time itself is a benchmark's.
    /// </summary>
    [Theory, MemberData(nameof(OddSets))]
    public void Odd_sets_of_triangles_have_a_low_tree_for_no_more_than_three_times_the_work_of_a_grid(string kind)
    {
        const int Count = 100_000;
        var vertices = new Vector3[3 * Count];
        for (int i = 0; i < Count; ++i)
        {
            var offset = kind switch { "line" => new Vector3(i * .01f, 0, 0), "huge" => new Vector3(i % 300 * .01f, 0, i / 300 * .01f), _ => default };
            // At one place, but no two with the same corners.
            var turn = 2 * Math.PI * i / Count;
            var side = kind == "point" ? new Vector3((float)Math.Cos(turn), 0, (float)Math.Sin(turn)) : new(1e-3f, 0, kind == "equal" ? 1e-3f + 1e-8f * i : 0);
            if (kind == "huge" && i == 0)
                side = new(1e5f, 0, 0);
            (vertices[3 * i], vertices[3 * i + 1], vertices[3 * i + 2]) = (offset, offset + side, offset + new Vector3(0, 1e-3f, 1e-3f));
        }
        var grid = MeshSample.Terrain(224);
        var (_, gridDepth) = Build(grid.Vertices, grid.Indices);
        var (height, depth) = Build(vertices, [.. Enumerable.Range(0, 3 * Count)]);
        Assert.InRange(height, 1, 64);
        Assert.InRange(depth, 0, 3 * gridDepth);
    }

    /// <summary>Height of the tree of a mesh and the mean number of nodes above a triangle; all triangles are in it.</summary>
    (int Height, double Depth) Build(Vector3[] vertices, int[] indices)
    {
        var mesh = new Mesh(vertices, indices, Vector3.One, pool);
        var found = new QuickList<int>(4, pool);
        mesh.FindLocalOverlaps(new(-1e6f), new(1e6f), ref found, pool);
        Assert.Equal(mesh.ChildCount - mesh.Report.DegenerateTriangleCount - mesh.Report.DuplicateTriangleCount, found.Count);
        Assert.Equal(found.Count, found.AsSpan().ToArray().Distinct().Count());
        var (height, depths) = Depths(mesh, 0, 1);
        var depth = depths / (double)found.Count;
        found.Dispose(pool);
        mesh.Dispose(pool);
        return (height, depth);
    }

    /// <summary>Greatest depth below a node, and the sum over triangles below it.</summary>
    static unsafe (int Height, long Sum) Depths(in Mesh mesh, int node, int depth)
    {
        var (height, sum) = (depth, 0L);
        ref var boxes = ref mesh.Header->Nodes[node];
        for (int child = 0; child < MeshNode.Width; ++child)
        {
            // A child that is a node has no triangles of its own.
            sum += boxes.TriangleCount(child) * depth;
            if ((boxes.NodeMask >> child & 1) != 0)
            {
                var below = Depths(mesh, boxes.Node(child), depth + 1);
                (height, sum) = (Math.Max(height, below.Height), sum + below.Sum);
            }
        }
        return (height, sum);
    }

    [Fact]
    public void Shapes_take_meshes_and_dispose_them()
    {
        var shapes = new Shapes(pool, 4);
        var sample = MeshSample.Box(new(1, 2, 3));
        var index = shapes.Add(new Mesh(sample.Vertices, sample.Indices, Vector3.One, pool));
        Assert.Equal(Mesh.Id, index.Type);
        shapes.UpdateBounds(new RigidPose(new(1, 1, 1)), index, out var bounds);
        Assert.Equal((new Vector3(0, -1, -2), new Vector3(2, 3, 4)), (bounds.Min, bounds.Max));
        shapes.RemoveAndDispose(index, pool);
        shapes.Dispose();
    }
}
