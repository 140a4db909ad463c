using System;
using System.Collections.Generic;
using BenchmarkDotNet.Attributes;
using BepuPhysics.Constraints;

namespace Benchmarks.Micro;

/// <summary>What one constraint costs in one substep: nanoseconds per lane, gather and scatter of the bodies included.</summary>
public class ConstraintBenchmarks : IDisposable
{
    // At 8 lanes; the figure of another width is to be scaled by 8 / lanes.
    const int LanesPerCall = ConstraintFixture.Bundles * 8;

    ConstraintFixture? fixture;

    /// <summary>Constraint types.</summary>
    public static IEnumerable<string> Names => ConstraintFixture.Names;

    /// <summary>Constraint type.</summary>
    [ParamsSource(nameof(Names))]
    public string Type { get; set; } = nameof(BallSocket);

    /// <summary>Creates the constraints.</summary>
    [GlobalSetup]
    public void Setup() => fixture = new(Type);

    /// <summary>Frees them.</summary>
    [GlobalCleanup]
    public void Dispose()
    {
        fixture?.Dispose();
        fixture = null;
        GC.SuppressFinalize(this);
    }

    /// <summary>Applies accumulated impulses.</summary>
    [Benchmark(OperationsPerInvoke = LanesPerCall)]
    public void WarmStart() => fixture!.WarmStart();

    /// <summary>One velocity iteration.</summary>
    [Benchmark(OperationsPerInvoke = LanesPerCall)]
    public void Solve() => fixture!.Solve();
}
