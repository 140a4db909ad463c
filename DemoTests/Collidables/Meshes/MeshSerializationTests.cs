using System;
using System.Linq;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Diagnostics;
using BepuUtilities.Memory;
using DemoTests.Support;
using Xunit;

namespace DemoTests.Collidables.Meshes;

/// <summary>Meshes as bytes, whole and damaged.</summary>
public sealed class MeshSerializationTests : IDisposable
{
    const int DamageCount = 10_000;

    readonly BufferPool pool = new();

    public void Dispose()
    {
        pool.AssertEmpty();
        pool.Clear();
    }

    byte[] Write(MeshSample sample, Vector3 scale, bool twoSided = false, byte[]? materials = null, IThreadDispatcher? dispatcher = null)
    {
        var mesh = new Mesh(sample.Vertices, sample.Indices, scale, pool, materials, dispatcher) { TwoSided = twoSided };
        var bytes = new byte[mesh.GetSerializedByteCount()];
        mesh.Serialize(bytes);
        mesh.Dispose(pool);
        return bytes;
    }

    [Fact]
    public void A_mesh_that_was_loaded_is_the_same_bytes_again_and_answers_the_same()
    {
        var sample = MeshSample.Terrain(12);
        var bytes = Write(sample, new(1, -2, 3), true, [.. Enumerable.Range(0, sample.TriangleCount).Select(i => (byte)i)]);
        // More bytes may follow.
        var mesh = new Mesh((ReadOnlySpan<byte>)[.. bytes, 1, 2, 3], pool);
        Assert.Equal((new Vector3(1, -2, 3), true, sample.TriangleCount, (byte)5), (mesh.Scale, mesh.TwoSided, mesh.ChildCount, mesh.GetMaterial(5)));
        var again = new byte[mesh.GetSerializedByteCount()];
        mesh.Serialize(again);
        Assert.Equal(bytes, again);
        Assert.Throws<ArgumentException>(() => mesh.Serialize(new byte[again.Length - 1]));
        mesh.Dispose(pool);
    }

    [Theory]
    [InlineData(2), InlineData(3), InlineData(8)]
    public void Threads_build_the_same_bytes(int threads)
    {
        // As large as a tree has to be for threads, and larger by far.
        foreach (var cells in new[] { 32, 33, 90 })
        {
            var sample = MeshSample.Terrain(cells);
            var alone = Write(sample, Vector3.One);
            using var dispatcher = new ThreadDispatcher(threads);
            Assert.Equal(alone, Write(sample, Vector3.One, dispatcher: dispatcher));
            var triangles = new Triangle[sample.TriangleCount];
            for (int i = 0; i < triangles.Length; ++i)
            {
                var corners = sample.Indices.AsSpan(3 * i, 3);
                triangles[i] = new(sample.Vertices[corners[0]], sample.Vertices[corners[1]], sample.Vertices[corners[2]]);
            }
            var mesh = new Mesh(triangles, Vector3.One, pool, dispatcher);
            var bytes = new byte[mesh.GetSerializedByteCount()];
            mesh.Serialize(bytes);
            mesh.Dispose(pool);
            Assert.Equal(alone, bytes);
        }
    }

    [Fact]
    public void The_bytes_of_a_mesh_do_not_change_from_machine_to_machine()
    {
        // Recorded once: a change here is a change of the form, which has a mark of its own, or of the order that the builder of trees leaves equals in.
        var hash = new StateHash();
        hash.Add((ReadOnlySpan<byte>)Write(new([new(0, 0, 0), new(1, 0, 0), new(0, 0, 1), new(1, .5f, 1), new(2, 0, 0)], [0, 1, 2, 1, 3, 2, 1, 4, 3]),
            Vector3.One));
        Assert.Equal("0x858EF26FDDF31946", $"0x{hash.Value:X}");
    }

    [Fact]
    public void A_byte_that_is_not_what_it_was_is_found()
    {
        var bytes = Write(MeshSample.Soup(20, 3), Vector3.One);
        var random = new Random(LevelSeeds.Of(1));
        for (int i = 0; i < DamageCount; ++i)
        {
            var damaged = (byte[])bytes.Clone();
            damaged[random.Next(damaged.Length)] ^= (byte)(1 << random.Next(8));
            Assert.Throws<ArgumentException>(() => new Mesh((ReadOnlySpan<byte>)damaged, pool));
        }
        for (int length = 0; length < bytes.Length; length += 7)
            Assert.Throws<ArgumentException>(() => new Mesh(bytes.AsSpan()[..length], pool));
        pool.AssertEmpty();
    }

    // The hash is made to fit, as by someone who means to: what is loaded then may be another mesh, and nothing is read outside of it.
    [Fact]
    public void Damage_under_a_hash_that_fits_is_refused_or_harmless()
    {
        var bytes = Write(MeshSample.Torus(3, 1, 12, 8), Vector3.One);
        var random = new Random(LevelSeeds.Of(2));
        int loaded = 0, refused = 0;
        for (int i = 0; i < DamageCount; ++i)
        {
            var damaged = (byte[])bytes.Clone();
            // Some in the header and the nodes, some anywhere; bits, and whole words of all kinds.
            for (int j = random.Next(3); j >= 0; --j)
            {
                var place = random.Next(random.Next(3) == 0 ? 160 + 80 * 20 : damaged.Length - 4);
                if (random.Next(2) == 0)
                    damaged[place] ^= (byte)(1 << random.Next(8));
                else
                    BitConverter.TryWriteBytes(damaged.AsSpan(place & ~3),
                        random.Next(4) switch { 0 => -1, 1 => int.MaxValue, 2 => random.Next(), _ => 0x7F800000 });
            }
            var hash = new StateHash();
            hash.Add(damaged.AsSpan(0, 4));
            hash.Add(damaged.AsSpan(12));
            BitConverter.TryWriteBytes(damaged.AsSpan(4), hash.Value);
            Mesh mesh;
            try
            {
                mesh = new Mesh((ReadOnlySpan<byte>)damaged, pool);
            }
            catch (ArgumentException)
            {
                ++refused;
                pool.AssertEmpty();
                continue;
            }
            ++loaded;
            Walk(mesh);
            mesh.Dispose(pool);
        }
        Assert.True(loaded > 100 && refused > 1000, $"{loaded} loaded, {refused} refused");
    }

    void Walk(in Mesh mesh)
    {
        var found = new QuickList<int>(4, pool);
        mesh.FindLocalOverlaps(new(-100), new(100), ref found, pool);
        foreach (var triangle in found)
        {
            mesh.GetLocalChild(triangle, out _);
            mesh.GetCone(triangle, out _);
        }
        mesh.RayTest(new(Vector3.Zero), new(-10, .1f, .2f), Vector3.UnitX, float.MaxValue, out _, out _, out _);
        found.Dispose(pool);
    }
}
