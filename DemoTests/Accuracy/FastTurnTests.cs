using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Accuracy;

/// <summary>What turns far within a step gains no energy (E1).</summary>
public class FastTurnTests(ITestOutputHelper output)
{
    [Theory, SuiteData("E1")]
    public void Case(string name) => SuiteCases.Judge(name, output);
}
