using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Accuracy;

/// <summary>Bodies that begin inside each other part calmly (X7).</summary>
public class OverlapTests(ITestOutputHelper output)
{
    [Theory, SuiteData("X7")]
    public void Case(string name) => SuiteCases.Judge(name, output);
}
