using BenchmarkDotNet.Running;
using Benchmarks.Compare;
using Benchmarks.Smoke;

return args switch
{
    ["compare", ..] => CompareCommand.Run(args[1..]),
    ["smoke"] => SmokeCommand.Run(),
    _ => Measure(args),
};

static int Measure(string[] arguments)
{
    BenchmarkSwitcher.FromAssembly(typeof(CompareCommand).Assembly).Run(arguments);
    return 0;
}
