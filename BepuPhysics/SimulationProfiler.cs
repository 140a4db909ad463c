using System;
using System.Diagnostics;

namespace BepuPhysics;

/// <summary>Seconds that each stage of the last step took, by the object that is responsible for the stage.</summary>
public sealed class SimulationProfiler
{
    // A handful: looking through them costs less than a hash of one.
    (object Stage, long Ticks)[] times = [];

    /// <summary>Key of the time in which contacts become constraints.</summary>
    public static object Flush { get; } = new();

    /// <summary>Seconds that a stage took in the last step; 0 where it did not run.</summary>
    public double this[object stage]
    {
        get
        {
            foreach (var time in times)
            {
                if (time.Stage == stage)
                    return Stopwatch.GetElapsedTime(0, time.Ticks).TotalSeconds;
            }
            return 0;
        }
    }

    /// <summary>
    /// What is responsible for the stage that runs now, for dispatchers that want to know whose work they are given; the simulation itself between two
    /// stages of a step, null outside a step.
    /// </summary>
    public object? RunningStage { get; private set; }

    /// <summary>Nothing ran.</summary>
    internal void Clear()
    {
        for (int i = 0; i < times.Length; ++i)
            times[i].Ticks = 0;
    }

    internal Timer Time(object stage) => new(this, stage);

    void Set(object stage, long ticks)
    {
        for (int i = 0; i < times.Length; ++i)
        {
            if (times[i].Stage == stage)
            {
                times[i].Ticks = ticks;
                return;
            }
        }
        times = [.. times, (stage, ticks)];
    }

    internal readonly struct Timer : IDisposable
    {
        readonly SimulationProfiler profiler;
        readonly object stage;
        readonly object? outer;
        readonly long start;

        public Timer(SimulationProfiler profiler, object stage)
        {
            this.profiler = profiler;
            this.stage = stage;
            outer = profiler.RunningStage;
            profiler.RunningStage = stage;
            start = Stopwatch.GetTimestamp();
        }

        public void Dispose()
        {
            profiler.Set(stage, Stopwatch.GetTimestamp() - start);
            profiler.RunningStage = outer;
        }
    }
}
