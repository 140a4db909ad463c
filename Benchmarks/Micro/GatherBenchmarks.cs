using System;
using System.Numerics;
using System.Runtime.InteropServices;
using BenchmarkDotNet.Attributes;
using BepuUtilities;

namespace Benchmarks.Micro;

/// <summary>What it costs to bring one row of eight floats of a bundle of bodies into lanes and back: nanoseconds per bundle.</summary>
public unsafe class GatherBenchmarks : IDisposable
{
    const int Bundles = 16;
    const int FloatsPerRow = 8;

    float* rows;
    Vector<int>[] references = [];
    Rows8 sum;

    /// <summary>Bodies to choose from: 16 KB stay in the first-level cache, 32 MB in none.</summary>
    [Params(512, 1 << 20)]
    public int Bodies { get; set; } = 512;

    /// <summary>Creates the rows and which of them each bundle wants.</summary>
    [GlobalSetup]
    public void Setup()
    {
        rows = (float*)NativeMemory.AlignedAlloc((nuint)Bodies * FloatsPerRow * sizeof(float), 64);
        new Span<float>(rows, Bodies * FloatsPerRow).Fill(1);
        var random = new Random(1);
        references = new Vector<int>[Bundles];
        Span<int> lanes = stackalloc int[Vector<int>.Count];
        foreach (ref var bundle in references.AsSpan())
        {
            foreach (ref var lane in lanes)
                lane = random.Next(Bodies);
            bundle = new(lanes);
        }
    }

    /// <summary>Frees them.</summary>
    [GlobalCleanup]
    public void Dispose()
    {
        NativeMemory.AlignedFree(rows);
        rows = null;
        GC.SuppressFinalize(this);
    }

    /// <summary>Rows to lanes.</summary>
    [Benchmark(OperationsPerInvoke = Bundles)]
    public void Gather()
    {
        foreach (ref var bundle in references.AsSpan())
            sum = Transpose.Gather(rows, FloatsPerRow, bundle);
    }

    /// <summary>Lanes to rows.</summary>
    [Benchmark(OperationsPerInvoke = Bundles)]
    public void Scatter()
    {
        foreach (ref var bundle in references.AsSpan())
            Transpose.Scatter(sum, rows, FloatsPerRow, bundle);
    }
}
