using System.Collections.Generic;
using System.Linq;
using Demos.Accuracy;
using Xunit.Abstractions;

namespace DemoTests.Accuracy;

/// <summary>Judges the cases that <c>Demos accuracy</c> runs, one by one.</summary>
static class SuiteCases
{
    static readonly Dictionary<string, AccuracyCase> byName = AccuracySuite.All.ToDictionary(subject => subject.Name);

    public static void Judge(string name, ITestOutputHelper output) => byName[name].Measure().Finish(output);
}
