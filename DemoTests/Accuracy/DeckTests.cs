using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Accuracy;

/// <summary>What stands on a deck that rolls and on the wall of a drum (C12).</summary>
public class DeckTests(ITestOutputHelper output)
{
    [Theory, SuiteData("C12")]
    public void Case(string name) => SuiteCases.Judge(name, output);
}
