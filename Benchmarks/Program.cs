using BenchmarkDotNet.Running;
using Benchmarks.Compare;
using Benchmarks.Joints;
using Benchmarks.Marked;
using Benchmarks.Pairs;
using Benchmarks.Pairs.Shared;
using Benchmarks.Queries;
using Benchmarks.Queries.Shared;
using Benchmarks.Smoke;
using Benchmarks.Sweeps;
using Benchmarks.Sweeps.Shared;

return args switch
{
    ["compare", ..] => CompareCommand.Run(args[1..]),
    ["joints", ..] => JointCommand.Run(args[1..]),
    ["marked", ..] => MarkedCommand.Run(args[1..]),
    ["pairs", ..] => PairCommand.Run(args[1..]),
    [PairTimesCommand.Word, string cases, string results] => PairTimesCommand.Run(cases, results),
    ["sweeps", ..] => SweepCommand.Run(args[1..]),
    [SweepTimesCommand.Word, string results] => SweepTimesCommand.Run(results),
    ["queries", ..] => QueryCommand.Run(args[1..]),
    [QueryTimesCommand.Word, string results] => QueryTimesCommand.Run(results),
    ["smoke"] => SmokeCommand.Run(),
    _ => Measure(args),
};

static int Measure(string[] arguments)
{
    BenchmarkSwitcher.FromAssembly(typeof(CompareCommand).Assembly).Run(arguments);
    return 0;
}
