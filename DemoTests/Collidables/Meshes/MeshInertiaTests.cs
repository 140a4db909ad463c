using System;
using System.Linq;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuUtilities;
using BepuUtilities.Memory;
using DemoTests.Support;
using Xunit;

namespace DemoTests.Collidables.Meshes;

/// <summary>Mass properties of meshes against closed forms, and against random points inside.</summary>
public sealed class MeshInertiaTests : IDisposable
{
    readonly BufferPool pool = new();

    public void Dispose()
    {
        pool.AssertEmpty();
        pool.Clear();
    }

    static void AssertClose(Symmetric3x3 expected, Symmetric3x3 actual, double tolerance)
    {
        var size = Math.Max(expected.XX, Math.Max(expected.YY, expected.ZZ));
        Assert.InRange(Math.Abs(expected.XX - actual.XX), 0, tolerance * size);
        Assert.InRange(Math.Abs(expected.YY - actual.YY), 0, tolerance * size);
        Assert.InRange(Math.Abs(expected.ZZ - actual.ZZ), 0, tolerance * size);
        Assert.InRange(Math.Abs(expected.YX - actual.YX), 0, tolerance * size);
        Assert.InRange(Math.Abs(expected.ZX - actual.ZX), 0, tolerance * size);
        Assert.InRange(Math.Abs(expected.ZY - actual.ZY), 0, tolerance * size);
    }

    [Fact]
    public void A_box_of_triangles_has_the_inertia_of_a_box_wherever_it_is_and_whatever_its_scale()
    {
        var random = new Random(LevelSeeds.Of(11));
        for (int i = 0; i < 100; ++i)
        {
            Vector3 half = new(.1f + (float)random.NextDouble(), .1f + (float)random.NextDouble(), .1f + (float)random.NextDouble());
            var place = new Vector3((float)random.NextDouble() - .5f, (float)random.NextDouble() - .5f, (float)random.NextDouble() - .5f) * 6;
            var scale = new Vector3(i % 2 == 0 ? 1 : -2, i % 3 == 0 ? 3 : -1, .5f);
            var sample = MeshSample.Box(half).Moved(place);
            var mesh = new Mesh(sample.Vertices, sample.Indices, scale, pool);
            var expected = new Box(2 * half.X * Math.Abs(scale.X), 2 * half.Y * Math.Abs(scale.Y), 2 * half.Z * Math.Abs(scale.Z)).ComputeInertia(3);
            var inertia = mesh.ComputeClosedInertia(3, out var center);
            Assert.InRange((center - place * scale).Length(), 0, 1e-5f * center.Length());
            AssertClose(expected.InverseInertiaTensor, inertia.InverseInertiaTensor, 1e-5);
            Assert.Equal(expected.InverseMass, inertia.InverseMass);
            // Now around the origin and the centre at once.
            AssertClose(expected.InverseInertiaTensor, mesh.ComputeClosedInertia(3).InverseInertiaTensor, 1e-5);
            Assert.InRange(mesh.ComputeClosedCenterOfMass().Length(), 0, 1e-5f);
            mesh.ComputeClosedCenterOfMass(out var volume, out _);
            Assert.Equal(1, volume / (8 * half.X * half.Y * half.Z * Math.Abs(scale.X * scale.Y * scale.Z)), 1e-5);
            // The theorem of parallel axes: by the helper that games have, around a point far away.
            var moved = sample.Moved(new(9, 5, -7));
            var other = new Mesh(moved.Vertices, moved.Indices, scale, pool);
            var source = new Mesh.MeshTriangleSource(other);
            MeshInertiaHelper.ComputeClosedInertia(ref source, 3, out _, out var tensor, out var otherCenter);
            MeshInertiaHelper.GetInertiaOffset(3, otherCenter, out var offset);
            var inverse = expected.InverseInertiaTensor;
            Symmetric3x3 centered = new(1 / inverse.XX - offset.XX, -offset.YX, 1 / inverse.YY - offset.YY, -offset.ZX, -offset.ZY, 1 / inverse.ZZ - offset.ZZ);
            AssertClose(centered, tensor, 1e-5);
            other.Dispose(pool);
            mesh.Dispose(pool);
        }
    }

