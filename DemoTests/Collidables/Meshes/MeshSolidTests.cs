using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuUtilities.Memory;
using Demos.References;
using DemoTests.Support;
using Xunit;

namespace DemoTests.Collidables.Meshes;

/// <summary>The inside of solid meshes, and the ways out of it, against all triangles in doubles.</summary>
public sealed class MeshSolidTests : IDisposable
{
    readonly BufferPool pool = new();

    public void Dispose()
    {
        pool.AssertEmpty();
        pool.Clear();
    }

    public static TheoryData<string> Names => [.. Samples.Keys];

    static Dictionary<string, MeshSample> Samples { get; } = new()
    {
        ["box"] = MeshSample.Box(new(1, .7f, 1.3f)),
        ["ball"] = MeshSample.Ball(2),
        ["rough ball"] = MeshSample.Ball(2, .12f, 5),
        ["ring"] = MeshSample.Torus(1, .4f, 14, 8),
        ["star"] = MeshSample.Star(5, .4f),
        ["corner"] = MeshSample.Blocks([-1, 0, 1], [-1, 0, 1], [-1, 0, 1], (x, y, z) => x + y + z < 3),
        ["far away"] = MeshSample.Torus(1, .4f, 14, 8).Moved(new(100, 50, -70)),
    };

    // How often a surface goes around a point: the sum of the angles under which its triangles are seen, over that of all directions (van Oosterom and
    // Strackee 1983). One inside of a closed surface, zero outside.
    static double WindingNumber(Double3[] corners, Double3 point)
    {
        double angle = 0;
        for (int i = 0; i < corners.Length; i += 3)
        {
            Double3 a = corners[i] - point, b = corners[i + 1] - point, c = corners[i + 2] - point;
            double lengthA = a.Length, lengthB = b.Length, lengthC = c.Length;
            angle += 2 * Math.Atan2(Double3.Dot(a, Double3.Cross(c, b)),
                lengthA * lengthB * lengthC + Double3.Dot(a, b) * lengthC + Double3.Dot(b, c) * lengthA + Double3.Dot(c, a) * lengthB);
        }
        return angle / (4 * Math.PI);
    }

    static double DistanceToSegment(Double3 a, Double3 b)
    {
        var along = b - a;
        var t = Math.Clamp(-Double3.Dot(a, along) / Double3.Dot(along, along), 0, 1);
        return (a + along * t).Length;
    }

    static double Distance(Double3[] corners, int triangle, Double3 point)
    {
        Double3 a = corners[3 * triangle] - point, b = corners[3 * triangle + 1] - point, c = corners[3 * triangle + 2] - point;
        var least = Math.Min(DistanceToSegment(a, b), Math.Min(DistanceToSegment(b, c), DistanceToSegment(c, a)));
        var normal = Double3.Cross(b - a, c - a);
        var isOver = Double3.Dot(Double3.Cross(a, b), normal) >= 0 && Double3.Dot(Double3.Cross(b, c), normal) >= 0 &&
            Double3.Dot(Double3.Cross(c, a), normal) >= 0;
        return isOver ? Math.Min(least, Math.Abs(Double3.Dot(a, normal)) / normal.Length) : least;
    }

