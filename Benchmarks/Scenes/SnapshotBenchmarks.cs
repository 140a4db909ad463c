using System;
using System.Globalization;
using BenchmarkDotNet.Attributes;
using Benchmarks.Smoke;
using BepuPhysics;
using BepuUtilities.Memory;
using Demos.Running;
using Demos.Scenes;

namespace Benchmarks.Scenes;

/// <summary>What it takes to save the state of a scene and to go back to it, beside a step of it: time of each. The bytes are printed.</summary>
public class SnapshotBenchmarks : IShortened, IDisposable
{
    int steps = 120;
    BufferPool? pool;
    SimulationSnapshot? snapshot;
    SceneRun? run;

    /// <summary>A pile in motion, one at rest, and a world that sleeps.</summary>
    [Params("shape-pile", "great-pyramid", "settled-city")]
    public string Scene { get; set; } = "shape-pile";

    /// <inheritdoc/>
    void IShortened.Shorten() => (steps, Scene) = (1, "towers");

    /// <summary>Builds the scene, lets its contacts form and saves it.</summary>
    [GlobalSetup]
    public void Setup()
    {
        pool = new();
        snapshot = new(pool);
        run = new SceneRun(SceneLibrary.Load(Scene, seed: 1), new RunSettings());
        for (int i = 0; i < steps; ++i)
            run.Step();
        Save();
        int bodies = run.Simulation.Bodies.CountBodies();
        Console.WriteLine(string.Create(
            CultureInfo.InvariantCulture, $"// {snapshot.ByteCount} bytes, {bodies} bodies, {snapshot.ByteCount / bodies} bytes per body"));
    }

    /// <summary>Frees it.</summary>
    [GlobalCleanup]
    public void Dispose()
    {
        run?.Dispose();
        snapshot?.Dispose();
        pool?.Clear();
        run = null;
        snapshot = null;
        GC.SuppressFinalize(this);
    }

    /// <summary>A sixtieth of a second from the same state, to compare with, and the way back to it.</summary>
    [Benchmark(Baseline = true)]
    public void StepAndRestore()
    {
        run!.Step();
        Restore();
    }

    /// <summary>Copies the state.</summary>
    [Benchmark]
    public void Save() => run!.Simulation.Save(snapshot!);

    /// <summary>Goes back to it.</summary>
    [Benchmark]
    public void Restore() => run!.Simulation.Restore(snapshot!);
}
