using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;

namespace Demos.Accuracy.Cases;

/// <summary>A stack of ten under all step lengths, changing ones among them (X5), and under all gravities (X6). Reported.</summary>
static class StepCases
{
    const double Duration = 5;

    public static IEnumerable<AccuracyCase> All { get; } =
    [
        .. new[] { 15, 30, 60, 120, 240, 1000 }.SelectMany(stepsPerSecond => AccuracySuite.AtBothEfforts("X5", $"dt 1/{stepsPerSecond}",
            (settings, result) => Run(settings with { Dt = 1f / stepsPerSecond }, result, world => world.Run(Duration)))),
        .. AccuracySuite.AtBothEfforts("X5", "dt changing, 1/30 to 1/240", (settings, result) => Run(settings, result, Stutter)),
        .. new[] { 0f, 1, 100, 1000 }.SelectMany(gravity => AccuracySuite.AtBothEfforts("X6", FormattableString.Invariant($"gravity {gravity} m/s2"),
            (settings, result) => Run(settings with { Gravity = new Vector3(0, -gravity, 0) }, result, world => world.Run(Duration)))),
    ];

    static void Run(AccuracySettings settings, CaseResult result, Action<AccuracyWorld> run)
    {
        using var world = new AccuracyWorld(settings);
        world.AddGround();
        var stack = Stack.OfEqual(world, 10);
        run(world);
        result.Limit("loss", stack.Loss, .1, "m").Limit("drift", stack.Drift, .05, "m");
    }

    static void Stutter(AccuracyWorld world)
    {
        for (int i = 0; world.Time < Duration; ++i)
            world.Step(StutteringSteps.Duration(i));
    }
}
