using System;
using System.Collections.Generic;
using System.Diagnostics;

namespace BepuPhysics;

/// <summary>Seconds that each stage of the last step took, by the object that is responsible for the stage.</summary>
public sealed class SimulationProfiler
{
    readonly Dictionary<object, double> seconds = new(8);

    /// <summary>Key of the time in which contacts become constraints.</summary>
    public static object Flush { get; } = new();

    /// <summary>Seconds that a stage took in the last step; 0 where it did not run.</summary>
    public double this[object stage] => seconds.TryGetValue(stage, out var value) ? value : 0;

    internal Timer Time(object stage) => new(this, stage);

    internal readonly struct Timer(SimulationProfiler profiler, object stage) : IDisposable
    {
        readonly long start = Stopwatch.GetTimestamp();

        public void Dispose() => profiler.seconds[stage] = Stopwatch.GetElapsedTime(start).TotalSeconds;
    }
}
