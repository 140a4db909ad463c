using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Demos.References;

namespace Demos.Accuracy.Cases;

/// <summary>Sizes from a millimetre to a kilometre in one scene (X1), masses from a milligram to a kiloton (X2).</summary>
static class ScaleCases
{
    static readonly float[] sizes = [.001f, .01f, .1f, 1, 10, 100, 1000];

    public static IEnumerable<AccuracyCase> All { get; } =
    [
        .. sizes.SelectMany(size => AccuracySuite.AtBothEfforts("X1", FormattableString.Invariant($"cubes of {size} m"),
            (settings, result) => RunSizes(settings, size, result))),
        .. AccuracySuite.AtBothEfforts("X2", "boxes of 1e-6 to 1e6 kg", RunMasses),
    ];

    /// <summary>Simulates cubes of all sizes at once, and judges those of one.</summary>
    static void RunSizes(AccuracySettings settings, float judged, CaseResult result)
    {
        using var world = new AccuracyWorld(settings);
        world.AddGround(extent: 20_000);
        Stack? single = null, five = null;
        float x = 0;
        foreach (float size in sizes)
        {
            x += 2 * size;
            float mass = 1000 * size * size * size;
            var one = Stack.OfEqual(world, 1, new Vector3(x, 0, -size), size, mass);
            var more = Stack.OfEqual(world, 5, new Vector3(x, 0, size), size, mass);
            if (size == judged)
                (single, five) = (one, more);
        }
        world.Run(5);
        result.Limit("sink of one", single!.RelativeLoss, .02, "%")
            .Limit("drift of one", single.RelativeDrift, .05, "%")
            .Limit("loss of five", five!.RelativeLoss, .1, "%")
            .Limit("drift of five", five.RelativeDrift, .05, "%");
    }

    static void RunMasses(AccuracySettings settings, CaseResult result)
    {
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
        result.Limit("moved", moved, .01, "m").Limit("speed", speed, .01, "m/s");
    }
}
