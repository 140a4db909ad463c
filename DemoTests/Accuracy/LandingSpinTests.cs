using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Accuracy;

/// <summary>What spins and lands (C9).</summary>
public class LandingSpinTests(ITestOutputHelper output)
{
    [Theory, SuiteData("C9")]
    public void Case(string name) => SuiteCases.Judge(name, output);
}
