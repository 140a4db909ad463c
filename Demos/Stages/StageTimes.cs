using System;
using System.Collections.Generic;

namespace Demos.Stages;

/// <summary>Times of a run: of each step, of its parts, and of the stages that were dispatched in them.</summary>
/// <remarks>
/// A run does the same again if it is repeated, to the bit, but for what the machine does besides: so of several runs each time is the least. What is on one
/// thread is taken so by itself, as an interruption of what is dispatched must not count for it.
/// </remarks>
sealed class StageTimes
{
    record struct StageTime(int Part, int BlockCount, long Ticks, long LongestBlockTicks);

    readonly List<double> steps = [];
    readonly List<double> serial = [];
    readonly List<StageTime> stages = [];

    /// <summary>Milliseconds of each step.</summary>
    public IReadOnlyList<double> Milliseconds => steps;

    public void AddStage(int part, int blockCount, long ticks, long longestBlockTicks) => stages.Add(new(part, blockCount, ticks, longestBlockTicks));

    /// <summary>Ends a step, of each part of which the time outside of its stages is given.</summary>
    public void EndStep(double milliseconds, ReadOnlySpan<double> serialTicks)
    {
        steps.Add(milliseconds);
        serial.AddRange(serialTicks);
    }

    /// <summary>Takes each time that is less in another run of the same.</summary>
    public void TakeLeast(StageTimes other)
    {
        if (other.stages.Count != stages.Count || other.serial.Count != serial.Count)
            throw new InvalidOperationException("A run that was repeated had other stages.");
        for (int i = 0; i < steps.Count; ++i)
            steps[i] = Math.Min(steps[i], other.steps[i]);
        for (int i = 0; i < serial.Count; ++i)
            serial[i] = Math.Min(serial[i], other.serial[i]);
        for (int i = 0; i < stages.Count; ++i)
        {
            (StageTime a, StageTime b) = (stages[i], other.stages[i]);
            if (a.Part != b.Part || a.BlockCount != b.BlockCount)
                throw new InvalidOperationException("A run that was repeated had other stages.");
            stages[i] = a with { Ticks = Math.Min(a.Ticks, b.Ticks), LongestBlockTicks = Math.Min(a.LongestBlockTicks, b.LongestBlockTicks) };
        }
    }

    /// <summary>Sums of all steps, by the names of the parts.</summary>
    public StageShare[] Sum(IReadOnlyList<string> parts)
    {
        var shares = new StageShare[parts.Count];
        for (int i = 0; i < shares.Length; ++i)
            shares[i] = new StageShare(parts[i]);
        for (int i = 0; i < serial.Count; ++i)
            shares[i % shares.Length].AddTime(serial[i]);
        foreach (StageTime stage in stages)
        {
            shares[stage.Part].AddTime(stage.Ticks);
            shares[stage.Part].AddStage(stage.BlockCount, stage.Ticks, stage.LongestBlockTicks);
        }
        return shares;
    }
}
