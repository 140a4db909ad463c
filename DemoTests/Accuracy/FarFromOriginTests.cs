using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Accuracy;

/// <summary>Scenes far away from the origin (X4).</summary>
public class FarFromOriginTests(ITestOutputHelper output)
{
    [Theory, SuiteData("X4")]
    public void Case(string name) => SuiteCases.Judge(name, output);
}
