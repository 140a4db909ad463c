using System;
using System.Diagnostics;
using System.Globalization;
using System.IO;
using System.Text;

namespace Benchmarks.Sweeps.Shared;

/// <summary>Measures sweeps with the engine that this program is compiled against.</summary>
static class SweepTimesCommand
{
    /// <summary>The word on the command line; then the file for the figures.</summary>
    public const string Word = "sweep-times";

    const int CaseCount = 1000;
    const int GroupSize = 50;
    const int BatchCount = 21;

    /// <summary>Measures and returns the exit status.</summary>
    public static int Run(string resultPath)
    {
        var text = new StringBuilder();
        foreach (var name in SweepWorld.Names)
        {
            using var world = new SweepWorld(name);
            foreach (var shape in SweepWorld.Shapes)
            {
                foreach (var motion in SweepWorld.Motions)
                {
                    var (time, hits, way) = Measure(world, shape, world.CreateCases(shape, motion, CaseCount));
                    text.AppendLine(CultureInfo.InvariantCulture, $"{name},{shape},{motion},{time:R},{hits:R},{way:R}");
                }
            }
        }
        File.WriteAllText(resultPath, text.ToString());
        return 0;
    }

    /// <summary>Nanoseconds of a sweep, the part that hits, and the mean time of a hit.</summary>
    // The quickest time of each group of sweeps: whatever else the machine does only adds to the time, and a group is short.
    static (double Time, double Hits, double Way) Measure(SweepWorld world, string shape, SweepWorld.Case[] cases)
    {
        var hits = 0;
        double sum = 0, way = 0;
        for (int start = 0; start < cases.Length; start += GroupSize)
        {
            var group = cases.AsSpan(start, GroupSize);
            var least = double.MaxValue;
            for (int batch = 0; batch < BatchCount; ++batch)
            {
                var begin = Stopwatch.GetTimestamp();
                foreach (ref readonly var sweep in group)
                    world.Sweep(shape, sweep);
                least = Math.Min(least, Stopwatch.GetElapsedTime(begin).TotalNanoseconds);
            }
            sum += least;
            foreach (ref readonly var sweep in group)
            {
                var hit = world.Sweep(shape, sweep);
                hits += hit.IsHit ? 1 : 0;
                way += hit.IsHit ? hit.T : 0;
            }
        }
        return (sum / cases.Length, (double)hits / cases.Length, hits > 0 ? way / hits : 0);
    }
}
