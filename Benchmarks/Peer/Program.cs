using Benchmarks.Pairs.Shared;
using Benchmarks.Queries.Shared;
using Benchmarks.Sweeps.Shared;
using Demos.Terminal;

return args switch
{
    [PairTimesCommand.Word, string cases, string results] => PairTimesCommand.Run(cases, results),
    [SweepTimesCommand.Word, string results] => SweepTimesCommand.Run(results),
    [QueryTimesCommand.Word, string results] => QueryTimesCommand.Run(results),
    _ => DemosCommand.Run(args),
};
