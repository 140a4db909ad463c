using System;
using System.Diagnostics;
using System.Globalization;
using System.IO;
using System.Numerics;
using System.Text;

namespace Benchmarks.Pairs.Shared;

/// <summary>Measures the cases of a file with the engine that this program is compiled against.</summary>
static class PairTimesCommand
{
    /// <summary>The word on the command line; then the file with the cases and the file for the figures.</summary>
    public const string Word = "pair-times";

    /// <summary>What stands in place of a number of pairs for whole batches as the engine's own step tests them.</summary>
    public const int InStep = 0;

    const int BatchCount = 21;

    /// <summary>Milliseconds of a batch, at least.</summary>
    const double BatchTime = 0.5;

    /// <summary>Measures and returns the exit status.</summary>
    public static int Run(string casePath, string resultPath)
    {
        PairFile file = PairFile.Read(casePath);
        var world = new PairWorld(file);
        var text = new StringBuilder();
        int lanes = Vector<float>.Count;
        foreach (PairCase subject in file.Cases)
        {
            PairPlacement[] placements = subject.Placements;
            foreach (int fill in new[] { 1, lanes / 2, placements.Length })
                Append(text, subject, fill, Measure(() => world.Test(placements, fill), placements.Length));
            if (PairEngine.CreateStepTest(world, placements) is Func<int> stepTest)
                Append(text, subject, InStep, Measure(stepTest, placements.Length));
        }
        File.WriteAllText(resultPath, text.ToString());
        return 0;
    }

    static void Append(StringBuilder text, PairCase subject, int fill, (double Time, double Contacts) figures) => text.AppendLine(
        CultureInfo.InvariantCulture, $"{subject.Pair},{subject.Regime},{fill},{figures.Time:R},{figures.Contacts:R}");

    /// <summary>Nanoseconds per pair, and contacts.</summary>
    // The quickest of some batches: whatever else the machine does only adds to the time.
    static (double Time, double Contacts) Measure(Func<int> test, int pairCount)
    {
        double contacts = (double)test() / pairCount;
        test();
        long start = Stopwatch.GetTimestamp();
        test();
        double once = Stopwatch.GetElapsedTime(start).TotalMilliseconds;
        int repetitions = Math.Clamp((int)(BatchTime / once), 1, 1000);
        double least = double.MaxValue;
        for (int batch = 0; batch < BatchCount; ++batch)
        {
            start = Stopwatch.GetTimestamp();
            for (int i = 0; i < repetitions; ++i)
                test();
            least = Math.Min(least, Stopwatch.GetElapsedTime(start).TotalNanoseconds);
        }
        return (least / ((double)repetitions * pairCount), contacts);
    }
}