    [Fact]
    public void A_solid_torus_has_the_inertia_of_points_thrown_at_it()
    {
        const double Ring = 3, Tube = 1;
        var sample = MeshSample.Torus((float)Ring, (float)Tube, 200, 100);
        var mesh = new Mesh(sample.Vertices, sample.Indices, Vector3.One, pool);
        var inertia = mesh.ComputeClosedInertia(2);
        Symmetric3x3.Invert(inertia.InverseInertiaTensor, out var tensor);
        var random = new Random(LevelSeeds.Of(6));
        double xx = 0, yy = 0;
        var count = 0;
        for (int i = 0; i < 400_000; ++i)
        {
            double x = (random.NextDouble() * 2 - 1) * (Ring + Tube), y = (random.NextDouble() * 2 - 1) * Tube,
                z = (random.NextDouble() * 2 - 1) * (Ring + Tube);
            var across = Math.Sqrt(x * x + z * z) - Ring;
            if (across * across + y * y > Tube * Tube)
                continue;
            ++count;
            xx += y * y + z * z;
            yy += x * x + z * z;
        }
        Assert.Equal(1, tensor.XX / (2 * xx / count), 1e-2);
        Assert.Equal(1, tensor.YY / (2 * yy / count), 1e-2);
        // In closed form: m (R^2 + 3/4 r^2) around the axis; a polygon of 200 by 100 has 3e-3 less at most.
        Assert.Equal(1, tensor.YY / (2 * (Ring * Ring + .75 * Tube * Tube)), 3e-3);
        mesh.Dispose(pool);
    }

    [Fact]
    public void An_open_box_is_the_sum_of_its_sheets()
    {
        // Sides of a cube of 2 m: each of mass m / 6, I = 1/12 m (a^2 + b^2), and m d^2 for its distance.
        var sample = MeshSample.Box(Vector3.One).Moved(new(1, 2, 3));
        var mesh = new Mesh(sample.Vertices, sample.Indices, Vector3.One, pool);
        Assert.InRange((mesh.ComputeOpenCenterOfMass() - new Vector3(1, 2, 3)).Length(), 0, 1e-6f);
        var inertia = mesh.ComputeOpenInertia(6, out var center);
        Assert.InRange((center - new Vector3(1, 2, 3)).Length(), 0, 1e-6f);
        var expected = 1 / (2 * (4 + 4) / 12f + 4 * (4 / 12f + 1));
        AssertClose(Symmetric3x3.Diagonal(expected, expected, expected), inertia.InverseInertiaTensor, 1e-5);
        AssertClose(inertia.InverseInertiaTensor, mesh.ComputeOpenInertia(6).InverseInertiaTensor, 1e-5);
        mesh.Dispose(pool);
    }

    [Fact]
    public void After_it_was_recentered_a_mesh_is_where_it_should_be_and_boxes_find_its_triangles()
    {
        var sample = MeshSample.Terrain(20);
        var mesh = new Mesh(sample.Vertices, sample.Indices, new(2, 1, -1), pool);
        mesh.ComputeBounds(Quaternion.Identity, out var min, out var max);
        mesh.Recenter(new(8, 4, -2));
        mesh.ComputeBounds(Quaternion.Identity, out var newMin, out var newMax);
        Assert.InRange((min - new Vector3(8, 4, -2) - newMin).Length() + (max - new Vector3(8, 4, -2) - newMax).Length(), 0, 1e-5f);
        for (int i = 0; i < mesh.ChildCount; ++i)
        {
            mesh.GetLocalChild(i, out var child);
            var found = new BepuUtilities.Collections.QuickList<int>(4, pool);
            mesh.FindLocalOverlaps(child.B, child.B, ref found, pool);
            Assert.Contains(i, found.AsSpan().ToArray());
            found.Dispose(pool);
        }
        Assert.Throws<ArgumentException>(() => mesh.Recenter(new(float.NaN)));
        mesh.Dispose(pool);
    }

    [Fact]
    public void What_encloses_nothing_or_is_inside_out_has_no_closed_inertia()
    {
        var sample = MeshSample.Box(Vector3.One);
        var flipped = sample.Indices.Chunk(3).SelectMany(corners => new[] { corners[0], corners[2], corners[1] }).ToArray();
        var mesh = new Mesh(sample.Vertices, flipped, Vector3.One, pool);
        Assert.Throws<ArgumentException>(() => mesh.ComputeClosedInertia(1));
        Assert.Throws<ArgumentOutOfRangeException>(() => mesh.ComputeOpenInertia(0));
        mesh.Dispose(pool);
    }
}
