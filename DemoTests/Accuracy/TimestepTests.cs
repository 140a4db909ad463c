using System;
using System.Numerics;
using Demos.Accuracy;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Accuracy;

/// <summary>A stack of ten under all step lengths, changing ones among them (X5), and under all gravities (X6). Reported.</summary>
public class TimestepTests(ITestOutputHelper output)
{
    const double Duration = 5;

    [Theory]
    [InlineData(15, Effort.Accurate)]
    [InlineData(30, Effort.Accurate)]
    [InlineData(60, Effort.Accurate)]
    [InlineData(120, Effort.Accurate)]
    [InlineData(240, Effort.Accurate)]
    [InlineData(1000, Effort.Accurate)]
    [InlineData(15, Effort.Default)]
    [InlineData(30, Effort.Default)]
    [InlineData(60, Effort.Default)]
    [InlineData(120, Effort.Default)]
    [InlineData(240, Effort.Default)]
    [InlineData(1000, Effort.Default)]
    public void X5_StepLength(int stepsPerSecond, Effort effort)
    {
        var settings = AccuracySettings.For(effort) with { Dt = 1f / stepsPerSecond };
        using var world = new AccuracyWorld(settings);
        world.AddGround();
        var stack = Stack.OfEqual(world, 10);
        world.Run(Duration);
        Report("X5", $"dt 1/{stepsPerSecond}", settings, stack);
    }

    [Theory]
    [InlineData(Effort.Accurate)]
    [InlineData(Effort.Default)]
    public void X5_ChangingStepLength(Effort effort)
    {
        var settings = AccuracySettings.For(effort);
        using var world = new AccuracyWorld(settings);
        world.AddGround();
        var stack = Stack.OfEqual(world, 10);
        // Jumps of up to four times from one step to the next, as of a game that stutters.
        ReadOnlySpan<int> stepsPerSecond = [60, 120, 60, 30, 90, 144, 45, 60, 240, 75, 100, 30, 120];
        for (int i = 0; world.Time < Duration; ++i)
            world.Step(1f / stepsPerSecond[i % stepsPerSecond.Length]);
        Report("X5", "dt changing, 1/30 to 1/240", settings, stack);
    }

    [Theory]
    [InlineData(0, Effort.Accurate)]
    [InlineData(1, Effort.Accurate)]
    [InlineData(100, Effort.Accurate)]
    [InlineData(1000, Effort.Accurate)]
    [InlineData(0, Effort.Default)]
    [InlineData(1, Effort.Default)]
    [InlineData(100, Effort.Default)]
    [InlineData(1000, Effort.Default)]
    public void X6_Gravity(float gravity, Effort effort)
    {
        var settings = AccuracySettings.For(effort) with { Gravity = new Vector3(0, -gravity, 0) };
        using var world = new AccuracyWorld(settings);
        world.AddGround();
        var stack = Stack.OfEqual(world, 10);
        world.Run(Duration);
        Report("X6", FormattableString.Invariant($"gravity {gravity} m/s2"), settings, stack);
    }

    void Report(string id, string scene, AccuracySettings settings, Stack stack) => new CaseResult(id, scene, settings)
        .Limit("loss", stack.Loss, .1, "m")
        .Limit("drift", stack.Drift, .05, "m")
        .Finish(output, enforce: false);
}
