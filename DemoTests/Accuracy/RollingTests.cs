using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Accuracy;

/// <summary>What rolls (C2): spheres, cylinders and prisms.</summary>
public class RollingTests(ITestOutputHelper output)
{
    [Theory, SuiteData("C2")]
    public void Case(string name) => SuiteCases.Judge(name, output);
}
