using System;
using System.Collections.Generic;
using System.Diagnostics;
using BepuPhysics;
using BepuUtilities;
using BepuUtilities.Memory;
using Demos.Running;
using Demos.Scenes;

namespace Demos.Sleeping;

/// <summary>A scene whose steps are timed one by one, with the number of bodies that are awake.</summary>
sealed class SleepRun : IDisposable
{
    // Steps whose time is that of a scene that is awake: the first are spent on finding contacts and on the compiler.
    const int FirstAwakeStep = 5;
    const int LastAwakeStep = 30;

    readonly BufferPool pool = new();
    readonly ThreadDispatcher? dispatcher;
    readonly List<double> milliseconds = [];
    readonly List<int> awake = [];

    public SleepRun(SceneDescription scene, int threads, bool staysAwake)
    {
        dispatcher = threads > 1 ? new ThreadDispatcher(threads) : null;
        Simulation = WatchedScene.Build(scene, pool, threads);
        Simulation.WarmUp(dispatcher);
        BodyCount = Simulation.Bodies.CountBodies();
        for (int i = 0; staysAwake && i < BodyCount; ++i)
            Simulation.Bodies.ActiveSet.Activity[i].SleepThreshold = -1;
    }

    public Simulation Simulation { get; }

    public int BodyCount { get; }

    /// <summary>Fewest bodies that were awake after a step, and the first such step, from one on.</summary>
    public int FewestAwake { get; private set; } = int.MaxValue;

    public int StepOfFewest { get; private set; }

    public int MostAwakeAtEnd => Greatest(awake, awake.Count * 2 / 3);

    public double AwakeStep => Mean(FirstAwakeStep, LastAwakeStep);

    public double MeanUntilAsleep => Mean(FirstAwakeStep, StepOfFewest);

    public double WorstUntilAsleep
    {
        get
        {
            double worst = 0;
            for (int i = FirstAwakeStep; i < StepOfFewest; ++i)
                worst = Math.Max(worst, milliseconds[i]);
            return worst;
        }
    }

    public double MeanAfterwards => Mean(StepOfFewest, milliseconds.Count);

    public ulong PoolBytes => pool.GetTotalAllocatedByteCount();

    public double PercentileAfterwards(double part)
    {
        var sorted = milliseconds[Math.Min(StepOfFewest, milliseconds.Count - 1)..];
        sorted.Sort();
        return sorted[(int)Math.Ceiling(part * sorted.Count) - 1];
    }

    public void Step(int count)
    {
        for (int i = 1; i <= count; ++i)
        {
            long start = Stopwatch.GetTimestamp();
            Simulation.Timestep(1 / 60f, dispatcher);
            milliseconds.Add(Stopwatch.GetElapsedTime(start).TotalMilliseconds);
            awake.Add(Simulation.Bodies.ActiveSet.Count);
            if (awake[^1] >= FewestAwake)
                continue;
            FewestAwake = awake[^1];
            StepOfFewest = i;
        }
    }

    /// <summary>Takes the shorter time of each step. Runs do the same, and what else the machine does is none of theirs.</summary>
    public void TakeFastest(SleepRun? other)
    {
        for (int i = 0; other is not null && i < milliseconds.Count; ++i)
            milliseconds[i] = Math.Min(milliseconds[i], other.milliseconds[i]);
    }

    /// <summary>Cost of the static tree as it is, over that of one that is built anew.</summary>
    public float CompareTree()
    {
        float cost = Simulation.BroadPhase.StaticTree.MeasureRelativeCost();
        Simulation.BroadPhase.StaticTree.BinnedBuild(pool);
        return cost / Simulation.BroadPhase.StaticTree.MeasureRelativeCost();
    }

    /// <summary>Microseconds of a step in which nothing is awake.</summary>
    public double MeasureAsleep()
    {
        const int count = 200_000;
        for (int i = 0; i < count; ++i)
            Simulation.Timestep(1 / 60f, dispatcher);
        long start = Stopwatch.GetTimestamp();
        for (int i = 0; i < count; ++i)
            Simulation.Timestep(1 / 60f, dispatcher);
        return Stopwatch.GetElapsedTime(start).TotalMicroseconds / count;
    }

    /// <summary>Milliseconds of waking all bodies at once, and of the slowest step after it until they sleep again; the least of several times.</summary>
    public (double Wake, double Step) MeasureWaking()
    {
        var best = (Wake: double.MaxValue, Step: double.MaxValue);
        for (int i = 0; i < 5; ++i)
        {
            long start = Stopwatch.GetTimestamp();
            Simulation.Awakener.AwakenAll();
            best.Wake = Math.Min(best.Wake, Stopwatch.GetElapsedTime(start).TotalMilliseconds);
            double worst = 0;
            while (Simulation.Bodies.ActiveSet.Count > 0)
            {
                start = Stopwatch.GetTimestamp();
                Simulation.Timestep(1 / 60f, dispatcher);
                worst = Math.Max(worst, Stopwatch.GetElapsedTime(start).TotalMilliseconds);
            }
            best.Step = Math.Min(best.Step, worst);
        }
        return best;
    }

    double Mean(int start, int end)
    {
        end = Math.Min(end, milliseconds.Count);
        double sum = 0;
        for (int i = start; i < end; ++i)
            sum += milliseconds[i];
        return sum / Math.Max(1, end - start);
    }

    static int Greatest(List<int> numbers, int start)
    {
        int greatest = 0;
        for (int i = start; i < numbers.Count; ++i)
            greatest = Math.Max(greatest, numbers[i]);
        return greatest;
    }

    /// <inheritdoc/>
    public void Dispose()
    {
        Simulation.Dispose();
        dispatcher?.Dispose();
        pool.Clear();
    }
}
