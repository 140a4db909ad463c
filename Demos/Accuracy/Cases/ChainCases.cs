using System;
using System.Collections.Generic;
using System.Linq;

namespace Demos.Accuracy.Cases;

/// <summary>A chain of 100 links with a load at its end (J3). Reported: the error depends on how much stiffness the substep allows.</summary>
static class ChainCases
{
    const int LinkCount = 100;

    public static IEnumerable<AccuracyCase> All { get; } = Enum.GetValues<ChainStart>().SelectMany(start => new[] { 1f, 100, 1000 }.SelectMany(load =>
        AccuracySuite.AtBothEfforts("J3", FormattableString.Invariant($"{start}, 1:{load}"), (settings, result) => Run(settings, start, load, result))));

    static void Run(AccuracySettings settings, ChainStart start, float load, CaseResult result)
    {
        using var world = new AccuracyWorld(settings with { Contacts = ContactScope.None });
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
        result.Limit("mean stretch", stretchSum / samples, .01, "%").Limit("worst gap", worst, .02, "m");
    }
}
