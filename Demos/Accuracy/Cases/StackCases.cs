using System;
using System.Collections.Generic;
using System.Linq;

namespace Demos.Accuracy.Cases;

/// <summary>Tall stacks (C5) and heavy on light (C6). Reported, not judged: they ask for more than a sequential solver can do.</summary>
static class StackCases
{
    public static IEnumerable<AccuracyCase> All { get; } =
    [
        .. new[] { 10, 30, 100 }.SelectMany(count =>
            AccuracySuite.AtBothEfforts("C5", $"stack of {count}", (settings, result) => RunTall(settings, count, result))),
        .. new[] { 1, 10 }.SelectMany(lightCount => new[] { 10f, 100, 1000, 10_000 }.SelectMany(ratio =>
            AccuracySuite.AtBothEfforts("C6", FormattableString.Invariant($"1:{ratio} on {lightCount}"),
                (settings, result) => RunHeavy(settings, lightCount, ratio, result)))),
    ];

    static void RunTall(AccuracySettings settings, int count, CaseResult result)
    {
        using var world = new AccuracyWorld(settings);
        world.AddGround(extent: 400);
        var stack = Stack.OfEqual(world, count);
        world.Run(20);
        result.Limit("loss", stack.Loss, .5, "m").Limit("drift", stack.Drift, .1, "m");
    }

    static void RunHeavy(AccuracySettings settings, int lightCount, float ratio, CaseResult result)
    {
        using var world = new AccuracyWorld(settings);
        world.AddGround();
        var stack = new Stack(world, default, 1, [.. Enumerable.Repeat(1f, lightCount), ratio]);
        world.Run(10);
        result.Limit("sink", stack.Loss, lightCount == 1 ? .02 : .1, "m").Note("drift", stack.Drift, "m");
    }
}
