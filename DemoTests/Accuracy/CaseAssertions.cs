using Demos.Accuracy;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Accuracy;

/// <summary>Judges results of the suite in tests.</summary>
static class CaseAssertions
{
    /// <summary>Writes the row; all figures must be finite, and within their limits when they are enforced.</summary>
    public static void Finish(this CaseResult result, ITestOutputHelper output, bool enforce)
    {
        output.WriteLine(result.Row(enforce));
        AccuracyReport.Add(result.Row(enforce));
        string? failure = result.Failure(enforce);
        Assert.True(failure is null, failure);
    }
}
