using System;
using BenchmarkDotNet.Attributes;
using Benchmarks.Smoke;
using Demos.Running;

namespace Benchmarks.Scenes;

/// <summary>
/// What a step of a whole scene takes. Every iteration builds the scene anew and measures the same steps of it, as a scene that has come
/// to rest costs something else than one that falls.
/// </summary>
public abstract class SceneStepBenchmarks : IShortened, IDisposable
{
    const int StepsPerCall = 30;

    int warmupSteps = 30;
    int steps = StepsPerCall;
    SceneRun? run;

    /// <inheritdoc/>
    void IShortened.Shorten() => (warmupSteps, steps) = (1, 2);

    private protected abstract SceneRun Create();

    /// <summary>Builds the scene and lets its first contacts form.</summary>
    [IterationSetup]
    public void Setup()
    {
        run = Create();
        for (int i = 0; i < warmupSteps; ++i)
            run.Step();
    }

    /// <summary>Frees it.</summary>
    [IterationCleanup]
    public void Dispose()
    {
        run?.Dispose();
        run = null;
        GC.SuppressFinalize(this);
    }

    /// <summary>A sixtieth of a second in four substeps.</summary>
    [Benchmark(OperationsPerInvoke = StepsPerCall)]
    public void Step()
    {
        for (int i = 0; i < steps; ++i)
            run!.Step();
    }
}
