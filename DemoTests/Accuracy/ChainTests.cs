using System;
using Demos.Accuracy;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Accuracy;

/// <summary>
/// A chain of 100 links with a load at its end (J3). Reported: the error depends on how much stiffness the substep allows.
/// </summary>
public class ChainTests(ITestOutputHelper output)
{
    const int LinkCount = 100;

    public static TheoryData<ChainStart, float, Effort> Chains()
    {
        var chains = new TheoryData<ChainStart, float, Effort>();
        foreach (var effort in Enum.GetValues<Effort>())
            foreach (var start in Enum.GetValues<ChainStart>())
                foreach (float load in new[] { 1f, 100, 1000 })
                    chains.Add(start, load, effort);
        return chains;
    }

    [Theory]
    [MemberData(nameof(Chains))]
    public void J3_LoadedChain(ChainStart start, float load, Effort effort)
    {
        var settings = AccuracySettings.For(effort) with { Contacts = ContactScope.None };
        using var world = new AccuracyWorld(settings);
        var chain = new LoadedChain(world, start, LinkCount, load);
        double stretchSum = 0, worst = 0;
        int samples = 0;
        // The second half counts: by then a hanging chain has settled and a falling one has swung through.
        world.Run(5, () => chain.Gaps(out _, ref worst));
        world.Run(5, () =>
        {
            chain.Gaps(out double stretch, ref worst);
            stretchSum += stretch;
            ++samples;
        });
        new CaseResult("J3", FormattableString.Invariant($"{start}, 1:{load}"), settings)
            .Limit("mean stretch", stretchSum / samples, .01, "%")
            .Limit("worst gap", worst, .02, "m")
            .Finish(output, enforce: false);
    }
}
