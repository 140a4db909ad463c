using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Demos.Accuracy;
using Demos.References;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Accuracy;

/// <summary>Sizes from a millimetre to a kilometre in one scene (X1, reported), masses from a milligram to a kiloton (X2).</summary>
public class ScaleTests(ITestOutputHelper output)
{
    [Theory]
    [InlineData(Effort.Accurate)]
    [InlineData(Effort.Default)]
    public void X1_CubesOfAllSizes(Effort effort)
    {
        var settings = AccuracySettings.For(effort);
        using var world = new AccuracyWorld(settings);
        world.AddGround(extent: 20_000);
        var columns = new List<(float Size, Stack Single, Stack Five)>();
        float x = 0;
        foreach (float size in new[] { .001f, .01f, .1f, 1, 10, 100, 1000 })
        {
            x += 2 * size;
            float mass = 1000 * size * size * size;
            var single = Stack.OfEqual(world, 1, new Vector3(x, 0, -size), size, mass);
            columns.Add((size, single, Stack.OfEqual(world, 5, new Vector3(x, 0, size), size, mass)));
        }
        world.Run(5);
        foreach (var (size, single, five) in columns)
        {
            new CaseResult("X1", FormattableString.Invariant($"cubes of {size} m"), settings)
                .Limit("sink of one", single.RelativeLoss, .02, "%")
                .Limit("drift of one", single.RelativeDrift, .05, "%")
                .Limit("loss of five", five.RelativeLoss, .1, "%")
                .Limit("drift of five", five.RelativeDrift, .05, "%")
                .Finish(output);
        }
    }

    [Theory]
    [InlineData(Effort.Accurate)]
    [InlineData(Effort.Default)]
    public void X2_BoxesOfAllMasses(Effort effort)
    {
        var settings = AccuracySettings.For(effort);
        using var world = new AccuracyWorld(settings);
        world.AddGround();
        var boxes = new List<(BodyHandle Body, Double3 Start)>();
        for (int i = 0; i < 13; ++i)
        {
            var body = world.AddDynamic(new Box(1, 1, 1), MathF.Pow(10, i - 6), new RigidPose(new Vector3(3 * (i - 6), .5f, 0)));
            boxes.Add((body, world.Position(body)));
        }
        double moved = 0, speed = 0;
        world.Run(10, () =>
        {
            foreach (var (body, start) in boxes)
            {
                moved = Tally.Most(moved, (world.Position(body) - start).Length);
                if (world.Time > 1)
                    speed = Tally.Most(speed, world.LinearVelocity(body).Length);
            }
        });
        new CaseResult("X2", "boxes of 1e-6 to 1e6 kg", settings)
            .Limit("moved", moved, .01, "m")
            .Limit("speed", speed, .01, "m/s")
            .Finish(output);
    }
}
