using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Accuracy;

/// <summary>A light body with many arms gains no energy (E2).</summary>
public class HubTests(ITestOutputHelper output)
{
    [Theory, SuiteData("E2")]
    public void Case(string name) => SuiteCases.Judge(name, output);
}
