using System;
using System.Collections.Generic;
using System.Threading;
using Demos.Accuracy;

namespace DemoTests.Accuracy;

/// <summary>
/// Collects the results of a test run. When the environment variable PHYSICS_ACCURACY_REPORT names a file, their rows are kept there, with those that it
/// has of other cases.
/// </summary>
static class AccuracyReport
{
    static readonly List<CaseResult> results = [];
    static readonly Lock gate = new();

    public static void Add(CaseResult result)
    {
        lock (gate)
        {
            results.Add(result);
            // Written again with each row: a run that is stopped, or dies, leaves what it has measured.
            if (Environment.GetEnvironmentVariable("PHYSICS_ACCURACY_REPORT") is { Length: > 0 } path)
                AccuracyPage.Update(path, results, isWhole: false);
        }
    }
}
