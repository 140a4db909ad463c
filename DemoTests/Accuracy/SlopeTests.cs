using System;
using BepuPhysics.Collidables;
using DemoTests.Support;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Accuracy;

/// <summary>
/// Dry friction on a slope: a box just below and just above the angle of friction (C1), the coefficient that shapes really get (C1c).
/// </summary>
public class SlopeTests(ITestOutputHelper output)
{
    const double Gravity = 9.81f;
    const double Friction = .5;
    const double Duration = 5;

    /// <summary>The tangent of the angle as a multiple of the coefficient; 30 degrees is 1.1547 of it.</summary>
    [Theory]
    [InlineData(.98, Effort.Accurate)]
    [InlineData(.995, Effort.Accurate)]
    [InlineData(1.005, Effort.Accurate)]
    [InlineData(1.02, Effort.Accurate)]
    [InlineData(1.1547005383792515, Effort.Accurate)]
    [InlineData(.98, Effort.Default)]
    [InlineData(.995, Effort.Default)]
    [InlineData(1.005, Effort.Default)]
    [InlineData(1.02, Effort.Default)]
    [InlineData(1.1547005383792515, Effort.Default)]
    public void C1_BoxNearTheAngleOfFriction(double ratio, Effort effort)
    {
        var settings = AccuracySettings.For(effort);
        double angle = Math.Atan(Friction * ratio);
        double slid = SlidDistance("box", angle, settings);
        double expected = SlidingOracle.SlopeDistance(Gravity, angle, Friction, Duration);
        var result = new CaseResult("C1", FormattableString.Invariant($"box, tan = {ratio:F3} mu"), settings);
        if (ratio < 1)
            result.Limit("creep", slid, .001, "m");
        else
            result.Limit("distance", slid / expected - 1, .05, "%").Note("slid", slid, "m");
        result.Finish(output, enforce: effort == Effort.Accurate);
    }

    /// <summary>Both where sliding is slow, so that the coefficient is known to a tenth of a percent, and where it is fast.</summary>
    [Theory]
    [InlineData("box", Effort.Accurate)]
    [InlineData("turned box", Effort.Accurate)]
    [InlineData("flat box", Effort.Accurate)]
    [InlineData("capsule", Effort.Accurate)]
    [InlineData("box on kinematic", Effort.Accurate)]
    [InlineData("capsule on kinematic", Effort.Accurate)]
    [InlineData("box", Effort.Default)]
    [InlineData("turned box", Effort.Default)]
    [InlineData("flat box", Effort.Default)]
    [InlineData("capsule", Effort.Default)]
    [InlineData("box on kinematic", Effort.Default)]
    [InlineData("capsule on kinematic", Effort.Default)]
    public void C1c_EffectiveFriction(string shape, Effort effort)
    {
        var settings = AccuracySettings.For(effort);
        double steep = Math.PI / 6, shallow = Math.Atan(Friction * 1.05);
        double atSteep = SlidingOracle.EffectiveFriction(Gravity, steep, SlidDistance(shape, steep, settings), Duration);
        double atShallow = SlidingOracle.EffectiveFriction(Gravity, shallow, SlidDistance(shape, shallow, settings), Duration);
        new CaseResult("C1c", shape.Contains(" on ", StringComparison.Ordinal) ? shape : $"{shape} on box", settings)
            .Limit("error at 30 degrees", atSteep / Friction - 1, .02, "%")
            .Limit("error at 1.05 mu", atShallow / Friction - 1, .02, "%")
            .Note("mu", atSteep)
            .Finish(output, enforce: effort == Effort.Accurate);
    }

    /// <summary>Way down the slope in five seconds from rest, starting in contact.</summary>
    static double SlidDistance(string shape, double angle, AccuracySettings settings)
    {
        using var world = new AccuracyWorld(settings with { Friction = (float)Friction });
        // A kinematic slope has contacts with two bodies, a static one with one.
        var slope = new Slope(world, angle, kinematic: shape.EndsWith("kinematic", StringComparison.Ordinal));
        var body = shape switch
        {
            "box" or "box on kinematic" => world.AddDynamic(new Box(1, .6f, .8f), 1, slope.Pose(0, .3)),
            "turned box" => world.AddDynamic(new Box(1, .6f, .8f), 1, slope.TurnedPose(.3, .5)),
            "flat box" => world.AddDynamic(new Box(2, .05f, 1), 20, slope.Pose(0, .025)),
            "capsule" or "capsule on kinematic" => world.AddDynamic(new Capsule(.2f, .8f), 1, slope.LyingPose(.2)),
            _ => throw new ArgumentOutOfRangeException(nameof(shape), shape, null),
        };
        var start = world.Position(body);
        world.Run(Duration);
        return Double3.Dot(world.Position(body) - start, slope.Downhill);
    }
}
