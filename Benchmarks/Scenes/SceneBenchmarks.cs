using System;
using System.Collections.Generic;
using System.Linq;
using BenchmarkDotNet.Attributes;
using Benchmarks.Smoke;
using Demos.Running;
using Demos.Scenes;

namespace Benchmarks.Scenes;

/// <summary>
/// What a step of a whole scene takes. Every iteration builds the scene anew and measures the same steps of it, as a scene that has come
/// to rest costs something else than one that falls.
/// </summary>
[WarmupCount(1), IterationCount(5)]
public class SceneBenchmarks : IShortened, IDisposable
{
    const int StepsPerCall = 30;

    int warmupSteps = 30;
    int steps = StepsPerCall;
    SceneRun? run;

    /// <summary>Names of the built-in scenes.</summary>
    public static IEnumerable<string> Names => SceneLibrary.Scenes.Select(scene => scene.Name);

    /// <summary>Name of the scene.</summary>
    [ParamsSource(nameof(Names))]
    public string Scene { get; set; } = SceneLibrary.DefaultScene;

    /// <summary>Threads that share the step.</summary>
    [Params(1, 2)]
    public int Threads { get; set; } = 1;

    /// <inheritdoc/>
    void IShortened.Shorten() => (warmupSteps, steps) = (1, 2);

    /// <summary>Builds the scene and lets its first contacts form.</summary>
    [IterationSetup]
    public void Setup()
    {
        run = new SceneRun(SceneLibrary.Load(Scene, seed: 1), new RunSettings { Threads = Threads });
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
