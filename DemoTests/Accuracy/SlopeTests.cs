using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Accuracy;

/// <summary>Dry friction on a slope (C1, C1c).</summary>
public class SlopeTests(ITestOutputHelper output)
{
    [Theory, SuiteData("C1", "C1c")]
    public void Case(string name) => SuiteCases.Judge(name, output);
}
