using Benchmarks.Compare;
using BenchmarkDotNet.Running;

if (args is ["compare", ..])
    return CompareCommand.Run(args[1..]);
BenchmarkSwitcher.FromAssembly(typeof(CompareCommand).Assembly).Run(args);
return 0;
