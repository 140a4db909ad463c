using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Accuracy;

/// <summary>A coin spun on its edge comes to lie flat, and stays so, and gains no energy on the way (R3).</summary>
public class CoinTests(ITestOutputHelper output)
{
    [Theory, SuiteData("R3")]
    public void Case(string name) => SuiteCases.Judge(name, output);
}
