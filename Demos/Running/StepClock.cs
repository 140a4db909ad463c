using System;
using System.Collections.Generic;
using System.Diagnostics;

namespace Demos.Running;

/// <summary>Collects the time of each step and what the steps allocated.</summary>
sealed class StepClock
{
    readonly List<double> milliseconds = [];
    long started;
    long ownBytesAtStart;
    long ownBytes;
    long allBytesAtReset;
    long ownBytesAtReset;

    /// <summary>Bytes that all threads allocated since <see cref="Reset"/>, less what this thread did between the steps.</summary>
    public long ManagedBytes
    {
        get
        {
            long own = GC.GetAllocatedBytesForCurrentThread() - ownBytesAtReset;
            return GC.GetTotalAllocatedBytes(precise: true) - allBytesAtReset - own + ownBytes;
        }
    }

    /// <summary>Number of steps since <see cref="Reset"/>.</summary>
    public int Count => milliseconds.Count;

    /// <summary>Forgets all steps so far.</summary>
    public void Reset()
    {
        milliseconds.Clear();
        ownBytes = 0;
        allBytesAtReset = GC.GetTotalAllocatedBytes(precise: true);
        ownBytesAtReset = GC.GetAllocatedBytesForCurrentThread();
    }

    public void Begin()
    {
        ownBytesAtStart = GC.GetAllocatedBytesForCurrentThread();
        started = Stopwatch.GetTimestamp();
    }

    public void End()
    {
        double elapsed = Stopwatch.GetElapsedTime(started).TotalMilliseconds;
        ownBytes += GC.GetAllocatedBytesForCurrentThread() - ownBytesAtStart;
        milliseconds.Add(elapsed);
    }

    /// <summary>The figures of the steps since <see cref="Reset"/>; no numbers when there was none.</summary>
    public StepTimes Summarize()
    {
        if (milliseconds.Count == 0)
            return new StepTimes(double.NaN, double.NaN, double.NaN, double.NaN, double.NaN);
        var sorted = new List<double>(milliseconds);
        sorted.Sort();
        double sum = 0;
        foreach (double time in sorted)
            sum += time;
        return new StepTimes(sum / sorted.Count, Percentile(sorted, 0.5), Percentile(sorted, 0.95), Percentile(sorted, 0.99), sorted[^1]);
    }

    /// <summary>The value below which the given share of sorted numbers lies, interpolated between neighbours.</summary>
    static double Percentile(List<double> sorted, double share)
    {
        double place = share * (sorted.Count - 1);
        int below = (int)place;
        int above = Math.Min(below + 1, sorted.Count - 1);
        return sorted[below] + (place - below) * (sorted[above] - sorted[below]);
    }
}
