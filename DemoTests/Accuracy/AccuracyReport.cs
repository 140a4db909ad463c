using System;
using System.Collections.Generic;
using System.IO;
using System.Threading;

namespace DemoTests.Accuracy;

/// <summary>
/// Collects the rows of a test run. When the environment variable PHYSICS_ACCURACY_REPORT names a file, the sorted table is kept there.
/// </summary>
static class AccuracyReport
{
    const string Header = "| case | scene | settings | measured | must | verdict |\n|---|---|---|---|---|---|\n";
    static readonly SortedSet<string> rows = new(StringComparer.Ordinal);
    static readonly Lock gate = new();

    public static void Add(string row)
    {
        lock (gate)
        {
            rows.Add(row);
            // Written again with each row: a run that is stopped, or dies, leaves what it has measured.
            if (Environment.GetEnvironmentVariable("PHYSICS_ACCURACY_REPORT") is { Length: > 0 } path)
                File.WriteAllText(path, Header + string.Join('\n', rows) + '\n');
        }
    }
}