    [Theory, MemberData(nameof(Names))]
    public void The_way_out_is_the_shortest_and_only_for_what_is_inside(string name)
    {
        var sample = Samples[name];
        var random = new Random(LevelSeeds.Of(41));
        foreach (var scale in (ReadOnlySpan<Vector3>)[Vector3.One, new(1.5f, -.3f, 2), new(-.01f, -.02f, .01f)])
        {
            IContainer mesh = new Mesh(sample.Vertices, sample.Indices, scale, pool) { Solid = true };
            var corners = new Double3[sample.Indices.Length];
            for (int i = 0; i < sample.TriangleCount; ++i)
            {
                ((Mesh)mesh).GetLocalChild(i, out var triangle);
                (corners[3 * i], corners[3 * i + 1], corners[3 * i + 2]) = ((Double3)triangle.A, (Double3)triangle.B, (Double3)triangle.C);
            }
            var extent = corners.Max(corner => corner.Length);
            var min = new Vector3(corners.Min(corner => (float)corner.X), corners.Min(corner => (float)corner.Y), corners.Min(corner => (float)corner.Z));
            var max = new Vector3(corners.Max(corner => (float)corner.X), corners.Max(corner => (float)corner.Y), corners.Max(corner => (float)corner.Z));
            var insideCount = 0;
            for (int i = 0; i < 400; ++i)
            {
                // A little beyond the bounds too; every other point on a plane on which edges and corners are.
                var place = new Vector3(random.NextSingle(), random.NextSingle(), random.NextSingle()) * 1.1f - new Vector3(.05f);
                var point = min + (max - min) * place;
                if (i % 2 == 0)
                    point.Y = (min.Y + max.Y) * .5f;
                var distance = Enumerable.Range(0, sample.TriangleCount).Min(triangle => Distance(corners, triangle, (Double3)point));
                // Nearer to the surface than this floats do not tell on which side.
                if (distance < 4e-6 * extent)
                    continue;
                var isInside = WindingNumber(corners, (Double3)point) > .5;
                Assert.Equal(isInside, mesh.FindWayOut(point, out var way));
                if (!isInside)
                    continue;
                ++insideCount;
                Assert.Equal(1, way.Normal.Length(), 1e-5);
                Assert.InRange(Distance(corners, way.Child, (Double3)point), 0, distance + 4e-6 * extent);
                Assert.InRange(Distance(corners, way.Child, (Double3)way.Place), 0, 4e-6 * extent);
                Assert.Equal(distance, Double3.Dot((Double3)way.Place - (Double3)point, (Double3)way.Normal), 4e-6 * extent);
            }
            Assert.InRange(insideCount, 40, 399);
            ((Mesh)mesh).Dispose(pool);
        }
    }

    [Fact]
    public void Only_what_has_an_inside_can_be_solid()
    {
        var terrain = MeshSample.Terrain(4);
        var open = new Mesh(terrain.Vertices, terrain.Indices, Vector3.One, pool);
        Assert.Contains("edges of one triangle only", Assert.Throws<InvalidOperationException>(() => open.Solid = true).Message);
        Assert.False(open.Solid);
        var ball = MeshSample.Ball(1);
        var insideOut = new Mesh(ball.Vertices, [.. ball.Indices.Reverse()], Vector3.One, pool);
        Assert.Throws<ArgumentException>(() => insideOut.Solid = true);
        Assert.False(insideOut.Solid);
        Assert.Throws<ArgumentException>(() =>
        {
            var none = default(Mesh);
            none.Solid = true;
        });
        open.Dispose(pool);
        insideOut.Dispose(pool);
    }

    [Fact]
    public void A_solid_mesh_is_solid_when_it_is_loaded_and_an_open_one_that_says_so_is_refused()
    {
        var ball = MeshSample.Ball(1);
        var mesh = new Mesh(ball.Vertices, ball.Indices, Vector3.One, pool) { Solid = true };
        var bytes = new byte[mesh.GetSerializedByteCount()];
        mesh.Serialize(bytes);
        var loaded = new Mesh((ReadOnlySpan<byte>)bytes, pool);
        Assert.True(loaded.Solid);
        Assert.False(loaded.TwoSided);
        loaded.Dispose(pool);
        mesh.Dispose(pool);

        var terrain = MeshSample.Terrain(4);
        var open = new Mesh(terrain.Vertices, terrain.Indices, Vector3.One, pool);
        bytes = new byte[open.GetSerializedByteCount()];
        open.Serialize(bytes);
        open.Dispose(pool);
        bytes[24] = 2;
        var hash = new BepuUtilities.Diagnostics.StateHash();
        hash.Add(bytes.AsSpan(0, 4));
        hash.Add(bytes.AsSpan(12));
        BitConverter.TryWriteBytes(bytes.AsSpan(4), hash.Value);
        Assert.Contains("not closed", Assert.Throws<ArgumentException>(() => new Mesh((ReadOnlySpan<byte>)bytes, pool)).Message);
    }
}
