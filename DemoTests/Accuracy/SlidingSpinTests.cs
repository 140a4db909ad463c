using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Accuracy;

/// <summary>What lies flat, slides and turns (C13).</summary>
public class SlidingSpinTests(ITestOutputHelper output)
{
    [Theory, SuiteData("C13")]
    public void Case(string name) => SuiteCases.Judge(name, output);
}
