using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Accuracy;

/// <summary>What goes round, on an orbit and on an arm (C11).</summary>
public class GoingRoundTests(ITestOutputHelper output)
{
    [Theory, SuiteData("C11")]
    public void Case(string name) => SuiteCases.Judge(name, output);
}
