using System;
using System.Numerics;
using BepuPhysics.Collidables;
using Demos.Accuracy;
using Demos.References;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Accuracy;

/// <summary>
/// The same scenes, moved away from the origin on all three axes (X4). Reported: single-precision positions set the limit.
/// </summary>
public class FarFromOriginTests(ITestOutputHelper output)
{
    [Theory]
    [InlineData(0, Effort.Accurate)]
    [InlineData(1e3f, Effort.Accurate)]
    [InlineData(1e4f, Effort.Accurate)]
    [InlineData(1e5f, Effort.Accurate)]
    [InlineData(1e6f, Effort.Accurate)]
    [InlineData(1e7f, Effort.Accurate)]
    [InlineData(0, Effort.Default)]
    [InlineData(1e3f, Effort.Default)]
    [InlineData(1e4f, Effort.Default)]
    [InlineData(1e5f, Effort.Default)]
    [InlineData(1e6f, Effort.Default)]
    [InlineData(1e7f, Effort.Default)]
    public void X4_AwayFromTheOrigin(float distance, Effort effort)
    {
        var settings = AccuracySettings.For(effort);
        var origin = new Vector3(distance);
        new CaseResult("X4", FormattableString.Invariant($"at {distance:0e0} m"), settings)
            .Limit("pendulum period", PendulumPeriodError(settings, origin), .01, "%")
            .Limit("rolling error in 5 m", RollingError(settings, origin), .05, "m")
            .Limit("stack loss", StackChange(settings, origin, out double drift), .05, "m")
            .Limit("stack drift", drift, .05, "m")
            .Finish(output);
    }

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
