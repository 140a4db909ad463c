using System;
using System.Numerics;
using BenchmarkDotNet.Attributes;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Memory;

namespace Benchmarks.Micro;

/// <summary>What the broad phase's tree costs on one thread: nanoseconds per leaf.</summary>
public class TreeBenchmarks : IDisposable
{
    const int LeavesPerCall = 16000;

    // Unit boxes at this spacing have about two neighbours each, as many as those of a loose pile.
    const float Spacing = 1.6f;

    readonly BufferPool pool = new();
    BoundingBox[] boxes = [];
    Tree[] trees = [];

    /// <summary>Leaves of a tree; a call goes through as many trees as make up 16,000.</summary>
    [Params(4000, LeavesPerCall)]
    public int Leaves { get; set; } = LeavesPerCall;

    /// <summary>Pairs that the last self test found.</summary>
    public int PairCount { get; private set; }

    /// <summary>Builds the trees.</summary>
    [GlobalSetup]
    public void Setup()
    {
        var random = new Random(1);
        float side = MathF.Cbrt(Leaves) * Spacing;
        boxes = new BoundingBox[Leaves];
        foreach (ref BoundingBox box in boxes.AsSpan())
        {
            var corner = new Vector3(random.NextSingle(), random.NextSingle(), random.NextSingle()) * side;
            box = new BoundingBox(corner, corner + Vector3.One);
        }
        trees = new Tree[LeavesPerCall / Leaves];
        foreach (ref Tree tree in trees.AsSpan())
            tree = new Tree(pool, Leaves);
        Build();
    }

    /// <summary>Frees them.</summary>
    [GlobalCleanup]
    public void Dispose()
    {
        foreach (ref Tree tree in trees.AsSpan())
            tree.Dispose(pool);
        pool.Dispose();
        GC.SuppressFinalize(this);
    }

    /// <summary>A binned build out of nothing.</summary>
    [Benchmark(OperationsPerInvoke = LeavesPerCall)]
    public void Build()
    {
        foreach (ref Tree tree in trees.AsSpan())
            tree.BinnedBuild(boxes, pool);
    }

    /// <summary>All nodes fitted to their leaves.</summary>
    [Benchmark(OperationsPerInvoke = LeavesPerCall)]
    public void Refit()
    {
        foreach (ref Tree tree in trees.AsSpan())
            tree.Refit();
    }

    /// <summary>All pairs of leaves whose boxes overlap.</summary>
    [Benchmark(OperationsPerInvoke = LeavesPerCall)]
    public void SelfTest()
    {
        var counter = new Counter();
        foreach (ref Tree tree in trees.AsSpan())
            tree.GetSelfOverlaps(ref counter, pool);
        PairCount = counter.Count;
    }

    struct Counter : IOverlapHandler
    {
        public int Count;

        public void Handle(int indexA, int indexB) => ++Count;
    }
}
