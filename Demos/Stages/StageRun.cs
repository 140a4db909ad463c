using System;
using System.Collections.Generic;
using System.Diagnostics;
using BepuPhysics;
using BepuUtilities.Memory;
using Demos.Running;
using Demos.Scenes;

namespace Demos.Stages;

/// <summary>A scene on one thread that plays many: what of each part of its steps could be shared.</summary>
sealed class StageRun : IDisposable
{
    const int PretendedThreads = 16;

    readonly BufferPool pool = new();
    readonly ObservingDispatcher dispatcher;
    readonly Simulation simulation;
    readonly Replacement? replacement;
    readonly Dictionary<object, StageShare> shares = [];
    readonly List<StageShare> order = [];
    readonly List<double> milliseconds = [];
    bool isMeasuring;

    /// <param name="scene">What to run.</param>
    /// <param name="replacedPerStep">Bodies that are taken out in each step, and added anew where the scene has them.</param>
    public StageRun(SceneDescription scene, int replacedPerStep)
    {
        dispatcher = new ObservingDispatcher(PretendedThreads, OnStageEnded);
        simulation = WatchedScene.Build(scene, pool, PretendedThreads);
        if (replacedPerStep > 0)
            replacement = new Replacement(simulation, replacedPerStep);
        simulation.WarmUp(dispatcher);
        Name("sleep", simulation.Sleeper);
        Name("predict", simulation.PoseIntegrator);
        Name("broad", simulation.BroadPhase);
        Name("narrow", simulation.NarrowPhase);
        Name("flush", SimulationProfiler.Flush);
        Name("solve", simulation.Solver);
        Name("between", simulation);
    }

    /// <summary>Parts of the step, in its order.</summary>
    public IReadOnlyList<StageShare> Shares => order;

    /// <summary>Milliseconds of each step that was measured, changes by the scene included.</summary>
    public IReadOnlyList<double> Milliseconds => milliseconds;

    /// <summary>Hash of all bodies.</summary>
    public ulong Hash() => simulation.StateHash();

    void Name(string name, object stage)
    {
        var share = new StageShare(name);
        shares.Add(stage, share);
        order.Add(share);
    }

    void OnStageEnded(int blockCount, long ticks, long longestBlockTicks)
    {
        if (simulation.Profiler.RunningStage is object stage && isMeasuring)
            shares[stage].AddStage(blockCount, ticks, longestBlockTicks);
    }

    /// <summary>Steps, and measures those after the first ones.</summary>
    public void Step(int count, int skipped)
    {
        for (int i = 0; i < count; ++i)
        {
            isMeasuring = i >= skipped;
            long start = Stopwatch.GetTimestamp();
            replacement?.Step();
            simulation.Timestep(1 / 60f, dispatcher);
            if (!isMeasuring)
                continue;
            milliseconds.Add(Stopwatch.GetElapsedTime(start).TotalMilliseconds);
            double parts = 0;
            foreach ((object stage, StageShare share) in shares)
            {
                if (stage == simulation)
                    continue;
                double ticks = simulation.Profiler[stage] * Stopwatch.Frequency;
                share.AddTime(ticks);
                parts += ticks;
            }
            shares[simulation].AddTime(simulation.Profiler[simulation] * Stopwatch.Frequency - parts);
        }
    }

    public void Dispose()
    {
        simulation.Dispose();
        dispatcher.Dispose();
        pool.Clear();
    }
}
