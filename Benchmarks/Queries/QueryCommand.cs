using Benchmarks.Queries.Shared;
using Benchmarks.Sweeps;

namespace Benchmarks.Queries;

/// <summary>Measures what rays, overlaps, contacts and distances in a world of statics cost in this engine and in a peer.</summary>
static class QueryCommand
{
    /// <summary>Reads the arguments after the word queries, measures, and returns the exit status.</summary>
    public static int Run(string[] arguments) =>
        new WorldTimes("a query", QueryTimesCommand.Word, "world", "query", "shape").Run(arguments);
}
