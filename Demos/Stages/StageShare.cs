using System;

namespace Demos.Stages;

/// <summary>How much of a part of a step could be shared among threads, summed over steps, in ticks.</summary>
sealed class StageShare(string name)
{
    /// <summary>Numbers of threads for which times are predicted.</summary>
    public static ReadOnlySpan<int> ThreadCounts => [2, 4, 8, 16];

    readonly double[] shared = new double[ThreadCounts.Length];

    public string Name => name;

    /// <summary>All of it, on one thread.</summary>
    public double Total { get; private set; }

    /// <summary>In stages of several blocks.</summary>
    public double Divided { get; private set; }

    /// <summary>In stages of one block, which are shared with nobody although they are dispatched.</summary>
    public double Lone { get; private set; }

    /// <summary>What no other thread can help with.</summary>
    public double Serial => Total - Divided;

    /// <summary>Stages that were dispatched.</summary>
    public int StageCount { get; private set; }

    public void AddStage(int blockCount, long ticks, long longestBlockTicks)
    {
        ++StageCount;
        if (blockCount == 1)
        {
            Lone += ticks;
            return;
        }
        Divided += ticks;
        for (int i = 0; i < shared.Length; ++i)
            shared[i] += Math.Max(longestBlockTicks, (double)ticks / Math.Min(ThreadCounts[i], blockCount));
    }

    /// <summary>Adds the time that the part took in a step, what was dispatched of it included.</summary>
    public void AddTime(double ticks) => Total += ticks;

    /// <summary>Adds another part.</summary>
    public void Add(StageShare other)
    {
        Total += other.Total;
        Divided += other.Divided;
        Lone += other.Lone;
        StageCount += other.StageCount;
        for (int i = 0; i < shared.Length; ++i)
            shared[i] += other.shared[i];
    }

    /// <summary>Time on one thread over that on as many as <see cref="ThreadCounts"/> has at an index, if handing work over took no time.</summary>
    public double SpeedUp(int index) => Total > 0 ? Total / (Serial + shared[index]) : 1;
}
