using System.Globalization;
using System.IO;

namespace Benchmarks.Sweeps.Shared;

/// <summary>Measures sweeps with the engine that this program is compiled against.</summary>
static class SweepTimesCommand
{
    /// <summary>The word on the command line; then the file for the figures.</summary>
    public const string Word = "sweep-times";

    /// <summary>Measures and returns the exit status.</summary>
    public static int Run(string resultPath)
    {
        using var writer = new StreamWriter(resultPath);
        Write(writer, QuickestTime.CaseCount);
        return 0;
    }

    /// <summary>Measures so many sweeps of each kind.</summary>
    public static void Write(TextWriter writer, int caseCount)
    {
        foreach (var name in SweepWorld.Names)
        {
            using var world = new SweepWorld(name);
            foreach (var shape in SweepWorld.Shapes)
            {
                foreach (var motion in SweepWorld.Motions)
                {
                    var cases = world.CreateCases(shape, motion, caseCount);
                    var time = QuickestTime.Of(cases, (in SweepWorld.Case sweep) => world.Sweep(shape, sweep).IsHit ? 1 : 0, out var hits);
                    writer.WriteLine(string.Create(CultureInfo.InvariantCulture, $"{name},{shape},{motion},{time:R},{hits:R}"));
                }
            }
        }
    }
}
