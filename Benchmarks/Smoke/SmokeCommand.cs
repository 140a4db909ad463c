using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.IO;
using System.Linq;
using Benchmarks.Queries.Shared;
using Benchmarks.Sweeps.Shared;

namespace Benchmarks.Smoke;

/// <summary>
/// Calls every benchmark once, with each choice of its parameters, in this process: shows in seconds that all of them still run.
/// Its times include setup and compilation and are no measurements.
/// </summary>
static class SmokeCommand
{
    // What is timed beside a peer, with few cases.
    static readonly (string Name, Action Run)[] timers =
    [
        ("sweeps", () => SweepTimesCommand.Write(TextWriter.Null, 10)),
        ("queries", () => QueryTimesCommand.Write(TextWriter.Null, 10)),
    ];

    /// <summary>Runs all benchmarks and returns the exit status.</summary>
    public static int Run()
    {
        int passed = 0, failed = 0;
        IEnumerable<(string Name, Action Run)> subjects =
            SmokeCase.FindAll(typeof(SmokeCommand).Assembly).Select(subject => (subject.Name, (Action)subject.Run));
        foreach ((string name, Action run) in subjects.Concat(timers))
        {
            long start = Stopwatch.GetTimestamp();
            string verdict;
            try
            {
                run();
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
            Console.WriteLine($"{name}: {verdict}, {Stopwatch.GetElapsedTime(start).TotalMilliseconds:F0} ms");
        }
        Console.WriteLine($"{passed} passed, {failed} failed");
        return failed == 0 && passed > 0 ? 0 : 1;
    }
}
