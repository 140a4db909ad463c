using System.Collections.Generic;
using System.Globalization;

namespace Benchmarks.Compare;

/// <summary>One thing to measure: both programs run it with the same arguments.</summary>
/// <param name="Scene">Name of a built-in scene, or path of a scene file.</param>
/// <param name="Iterations">Velocity iterations per substep.</param>
/// <param name="Substeps">Substeps per step.</param>
/// <param name="Threads">Threads that a step may use.</param>
/// <param name="Lanes">Floats in a vector; null for what the machine prefers.</param>
sealed record CompareCase(string Scene, int Iterations, int Substeps, int Threads, int? Lanes)
{
    /// <summary>Settings as they are written in tables: iterations x substeps.</summary>
    public string Settings => $"{Iterations}x{Substeps}";

    /// <summary>Arguments of the run, without the file that the figures go to.</summary>
    public List<string> Arguments(int? frames, int? warmup, bool? sleep)
    {
        List<string> arguments =
        [
            "run", Scene, "--iterations", Text(Iterations), "--substeps", Text(Substeps), "--threads", Text(Threads),
        ];
        if (frames is int steps)
            arguments.AddRange(["--steps", Text(steps)]);
        if (warmup is int unmeasured)
            arguments.AddRange(["--warmup", Text(unmeasured)]);
        if (sleep is bool maySleep)
            arguments.AddRange(["--sleep", maySleep ? "true" : "false"]);
        return arguments;
    }

    static string Text(int number) => number.ToString(CultureInfo.InvariantCulture);
}
