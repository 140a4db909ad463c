using System.Collections.Generic;
using Demos.Running;

namespace Benchmarks.Compare;

/// <summary>What a comparison takes from a run.</summary>
static class RunFigures
{
    /// <summary>The stages of a step, in their order.</summary>
    public static readonly string[] StageNames = ["sleep", "predict", "broad", "narrow", "flush", "solve", "settle"];

    /// <summary>Mean milliseconds of a stage, by its place among <see cref="StageNames"/>; null where the engine does not say.</summary>
    public static double? Stage(RunJson run, int index)
    {
        RunStagesJson stages = run.Stages;
        double?[] times = [stages.Sleep, stages.Predict, stages.Broad, stages.Narrow, stages.Flush, stages.Solve, stages.Settle];
        return times[index];
    }

    /// <summary>The middle of some numbers, or null when there are none.</summary>
    public static double? MedianOf(IEnumerable<double?> numbers)
    {
        var sorted = new List<double>();
        foreach (double? number in numbers)
        {
            if (number is double known)
                sorted.Add(known);
        }
        if (sorted.Count == 0)
            return null;
        sorted.Sort();
        int middle = sorted.Count / 2;
        return sorted.Count % 2 == 1 ? sorted[middle] : 0.5 * (sorted[middle - 1] + sorted[middle]);
    }
}
