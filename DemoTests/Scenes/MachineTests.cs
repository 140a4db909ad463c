using System.Linq;
using Demos.Accuracy;
using Demos.Mechanisms;
using Xunit;

namespace DemoTests.Scenes;

/// <summary>Machines of joints do what machines do, as a game gets them that asks for nothing.</summary>
public class MachineTests
{
    public static TheoryData<string> Names => new(MechanismLibrary.All.Select(machine => machine.Name));

    [Theory, MemberData(nameof(Names))]
    public void What_must_be_true_of_a_machine_is(string name)
    {
        using var mechanism = MechanismLibrary.All.Single(machine => machine.Name == name).Create(new AccuracySettings());
        mechanism.Run();
        Assert.All(mechanism.Findings, finding => Assert.True(finding.Holds, $"{finding.What}: {finding.Figure}, not {finding.Least} to {finding.Most}"));
    }
}
