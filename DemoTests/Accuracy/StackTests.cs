using System;
using System.Linq;
using Demos.Accuracy;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Accuracy;

/// <summary>Tall stacks (C5) and heavy on light (C6). Reported, not judged: they ask for more than a sequential solver can do.</summary>
public class StackTests(ITestOutputHelper output)
{
    [Theory]
    [InlineData(10, Effort.Accurate)]
    [InlineData(30, Effort.Accurate)]
    [InlineData(100, Effort.Accurate)]
    [InlineData(10, Effort.Default)]
    [InlineData(30, Effort.Default)]
    [InlineData(100, Effort.Default)]
    public void C5_TallStack(int count, Effort effort)
    {
        var settings = AccuracySettings.For(effort);
        using var world = new AccuracyWorld(settings);
        world.AddGround(extent: 400);
        var stack = Stack.OfEqual(world, count);
        world.Run(20);
        new CaseResult("C5", $"stack of {count}", settings)
            .Limit("loss", stack.Loss, .5, "m")
            .Limit("drift", stack.Drift, .1, "m")
            .Finish(output, enforce: false);
    }

    public static TheoryData<int, float, Effort> Loads()
    {
        var loads = new TheoryData<int, float, Effort>();
        foreach (var effort in Enum.GetValues<Effort>())
            foreach (int lightCount in new[] { 1, 10 })
                foreach (float ratio in new[] { 10f, 100, 1000, 10_000 })
                    loads.Add(lightCount, ratio, effort);
        return loads;
    }

    [Theory]
    [MemberData(nameof(Loads))]
    public void C6_HeavyOnLight(int lightCount, float ratio, Effort effort)
    {
        var settings = AccuracySettings.For(effort);
        using var world = new AccuracyWorld(settings);
        world.AddGround();
        var stack = new Stack(world, default, 1, [.. Enumerable.Repeat(1f, lightCount), ratio]);
        world.Run(10);
        new CaseResult("C6", FormattableString.Invariant($"1:{ratio} on {lightCount}"), settings)
            .Limit("sink", stack.Loss, lightCount == 1 ? .02 : .1, "m")
            .Note("drift", stack.Drift, "m")
            .Finish(output, enforce: false);
    }
}
