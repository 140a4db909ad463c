using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Accuracy;

/// <summary>Bodies that touch nothing (I1, I2, I2b, I3).</summary>
public class FreeFlightTests(ITestOutputHelper output)
{
    [Theory, SuiteData("I1", "I2", "I2b", "I3")]
    public void Case(string name) => SuiteCases.Judge(name, output);
}
