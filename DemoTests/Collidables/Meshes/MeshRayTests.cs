using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Trees;
using BepuUtilities.Memory;
using DemoTests.Support;
using Xunit;

namespace DemoTests.Collidables.Meshes;

/// <summary>Rays against a mesh and against each of its triangles alone.</summary>
public sealed class MeshRayTests : IDisposable
{
    readonly BufferPool pool = new();
    readonly Random random = new(LevelSeeds.Of(29));

    public void Dispose()
    {
        pool.AssertEmpty();
        pool.Clear();
    }

    Vector3 Next(float range) => new(
        ((float)random.NextDouble() * 2 - 1) * range, ((float)random.NextDouble() * 2 - 1) * range, ((float)random.NextDouble() * 2 - 1) * range);

    // The nearest of all, the lowest number of those at one place.
    static bool FindNearest(in Mesh mesh, in RigidPose pose, Vector3 origin, Vector3 direction, out float nearest, out Vector3 normal, out int number)
    {
        nearest = float.MaxValue;
        number = -1;
        normal = default;
        for (int i = 0; i < mesh.ChildCount; ++i)
        {
            mesh.GetLocalChild(i, out var child);
            if (mesh.IsLeftOut(i) || !child.RayTest(pose, origin, direction, out var t, out var n) || !(t < nearest))
                continue;
            (nearest, normal, number) = (t, n, i);
        }
        return number >= 0;
    }

    [Theory]
    [InlineData(1, 1, 1, false), InlineData(2, 2, 2, true), InlineData(-1, 1, 1, false), InlineData(.5f, -3, 2, true), InlineData(-2, -2, -2, false)]
    public void A_ray_hits_what_it_hits_first_of_all_triangles(float x, float y, float z, bool twoSided)
    {
        var hits = 0;
        foreach (var sample in new[] { MeshSample.Soup(300, 2), MeshSample.Terrain(14), MeshSample.Torus(3, 1, 20, 12), MeshSample.Soup(5, 9) })
        {
            var mesh = new Mesh(sample.Vertices, sample.Indices, new(x, y, z), pool) { TwoSided = twoSided };
            for (int i = 0; i < 1500; ++i)
            {
                var pose = new RigidPose(Next(20), Quaternion.Normalize(new(Next(1), .3f)));
                var origin = pose.Position + Next(15);
                mesh.GetLocalChild(random.Next(mesh.ChildCount), out var child);
                // At a corner, at the middle of an edge, along an edge, into a triangle, anywhere.
                var aim = (i % 5) switch { 0 => child.A, 1 => (child.A + child.B) / 2, 2 => child.B, 3 => (child.A + child.B + child.C) / 3, _ => Next(10) };
                if (i % 5 == 2)
                    origin = pose.Position + Vector3.Transform(child.A, pose.Orientation);
                var direction = (pose.Position + Vector3.Transform(aim, pose.Orientation) - origin) * (float)Math.Pow(10, random.NextDouble() * 6 - 3);
                var expected = FindNearest(mesh, pose, origin, direction, out var nearest, out var normal, out var number);
                Assert.Equal(expected, mesh.RayTest(pose, origin, direction, float.MaxValue, out var t, out var actualNormal, out var triangle));
                if (!expected)
                    continue;
                ++hits;
                Assert.Equal(number, triangle);
                Assert.Equal(nearest, t);
                Assert.InRange((normal - actualNormal).Length(), 0, 1e-6f);
                Assert.True(mesh.RayTest(pose, origin, direction, t, out _, out _, out var again) && again == triangle);
                Assert.False(mesh.RayTest(pose, origin, direction, MathF.BitDecrement(t), out _, out _, out var nearer) && nearer == triangle);
            }
            mesh.Dispose(pool);
        }
        Assert.InRange(hits, 1000, 6000);
    }

