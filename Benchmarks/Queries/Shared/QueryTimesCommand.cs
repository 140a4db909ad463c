using System.Globalization;
using System.IO;
using Benchmarks.Sweeps.Shared;

namespace Benchmarks.Queries.Shared;

/// <summary>Measures questions to a world with the engine that this program is compiled against.</summary>
static class QueryTimesCommand
{
    /// <summary>The word on the command line; then the file for the figures.</summary>
    public const string Word = "query-times";

    static readonly (string Query, string[] Shapes)[] queries =
    [
        (QueryNames.FirstHit, ["ray"]),
        (QueryNames.AllHits, ["ray"]),
        (QueryNames.Bounds, ["box"]),
        (QueryNames.Overlap, ["sphere", "box", "hull"]),
        (QueryNames.Contacts, ["sphere", "box", "hull"]),
        (QueryNames.Nearest, ["point", "sphere", "box", "hull"]),
    ];

    /// <summary>Measures and returns the exit status.</summary>
    public static int Run(string resultPath)
    {
        using var writer = new StreamWriter(resultPath);
        Write(writer, QuickestTime.CaseCount);
        return 0;
    }

    /// <summary>Measures so many questions of each kind. What an engine cannot be asked takes a time that is no number.</summary>
    public static void Write(TextWriter writer, int caseCount)
    {
        foreach (var name in SweepWorld.Names)
        {
            using var world = new SweepWorld(name);
            var places = world.CreatePlaces(caseCount);
            var rays = world.CreateCases(SweepWorld.Shapes[0], SweepWorld.Motions[0], caseCount);
            foreach (var (query, shapes) in queries)
            {
                foreach (var shape in shapes)
                {
                    double time = double.NaN, answers = double.NaN;
                    if (QueryEngine.Create(world, query, shape) is { } ask)
                        time = QuickestTime.Of(shape == "ray" ? rays : places, ask, out answers);
                    writer.WriteLine(string.Create(CultureInfo.InvariantCulture, $"{name},{query},{shape},{time:R},{answers:R}"));
                }
            }
        }
    }
}
