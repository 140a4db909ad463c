using Benchmarks.Sweeps.Shared;

namespace Benchmarks.Sweeps;

/// <summary>Measures what sweeping a shape through a world of statics costs in this engine and in a peer.</summary>
static class SweepCommand
{
    /// <summary>Reads the arguments after the word sweeps, measures, and returns the exit status.</summary>
    public static int Run(string[] arguments) =>
        new WorldTimes("a sweep", SweepTimesCommand.Word, "world", "shape", "motion").Run(arguments);
}
