using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.Collidables.Meshes;

/// <summary>How far surfaces bend at edges, against angles of normals in double precision.</summary>
public sealed class MeshEdgeTests : IDisposable
{
    readonly BufferPool pool = new();

    public void Dispose()
    {
        pool.AssertEmpty();
        pool.Clear();
    }

    static (double X, double Y, double Z) Normal(Vector3 a, Vector3 b, Vector3 c)
    {
        double ux = (double)c.X - a.X, uy = (double)c.Y - a.Y, uz = (double)c.Z - a.Z, vx = (double)b.X - a.X, vy = (double)b.Y - a.Y, vz = (double)b.Z - a.Z;
        double x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx, length = Math.Sqrt(x * x + y * y + z * z);
        return (x / length, y / length, z / length);
    }

    // The angle at edge i of a triangle: zero for a valley, NaN where there is no one neighbour.
    static double Angle(Triangle[] triangles, int number, int edge)
    {
        Vector3[] own = [triangles[number].A, triangles[number].B, triangles[number].C];
        Vector3 start = own[edge], end = own[(edge + 1) % 3];
        var neighbours = new List<(Triangle Triangle, Vector3 Third, bool IsForward)>();
        for (int i = 0; i < triangles.Length; ++i)
        {
            Vector3[] corners = [triangles[i].A, triangles[i].B, triangles[i].C];
            for (int j = 0; j < 3; ++j)
            {
                if (i != number && ((corners[j] == start && corners[(j + 1) % 3] == end) || (corners[j] == end && corners[(j + 1) % 3] == start)))
                    neighbours.Add((triangles[i], corners[(j + 2) % 3], corners[j] == start));
            }
        }
        if (neighbours.Count != 1 || neighbours[0].IsForward)
            return double.NaN;
        var n = Normal(own[0], own[1], own[2]);
        var other = neighbours[0];
        var m = Normal(other.Triangle.A, other.Triangle.B, other.Triangle.C);
        var height = n.X * ((double)other.Third.X - start.X) + n.Y * ((double)other.Third.Y - start.Y) + n.Z * ((double)other.Third.Z - start.Z);
        double x = n.Y * m.Z - n.Z * m.Y, y = n.Z * m.X - n.X * m.Z, z = n.X * m.Y - n.Y * m.X;
        return height > 0 ? 0 : Math.Atan2(Math.Sqrt(x * x + y * y + z * z), n.X * m.X + n.Y * m.Y + n.Z * m.Z);
    }

    [Theory]
    [InlineData(1, 1, 1), InlineData(2.5f, 2.5f, 2.5f), InlineData(1, 3, .4f), InlineData(-1, 1, 1), InlineData(-2, .5f, 1), InlineData(-1, -2, -3)]
    public void Cones_are_those_of_the_neighbours_at_any_scale(float x, float y, float z)
    {
        var bent = 0;
        var free = 0;
        foreach (var sample in new[] { MeshSample.Terrain(8, 2), MeshSample.Box(new(1, 2, 3)), MeshSample.Torus(3, 1, 12, 7) })
        {
            var mesh = new Mesh(sample.Vertices, sample.Indices, new(x, y, z), pool);
            var triangles = new Triangle[mesh.ChildCount];
            for (int i = 0; i < triangles.Length; ++i)
                mesh.GetLocalChild(i, out triangles[i]);
            for (int i = 0; i < triangles.Length; ++i)
            {
                mesh.GetCone(i, out var cone);
                for (int edge = 0; edge < 3; ++edge)
                {
                    var expected = Angle(triangles, i, edge);
                    Assert.Equal(double.IsNaN(expected), (cone.FreeMask >> edge & 1) != 0);
                    if (double.IsNaN(expected))
                    {
                        ++free;
                        continue;
                    }
                    var angle = Math.Atan2(cone.Sines[edge], cone.Cosines[edge]);
                    bent += expected > .01 ? 1 : 0;
                    // A byte is a step: d(q / 254)^2 pi is 2 sqrt(angle pi) / 254. Before scaling, which multiplies it by the ratio of the factors
                    // squared at most.
                    var ratio = Math.Max(Math.Abs(x), Math.Max(Math.Abs(y), Math.Abs(z))) / Math.Min(Math.Abs(x), Math.Min(Math.Abs(y), Math.Abs(z)));
                    var step = (2 * Math.Sqrt(Math.PI * Math.PI) / 254 + 1e-3) * ratio * ratio;
                    Assert.InRange(angle, expected - Math.Min(step, ratio == 1 ? 2 * Math.Sqrt((expected + .01) * Math.PI) / 254 + 1e-4 : step),
                        expected + 1e-6);
                }
            }
            mesh.Dispose(pool);
        }
        Assert.True(bent > 100 && free > 20, $"{bent} bent, {free} free");
    }

