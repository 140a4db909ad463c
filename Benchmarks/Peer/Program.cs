using Benchmarks.Pairs.Shared;
using Demos.Terminal;

return args is [PairTimesCommand.Word, string cases, string results] ? PairTimesCommand.Run(cases, results) : DemosCommand.Run(args);
