using BenchmarkDotNet.Running;
using Benchmarks.Compare;

if (args is ["compare", ..])
    return CompareCommand.Run(args[1..]);
BenchmarkSwitcher.FromAssembly(typeof(CompareCommand).Assembly).Run(args);
return 0;
