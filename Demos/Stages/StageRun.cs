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
    readonly List<object> parts = [];
    readonly List<string> names = [];
    // Of each part, what was dispatched of it in the present step.
    readonly double[] dispatched;
    readonly double[] serial;
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
        dispatched = new double[parts.Count];
        serial = new double[parts.Count];
    }

    /// <summary>What was measured.</summary>
    public StageTimes Times { get; } = new();

    /// <summary>Parts of the step, in its order.</summary>
    public StageShare[] Shares => Times.Sum(names);

    /// <summary>Hash of all bodies.</summary>
    public ulong Hash() => simulation.StateHash();

    void Name(string name, object stage)
    {
        names.Add(name);
        parts.Add(stage);
    }

    void OnStageEnded(int blockCount, long ticks, long longestBlockTicks)
    {
        if (simulation.Profiler.RunningStage is not object stage || !isMeasuring)
            return;
        int part = parts.IndexOf(stage);
        dispatched[part] += ticks;
        Times.AddStage(part, blockCount, ticks, longestBlockTicks);
    }

    /// <summary>Steps, and measures those after the first ones.</summary>
    public void Step(int count, int skipped)
    {
        for (int i = 0; i < count; ++i)
        {
            isMeasuring = i >= skipped;
            Array.Clear(dispatched);
            long start = Stopwatch.GetTimestamp();
            replacement?.Step();
            simulation.Timestep(1 / 60f, dispatcher);
            if (!isMeasuring)
                continue;
            double milliseconds = Stopwatch.GetElapsedTime(start).TotalMilliseconds;
            double sum = 0;
            for (int part = 0; part < parts.Count; ++part)
            {
                // The last part is all of the step, of which the others are taken off.
                double ticks = simulation.Profiler[parts[part]] * Stopwatch.Frequency;
                serial[part] = parts[part] == simulation ? ticks - sum : ticks - dispatched[part];
                sum += ticks;
            }
            Times.EndStep(milliseconds, serial);
        }
    }

    public void Dispose()
    {
        simulation.Dispose();
        dispatcher.Dispose();
        pool.Clear();
    }
}
