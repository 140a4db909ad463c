using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Demos.References;

namespace Demos.Accuracy.Cases;

/// <summary>A solid sphere rolls down a slope, and slides until it rolls (C2).</summary>
static class RollingCases
{
    const double Gravity = 9.81f;
    const double Radius = .5;

    public static IEnumerable<AccuracyCase> All { get; } =
    [
        .. AccuracySuite.AtBothEfforts("C2", "rolling on 20 degrees", RunDownTwentyDegrees),
        .. new[] { .5f, .1f }.SelectMany(friction => AccuracySuite.AtBothEfforts("C2", FormattableString.Invariant($"sliding to rolling, mu {friction}"),
            (settings, result) => RunSlidingUntilItRolls(settings, friction, result))),
    ];

    static void RunDownTwentyDegrees(AccuracySettings settings, CaseResult result)
    {
        double angle = Math.PI / 9;
        using var world = new AccuracyWorld(settings);
        var slope = new Incline(world, angle);
        var body = world.AddDynamic(new Sphere((float)Radius), 1, slope.Pose(0, Radius));
        var start = world.Position(body);
        world.Run(5);
        double rolled = Double3.Dot(world.Position(body) - start, slope.Downhill);
        double slip = world.LinearVelocity(body).Length - world.AngularVelocity(body).Length * Radius;
        result.Limit("distance", rolled / SlidingOracle.RollingDistance(Gravity, angle, 5) - 1, .02, "%")
            .Limit("slip", slip / world.LinearVelocity(body).Length, .02, "%");
    }

    static void RunSlidingUntilItRolls(AccuracySettings settings, float friction, CaseResult result)
    {
        const double startSpeed = 5;
        using var world = new AccuracyWorld(settings with { Friction = friction });
        world.AddGround();
        var body = world.AddDynamic(
            new Sphere((float)Radius), 1, new Vector3(0, (float)Radius, 0), new BodyVelocity(new Vector3((float)startSpeed, 0, 0)));
        double onTheWay = 0;
        world.Run(6, () => onTheWay = Tally.Worst(
            onTheWay, world.LinearVelocity(body).X - SlidingOracle.SlidingSphereSpeed(Gravity, friction, startSpeed, world.Time)));
        double speed = world.LinearVelocity(body).X, expected = startSpeed * 5 / 7;
        double distance = SlidingOracle.SlidingSphereDistance(Gravity, friction, startSpeed, world.Time);
        result.Limit("final speed", speed / expected - 1, .02, "%")
            .Limit("slip", (speed + world.AngularVelocity(body).Z * Radius) / expected, .02, "%")
            .Limit("speed on the way", onTheWay / startSpeed, .02, "%")
            .Limit("distance", world.Position(body).X / distance - 1, .02, "%");
    }
}
