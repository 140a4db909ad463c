using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Accuracy;

/// <summary>What lies flat (C13) or stands on feet (C14), slides and turns.</summary>
public class SlidingSpinTests(ITestOutputHelper output)
{
    [Theory, SuiteData("C13")]
    public void Case(string name) => SuiteCases.Judge(name, output);

    [Theory, SuiteData("C14")]
    public void On_feet(string name) => SuiteCases.Judge(name, output);
}
