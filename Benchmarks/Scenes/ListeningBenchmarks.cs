using System;
using BenchmarkDotNet.Attributes;
using Benchmarks.Smoke;
using BepuPhysics;
using BepuPhysics.CollisionDetection;
using Demos.Running;
using Demos.Scenes;

namespace Benchmarks.Scenes;

/// <summary>What events and layers cost: nobody asks for them, somebody does who meets nothing, or everybody listens to everything.</summary>
/// <remarks>Every iteration builds the scene anew and measures the same steps of it; the state after these is the same for all.</remarks>
[WarmupCount(2), IterationCount(15)]
public class ListeningBenchmarks : IShortened, IDisposable
{
    const int StepsPerCall = 40;

    int warmupSteps = 60;
    int steps = StepsPerCall;
    SceneRun? run;

    /// <summary>Who asks.</summary>
    public enum Audience
    {
        /// <summary>Nobody: the tables of events and layers do not exist.</summary>
        Nobody,
        /// <summary>A static far away listens to everything, and has layers that meet all others.</summary>
        Elsewhere,
        /// <summary>All bodies listen to everything.</summary>
        All,
    }

    /// <summary>Who asks.</summary>
    [Params(Audience.Nobody, Audience.Elsewhere, Audience.All)]
    public Audience Asks { get; set; }

    /// <summary>Name of the scene.</summary>
    [Params("pyramids", "shape-pile")]
    public string Scene { get; set; } = "pyramids";

    /// <inheritdoc/>
    void IShortened.Shorten() => (warmupSteps, steps) = (1, 2);

    /// <summary>Builds the scene and lets its contacts form.</summary>
    [IterationSetup]
    public void Setup()
    {
        run = new SceneRun(SceneLibrary.Load(Scene, seed: 1), new RunSettings { Listen = Asks == Audience.All });
        if (Asks == Audience.Elsewhere)
            ListenElsewhere(run.Simulation);
        for (int i = 0; i < warmupSteps; ++i)
            run.Step();
    }

    static void ListenElsewhere(Simulation simulation)
    {
        var shape = simulation.Shapes.Add(new BepuPhysics.Collidables.Sphere(1));
        var far = simulation.Statics.Add(new StaticDescription(new(0, 1e5f, 0), System.Numerics.Quaternion.Identity, shape));
        simulation.Events.Listen(far, EventMask.All);
        simulation.Layers[far] = new CollisionLayers(1, 1);
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
