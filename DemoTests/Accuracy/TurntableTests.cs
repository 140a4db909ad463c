using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Accuracy;

/// <summary>What stands and rolls on a platform that turns (C10).</summary>
public class TurntableTests(ITestOutputHelper output)
{
    [Theory, SuiteData("C10")]
    public void Case(string name) => SuiteCases.Judge(name, output);
}
