using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;

namespace Demos.Accuracy;

/// <summary>The page that holds a row for each case of the suite, those that only tests run among them.</summary>
static class AccuracyPage
{
    const string Heading = """
        # Accuracy, case by case

        Written by `dotnet run -c Release --project Demos -- accuracy --page Docs/Accuracy.md`, which replaces the rows of what it runs and keeps the others.
        What the built-in scenes are there for (R4) is judged by tests only, which write their rows in the same way:
        `PHYSICS_ACCURACY_REPORT=$PWD/Docs/Accuracy.md dotnet test -c Release --filter FullyQualifiedName~ShapeSceneTests`.
        What the families are: [the accuracy suite](../DemoTests/Accuracy/README.md).

        | case | scene | settings | measured | must | verdict |
        |---|---|---|---|---|---|
        """;

    /// <summary>Writes results into a page that need not be there yet; rows of other cases stay.</summary>
    /// <param name="path">The file.</param>
    /// <param name="results">What was measured.</param>
    /// <param name="isWhole">Whether these are all cases of their families at their settings: other rows of these are of cases that are no more.</param>
    public static void Update(string path, IReadOnlyCollection<CaseResult> results, bool isWhole)
    {
        var replaced = results.Select(result => Key(result.Id, result.Scene, result.Settings)).ToHashSet();
        string[] lines = File.Exists(path) ? File.ReadAllLines(path) : [];
        IEnumerable<string> kept = lines.SkipWhile(line => !line.StartsWith("|---", StringComparison.Ordinal)).Skip(1).Where(line =>
        {
            string[] cells = line.Split('|', StringSplitOptions.TrimEntries);
            return cells.Length > 3 && !replaced.Contains(Key(cells[1], cells[2], cells[3]));
        });
        string[] rows = [.. kept.Concat(results.Select(result => result.Row)).Order(StringComparer.Ordinal)];
        File.WriteAllText(path, $"{Heading.ReplaceLineEndings("\n")}\n{string.Join('\n', rows)}\n");

        (string, string, string) Key(string id, string scene, string settings) => (id, isWhole ? "" : scene, settings);
    }
}
