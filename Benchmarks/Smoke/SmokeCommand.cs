using System;
using System.Diagnostics;

namespace Benchmarks.Smoke;

/// <summary>
/// Calls every benchmark once, with each choice of its parameters, in this process: shows in seconds that all of them still run.
/// Its times include setup and compilation and are no measurements.
/// </summary>
static class SmokeCommand
{
    /// <summary>Runs all benchmarks and returns the exit status.</summary>
    public static int Run()
    {
        int passed = 0, failed = 0;
        foreach (SmokeCase subject in SmokeCase.FindAll(typeof(SmokeCommand).Assembly))
        {
            long start = Stopwatch.GetTimestamp();
            string verdict;
            try
            {
                subject.Run();
                ++passed;
                verdict = "passed";
            }
            // Whatever a benchmark throws is its failure, and the others are still to be run.
#pragma warning disable CA1031
            catch (Exception error)
#pragma warning restore CA1031
            {
                ++failed;
                verdict = $"FAILED {error}";
            }
            Console.WriteLine($"{subject.Name}: {verdict}, {Stopwatch.GetElapsedTime(start).TotalMilliseconds:F0} ms");
        }
        Console.WriteLine($"{passed} passed, {failed} failed");
        return failed == 0 && passed > 0 ? 0 : 1;
    }
}