    /// <summary>Along an axis, or so nearly that one over a component of the direction is beyond all floats: boxes are left out by the others.</summary>
    [Theory]
    [InlineData(1, 1, 1), InlineData(2, -1, .01f), InlineData(-3, -3, -3), InlineData(1e-4f, 1e4f, 1)]
    public void A_ray_along_an_axis_hits_what_it_hits_first_of_all_triangles(float x, float y, float z)
    {
        var hits = 0;
        var scale = new Vector3(x, y, z);
        foreach (var sample in new[] { MeshSample.Terrain(14), MeshSample.Torus(3, 1, 20, 12), MeshSample.Soup(300, 2) })
        {
            var mesh = new Mesh(sample.Vertices, sample.Indices, scale, pool) { TwoSided = true };
            for (int i = 0; i < 900; ++i)
            {
                mesh.GetLocalChild(random.Next(mesh.ChildCount), out var child);
                var aim = (i & 1) == 0 ? child.A : (child.A + child.B + child.C) / 3;
                var small = (i / 6 % 4) switch { 0 => 0, 1 => 1e-30f, 2 => -1e-38f, _ => 1e-12f };
                var direction = new Vector3(small, -small, small);
                direction[i % 3] = (i / 3 & 1) == 0 ? 1 : -1;
                var origin = aim - direction * (float)Math.Pow(10, random.NextDouble() * 4 - 1);
                var expected = FindNearest(mesh, RigidPose.Identity, origin, direction, out var nearest, out _, out var number);
                Assert.Equal(expected, mesh.RayTest(RigidPose.Identity, origin, direction, float.MaxValue, out var t, out _, out var triangle));
                if (!expected)
                    continue;
                ++hits;
                Assert.Equal((number, nearest), (triangle, t));
            }
            mesh.Dispose(pool);
        }
        Assert.InRange(hits, 1000, 2700);
    }

    [Fact]
    public void No_ray_gets_out_of_a_closed_mesh()
    {
        var sample = MeshSample.Torus(3, 1, 48, 32);
        var mesh = new Mesh(sample.Vertices, sample.Indices, new(1, .7f, 1.3f), pool) { TwoSided = true };
        Assert.True(mesh.Report.IsClosed);
        var pose = new RigidPose(new(100, -3, 7), Quaternion.Normalize(new(.3f, .2f, -.5f, .7f)));
        for (int i = 0; i < 50_000; ++i)
        {
            // From within the tube to a corner, to a place on an edge, anywhere.
            var u = random.NextDouble() * 2 * Math.PI;
            var inside = new Vector3(3 * (float)Math.Cos(u), 0, 3 * 1.3f * (float)Math.Sin(u)) + Next(.3f);
            mesh.GetLocalChild(random.Next(mesh.ChildCount), out var child);
            var aim = (i % 3) switch { 0 => child.A, 1 => Vector3.Lerp(child.A, child.B, (float)random.NextDouble()), _ => Next(10) };
            var origin = pose.Position + Vector3.Transform(inside, pose.Orientation);
            Assert.True(mesh.RayTest(pose, origin, Vector3.Transform(aim - inside, pose.Orientation), float.MaxValue, out _, out _, out _), $"ray {i} got out");
        }
        mesh.Dispose(pool);
    }

    struct AllHits(int excluded) : IShapeRayHitHandler
    {
        public ulong Triangles;
        readonly int excluded = excluded;

        public readonly bool AllowTest(int childIndex) => childIndex != excluded;

        public void OnRayHit(in RayData ray, ref float maximumT, float t, Vector3 normal, int childIndex) => Triangles |= 1ul << childIndex;
    }

    [Fact]
    public void A_handler_that_lowers_nothing_hears_of_all_hits_that_it_allows()
    {
        var vertices = new Vector3[60];
        var indices = new int[60];
        for (int i = 0; i < 20; ++i)
        {
            (vertices[3 * i], vertices[3 * i + 1], vertices[3 * i + 2]) = (new(-1, i, -1), new(3, i, -1), new(-1, i, 3));
            (indices[3 * i], indices[3 * i + 1], indices[3 * i + 2]) = (3 * i, 3 * i + 1, 3 * i + 2);
        }
        var mesh = new Mesh(vertices, indices, Vector3.One, pool);
        var handler = new AllHits(7);
        var maximumT = 12.5f;
        mesh.RayTest(RigidPose.Identity, new RayData { Origin = new(0, 30, 0), Direction = new(0, -2, 0) }, ref maximumT, pool, ref handler);
        // Down to y = 5.
        Assert.Equal(0xFFFFFul & ~0x1Ful & ~(1ul << 7), handler.Triangles);
        mesh.Dispose(pool);
    }

    [Fact]
    public void Rays_without_a_direction_or_with_one_that_is_no_number_hit_nothing()
    {
        var sample = MeshSample.Box(Vector3.One);
        var mesh = new Mesh(sample.Vertices, sample.Indices, Vector3.One, pool);
        foreach (var direction in new[] { Vector3.Zero, new(float.NaN, 0, 0), new(float.PositiveInfinity, 0, 0) })
            Assert.False(mesh.RayTest(RigidPose.Identity, new(-5, 0, 0), direction, float.MaxValue, out _, out _, out _));
        Assert.True(mesh.RayTest(RigidPose.Identity, new(-5, 0, 0), Vector3.UnitX, float.PositiveInfinity, out var t, out var normal, out _));
        Assert.Equal((4, -Vector3.UnitX), (t, normal));
        mesh.Dispose(pool);
    }
}
