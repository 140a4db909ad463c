using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Accuracy;

/// <summary>Sizes from a millimetre to a kilometre in one scene (X1), masses from a milligram to a kiloton (X2).</summary>
public class ScaleTests(ITestOutputHelper output)
{
    [Theory, SuiteData("X1", "X2")]
    public void Case(string name) => SuiteCases.Judge(name, output);
}
