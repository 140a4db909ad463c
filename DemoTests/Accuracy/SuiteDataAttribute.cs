using System;
using System.Collections.Generic;
using System.Linq;
using System.Reflection;
using Demos.Accuracy;
using Xunit.Sdk;

namespace DemoTests.Accuracy;

/// <summary>Names of the suite's cases of some families, as data of a theory.</summary>
[AttributeUsage(AttributeTargets.Method)]
sealed class SuiteDataAttribute(params string[] families) : DataAttribute
{
    public IReadOnlyList<string> Families => families;

    public override IEnumerable<object[]> GetData(MethodInfo testMethod) =>
        AccuracySuite.All.Where(subject => families.Contains(subject.Id)).Select(subject => new object[] { subject.Name });
}
