using System;
using BepuPhysics;
using BepuPhysics.Collidables;
using Demos.Accuracy;
using Demos.References;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Accuracy;

/// <summary>
/// Dry friction on a slope: bodies just below and just above the angle of friction (C1), the coefficient that shapes really get (C1c).
/// </summary>
public class SlopeTests(ITestOutputHelper output)
{
    const double Gravity = 9.81f;
    const double Friction = .5;
    const double Duration = 5;
    static readonly string[] sliding =
        ["box", "lying capsule", "cylinder", "lying cylinder", "coin", "cube hull", "hexagonal prism", "random hull"];

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
        result.Finish(output);
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
            .Finish(output);
    }

    public static TheoryData<string, string, Effort> ShapesOnFloors()
    {
        var data = new TheoryData<string, string, Effort>();
        foreach (var effort in Enum.GetValues<Effort>())
        {
            foreach (string floor in Floors.Flat)
            {
                foreach (string solid in sliding)
                {
                    // The friction of boxes and capsules on a box is that of the cases above.
                    if (floor != Floors.Box || solid is not ("box" or "lying capsule"))
                        data.Add(solid, floor, effort);
                }
            }
        }
        return data;
    }

    /// <summary>Just below the angle of friction nothing creeps, just above it slides as it should, whatever lies on whatever.</summary>
    [Theory]
    [MemberData(nameof(ShapesOnFloors))]
    public void C1_ShapesNearTheAngleOfFriction(string solid, string floor, Effort effort)
    {
        var settings = AccuracySettings.For(effort);
        double below = Math.Atan(Friction * .98), above = Math.Atan(Friction * 1.02);
        double slid = SlidDistance(solid, floor, above, settings);
        new CaseResult("C1", $"{solid} on {floor}", settings)
            .Limit("creep at .98 mu", SlidDistance(solid, floor, below, settings), .001, "m")
            .Limit("distance at 1.02 mu", slid / SlidingOracle.SlopeDistance(Gravity, above, Friction, Duration) - 1, .05, "%")
            .Finish(output);
    }

    [Theory]
    [MemberData(nameof(ShapesOnFloors))]
    public void C1c_EffectiveFrictionOfShapesOnFloors(string solid, string floor, Effort effort)
    {
        var settings = AccuracySettings.For(effort);
        double steep = Math.PI / 6, shallow = Math.Atan(Friction * 1.05);
        double atSteep = SlidingOracle.EffectiveFriction(Gravity, steep, SlidDistance(solid, floor, steep, settings), Duration);
        double atShallow = SlidingOracle.EffectiveFriction(Gravity, shallow, SlidDistance(solid, floor, shallow, settings), Duration);
        new CaseResult("C1c", $"{solid} on {floor}", settings)
            .Limit("error at 30 degrees", atSteep / Friction - 1, .02, "%")
            .Limit("error at 1.05 mu", atShallow / Friction - 1, .02, "%")
            .Note("mu", atSteep)
            .Finish(output);
    }

    /// <summary>Way down the slope in five seconds from rest, starting in contact.</summary>
    static double SlidDistance(string shape, double angle, AccuracySettings settings)
    {
        using var world = new AccuracyWorld(settings with { Friction = (float)Friction });
        // A kinematic slope has contacts with two bodies, a static one with one.
        var slope = new Incline(world, angle, kinematic: shape.EndsWith("kinematic", StringComparison.Ordinal));
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

    /// <summary>The same for all solids and floors of the suite.</summary>
    static double SlidDistance(string name, string floor, double angle, AccuracySettings settings)
    {
        using var world = new AccuracyWorld(settings with { Friction = (float)Friction });
        using var solids = new Solids(world);
        var slope = new Incline(solids, angle, floor);
        var body = name switch
        {
            // Radii as in Solids.
            "lying capsule" => solids.Create("capsule").Place(slope.LyingPose(.2)),
            "lying cylinder" => solids.Create("wheel").Place(slope.LyingPose(.2)),
            _ => Standing(solids.Create(name)),
        };
        var start = world.Position(body);
        world.Run(Duration);
        return Double3.Dot(world.Position(body) - start, slope.Downhill);

        // Turned, so that no edge of it runs along the slope.
        BodyHandle Standing(Solid solid) => solid.Place(slope.TurnedPose(solid.Foot, .5));
    }
}
