using System.Collections.Generic;
using System.Linq;
using System.Reflection;
using Demos.Accuracy;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Accuracy;

/// <summary>Families of the suite that have no tests beside their cases, and that no family is left out.</summary>
public class AccuracySuiteTests(ITestOutputHelper output)
{
    [Theory, SuiteData("C4", "C5", "C6", "C7", "J1", "J3", "X5", "X6")]
    public void Case(string name) => SuiteCases.Judge(name, output);

    [Fact]
    public void Every_family_is_judged_by_one_test()
    {
        IEnumerable<string> judged = typeof(AccuracySuiteTests).Assembly.GetTypes()
            .SelectMany(type => type.GetMethods())
            .SelectMany(method => method.GetCustomAttribute<SuiteDataAttribute>()?.Families ?? []);

        Assert.Equal(AccuracySuite.All.Select(subject => subject.Id).Distinct().Order(), judged.Order());
    }
}
