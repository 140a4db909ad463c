using Demos.Accuracy;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Accuracy;

/// <summary>Judges results of the suite in tests.</summary>
static class CaseAssertions
{
    /// <summary>Writes the row; all figures must be finite, and within their limits where these are not known to be missed.</summary>
    public static void Finish(this CaseResult result, ITestOutputHelper output)
    {
        output.WriteLine(result.Row);
        AccuracyReport.Add(result);
        Assert.True(result.Failure is null, result.Failure);
    }
}
