using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics.Collidables;
using Demos.References;

namespace Demos.Accuracy.Cases;

/// <summary>
/// The same scenes, moved away from the origin on all three axes (X4): single-precision positions set the limit.
/// </summary>
static class FarFromOriginCases
{
    public static IEnumerable<AccuracyCase> All { get; } = new[] { 0, 1e3f, 1e4f, 1e5f, 1e6f, 1e7f }.SelectMany(distance =>
        AccuracySuite.AtBothEfforts("X4", FormattableString.Invariant($"at {distance:0e0} m"), (settings, result) => Run(settings, new(distance), result)));

    static void Run(AccuracySettings settings, Vector3 origin, CaseResult result) => result
        .Limit("pendulum period", PendulumPeriodError(settings, origin), .01, "%")
        .Limit("rolling error in 5 m", RollingError(settings, origin), .05, "m")
        .Limit("stack loss", StackChange(settings, origin, out double drift), .05, "m")
        .Limit("stack drift", drift, .05, "m");

    static double PendulumPeriodError(AccuracySettings settings, Vector3 origin)
    {
        using var world = new AccuracyWorld(settings);
        var pendulum = new Pendulum(world, origin);
        world.Run(20, pendulum.Observe);
        return pendulum.Period / Pendulum.TruePeriod - 1;
    }

    /// <summary>Rolls a sphere down 20 degrees for as long as 5 m take.</summary>
    static double RollingError(AccuracySettings settings, Vector3 origin)
    {
        const double angle = Math.PI / 9, gravity = 9.81f;
        using var world = new AccuracyWorld(settings);
        var slope = new Incline(world, angle, origin);
        var body = world.AddDynamic(new Sphere(.5f), 1, slope.Pose(0, .5));
        var start = world.Position(body);
        world.Run(Math.Sqrt(2 * 5 / SlidingOracle.RollingDistance(gravity, angle, Math.Sqrt(2))));
        return Double3.Dot(world.Position(body) - start, slope.Downhill) - SlidingOracle.RollingDistance(gravity, angle, world.Time);
    }

    static double StackChange(AccuracySettings settings, Vector3 origin, out double drift)
    {
        using var world = new AccuracyWorld(settings);
        world.AddGround(origin: origin);
        var stack = Stack.OfEqual(world, 5, origin);
        world.Run(10);
        drift = stack.Drift;
        return stack.Loss;
    }
}
