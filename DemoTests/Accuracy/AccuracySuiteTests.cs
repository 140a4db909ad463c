using System.Linq;
using Demos.Accuracy;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Accuracy;

/// <summary>Judges the cases that <c>Demos accuracy</c> runs.</summary>
public class AccuracySuiteTests(ITestOutputHelper output)
{
    public static TheoryData<string> Cases => [.. AccuracySuite.All.Select(subject => subject.Name)];

    [Theory, MemberData(nameof(Cases))]
    public void Case(string name)
    {
        AccuracyCase subject = AccuracySuite.All.Single(subject => subject.Name == name);
        subject.Measure().Finish(output);
    }
}
