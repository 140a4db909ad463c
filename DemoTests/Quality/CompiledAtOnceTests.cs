using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.IO;
using System.Linq;
using Demos.Terminal;
using Xunit;

namespace DemoTests.Quality;

/// <summary>The libraries are compiled with all optimizations at once, in a program that compiles in tiers too, as all do by default.</summary>
public sealed class CompiledAtOnceTests : IDisposable
{
    readonly string report = Path.GetTempFileName();

    /// <inheritdoc/>
    public void Dispose() => File.Delete(report);

    [Fact]
    public void No_method_but_constructors_waits_for_a_later_tier()
    {
        if (JitWatch.BuildIsUnoptimized)
            return;
        // The runtime writes a line for each method that it compiles: "12: JIT compiled Class:Method(types) [Tier0, IL size=..., code size=...]".
        string[] arguments = [typeof(DemosCommand).Assembly.Location, "run", "ragdolls", "--steps", "40"];
        var start = new ProcessStartInfo("dotnet", arguments) { RedirectStandardOutput = true };
        start.Environment["DOTNET_TieredCompilation"] = "1";
        start.Environment["DOTNET_JitDisasmSummary"] = "1";
        start.Environment["DOTNET_JitStdOutFile"] = report;
        using Process process = Process.Start(start)!;
        process.StandardOutput.ReadToEnd();
        process.WaitForExit();
        Assert.Equal(0, process.ExitCode);

        List<string> own = [.. File.ReadLines(report).Where(IsOfTheLibraries)];
        // Whether there is anything to see: tiers are on, and a scene of ragdolls is compiled.
        Assert.Contains(File.ReadLines(report), line => line.Contains("[Tier0", StringComparison.Ordinal));
        Assert.True(own.Count > 300);
        Assert.All(own, line => Assert.Contains("[FullOpts", line, StringComparison.Ordinal));
    }

    static bool IsOfTheLibraries(string line)
    {
        const string compiled = "JIT compiled ";
        int start = line.IndexOf(compiled, StringComparison.Ordinal);
        if (start < 0)
            return false;
        ReadOnlySpan<char> method = line.AsSpan(start + compiled.Length);
        bool isConstructor = method.Contains(":.ctor(", StringComparison.Ordinal) || method.Contains(":.cctor(", StringComparison.Ordinal);
        return !isConstructor && (method.StartsWith("BepuPhysics.") || method.StartsWith("BepuUtilities."));
    }
}
