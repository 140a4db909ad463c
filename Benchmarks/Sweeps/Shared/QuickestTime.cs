using System;
using System.Diagnostics;

namespace Benchmarks.Sweeps.Shared;

/// <summary>Times questions to a world that does not change.</summary>
static class QuickestTime
{
    /// <summary>Number of questions of each kind.</summary>
    public const int CaseCount = 1000;

    const int GroupSize = 50;
    const int BatchCount = 21;

    /// <summary>Asks one question and says how many answers there were.</summary>
    public delegate int Question(in SweepWorld.Case place);

    /// <summary>Nanoseconds of a question, and the answers to one, in the mean.</summary>
    // The quickest time of each group: whatever else the machine does only adds to the time, and a group is short.
    public static double Of(SweepWorld.Case[] cases, Question ask, out double answers)
    {
        double sum = 0, count = 0;
        for (int start = 0; start < cases.Length; start += GroupSize)
        {
            var group = cases.AsSpan(start, Math.Min(GroupSize, cases.Length - start));
            var least = double.MaxValue;
            for (int batch = 0; batch < BatchCount; ++batch)
            {
                var begin = Stopwatch.GetTimestamp();
                foreach (ref readonly var place in group)
                    ask(place);
                least = Math.Min(least, Stopwatch.GetElapsedTime(begin).TotalNanoseconds);
            }
            sum += least;
            foreach (ref readonly var place in group)
                count += ask(place);
        }
        answers = count / cases.Length;
        return sum / cases.Length;
    }
}
