using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Accuracy;

/// <summary>Bounces (C3).</summary>
public class RestitutionTests(ITestOutputHelper output)
{
    [Theory, SuiteData("C3")]
    public void Case(string name) => SuiteCases.Judge(name, output);
}