    Mesh Build(Vector3[] vertices, params int[] indices) => new(vertices, indices, Vector3.One, pool);

    static readonly Vector3[] fan = [new(0, 0, 0), new(1, 0, 0), new(0, 0, 1), new(1, 0, 1), new(.5f, 1, .2f)];

    [Fact]
    public void Edges_of_three_triangles_of_flipped_ones_and_borders_are_free_and_counted()
    {
        var flat = Build(fan, 0, 1, 2, 1, 3, 2);
        Assert.Equal((1, 4, 0, 0), Counts(flat));
        flat.GetCone(0, out var cone);
        Assert.Equal((0b101, 1f, 0f), (cone.FreeMask, cone.Cosines.Y, cone.Sines.Y));
        var flipped = Build(fan, 0, 1, 2, 1, 2, 3);
        Assert.Equal((0, 4, 1, 0), Counts(flipped));
        var crowded = Build(fan, 0, 1, 2, 1, 3, 2, 1, 2, 4);
        Assert.Equal((0, 6, 0, 1), Counts(crowded));
        foreach (var mesh in new[] { flat, flipped, crowded })
            mesh.Dispose(pool);
    }

    static (int, int, int, int) Counts(in Mesh mesh) =>
        (mesh.Report.SharedEdgeCount, mesh.Report.BorderEdgeCount, mesh.Report.FlippedEdgeCount, mesh.Report.CrowdedEdgeCount);

    [Fact]
    public void Duplicates_in_any_rotation_are_left_out_and_their_neighbours_know_each_other()
    {
        var mesh = Build(fan, 0, 1, 2, 1, 2, 0, 1, 3, 2, 2, 1, 3, 3, 2, 1);
        Assert.Equal((1, 4, 0, 0), Counts(mesh));
        Assert.Equal(3, mesh.Report.DuplicateTriangleCount);
        Assert.Equal([false, true, false, true, true], Enumerable.Range(0, 5).Select(i => mesh.IsLeftOut(i)));
        mesh.Dispose(pool);
    }

    [Fact]
    public void The_two_sides_of_a_plate_bend_by_half_a_turn()
    {
        var mesh = Build(fan, 0, 1, 2, 0, 2, 1);
        Assert.True(mesh.Report.IsClosed);
        mesh.GetCone(0, out var cone);
        Assert.Equal(0, cone.FreeMask);
        // Rounded down by a step at most, which is a degree and a half there.
        for (int edge = 0; edge < 3; ++edge)
            Assert.InRange(cone.Cosines[edge], -1, -.9995f);
        mesh.Dispose(pool);
    }

    [Fact]
    public void A_hundred_thousand_triangles_at_one_edge_are_no_neighbours()
    {
        const int Count = 100_000;
        var vertices = new Vector3[Count + 2];
        var indices = new int[3 * Count];
        vertices[1] = Vector3.UnitY;
        for (int i = 0; i < Count; ++i)
        {
            var angle = 2 * Math.PI * i / Count;
            vertices[i + 2] = new((float)Math.Cos(angle) * 10, .5f, (float)Math.Sin(angle) * 10);
            (indices[3 * i], indices[3 * i + 1], indices[3 * i + 2]) = (0, 1, i + 2);
        }
        var mesh = Build(vertices, indices);
        Assert.Equal((0, 2 * Count, 0, 1), Counts(mesh));
        mesh.Dispose(pool);
    }
}
