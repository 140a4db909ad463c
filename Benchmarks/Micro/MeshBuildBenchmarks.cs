using System;
using System.Numerics;
using BenchmarkDotNet.Attributes;
using BepuPhysics.Collidables;
using BepuUtilities.Memory;

namespace Benchmarks.Micro;

/// <summary>What it costs to make a mesh, of a grid and of sets that are hard on a tree or on the search for neighbours: nanoseconds per triangle.</summary>
public class MeshBuildBenchmarks : IDisposable
{
    const int Triangles = 100_000;
    // Triangles of a row of the grid, two to a cell.
    const int RowLength = 500;
    const float Size = .01f;

    readonly BufferPool pool = new();
    readonly Vector3[] vertices = new Vector3[3 * Triangles];
    readonly int[] indices = new int[3 * Triangles];

    /// <summary>A grid of neighbours; triangles far smaller than their distance along a line; all at one place, turned about a common corner;
    /// all at one edge.</summary>
    [Params("grid", "line", "point", "edge")]
    public string Kind { get; set; } = "grid";

    /// <summary>Writes the triangles.</summary>
    [GlobalSetup]
    public void Setup()
    {
        for (int i = 0; i < Triangles; ++i)
        {
            var turn = MathF.Tau * i / Triangles;
            var around = new Vector3(MathF.Cos(turn), 0, MathF.Sin(turn));
            var (a, b, c) = Kind switch
            {
                "grid" => GridTriangle(i),
                "line" => (new(i * Size, 0, 0), new(i * Size + Size / 10, 0, 0), new Vector3(i * Size, Size / 10, 0)),
                "point" => (Vector3.Zero, around, new(0, Size / 10, Size / 10)),
                _ => (Vector3.Zero, Vector3.UnitY, around + new Vector3(0, .5f, 0)),
            };
            (vertices[3 * i], vertices[3 * i + 1], vertices[3 * i + 2]) = (a, b, c);
            (indices[3 * i], indices[3 * i + 1], indices[3 * i + 2]) = (3 * i, 3 * i + 1, 3 * i + 2);
        }
    }

    static (Vector3 A, Vector3 B, Vector3 C) GridTriangle(int i)
    {
        var cell = i / 2;
        Vector3 Corner(int x, int z) => new((cell % (RowLength / 2) + x) * Size, 0, (cell / (RowLength / 2) + z) * Size);
        return i % 2 == 0 ? (Corner(0, 0), Corner(0, 1), Corner(1, 0)) : (Corner(1, 0), Corner(0, 1), Corner(1, 1));
    }

    /// <summary>Frees the memory.</summary>
    [GlobalCleanup]
    public void Dispose()
    {
        pool.Dispose();
        GC.SuppressFinalize(this);
    }

    /// <summary>Makes the mesh and frees it.</summary>
    [Benchmark(OperationsPerInvoke = Triangles)]
    public void Build() => new Mesh(vertices, indices, Vector3.One, pool).Dispose(pool);
}
