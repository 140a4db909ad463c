using System;
using System.Collections.Generic;
using System.Linq;
using BepuPhysics;
using BepuPhysics.Collidables;
using Demos.References;

namespace Demos.Accuracy.Cases;

/// <summary>
/// Dry friction on a slope: bodies just below and just above the angle of friction (C1), the coefficient that shapes really get (C1c).
/// </summary>
static class SlopeCases
{
    const double Gravity = 9.81f;
    const double Friction = .5;
    const double Duration = 5;

    /// <summary>Tangents of the angle as multiples of the coefficient; 30 degrees is 1.1547 of it.</summary>
    static readonly double[] ratios = [.98, .995, 1.005, 1.02, 1.1547005383792515];
    static readonly string[] onPlanks = ["box", "turned box", "flat box", "capsule", "box on kinematic", "capsule on kinematic"];
    static readonly string[] onFloors =
        ["box", "lying capsule", "cylinder", "lying cylinder", "coin", "cube hull", "hexagonal prism", "random hull"];

    public static IEnumerable<AccuracyCase> All { get; } =
    [
        .. ratios.SelectMany(ratio => AccuracySuite.AtBothEfforts("C1", FormattableString.Invariant($"box, tan = {ratio:F3} mu"),
            (settings, result) => RunNearTheAngle(settings, ratio, result))),
        .. SolidsOnFloors().SelectMany(pair => AccuracySuite.AtBothEfforts("C1", $"{pair.Solid} on {pair.Floor}",
            (settings, result) => RunNearTheAngle(settings, pair.Solid, pair.Floor, result))),
        .. onPlanks.SelectMany(shape => AccuracySuite.AtBothEfforts("C1c", shape.Contains(" on ", StringComparison.Ordinal) ? shape : $"{shape} on box",
            (settings, result) => RunCoefficient(angle => SlidDistance(shape, angle, settings), result))),
        .. SolidsOnFloors().SelectMany(pair => AccuracySuite.AtBothEfforts("C1c", $"{pair.Solid} on {pair.Floor}",
            (settings, result) => RunCoefficient(angle => SlidDistance(pair.Solid, pair.Floor, angle, settings), result))),
    ];

    /// <summary>The friction of boxes and capsules on a box is that of the planks.</summary>
    static IEnumerable<(string Solid, string Floor)> SolidsOnFloors() => Floors.Flat.SelectMany(floor => onFloors
        .Where(solid => floor != Floors.Box || solid is not ("box" or "lying capsule")).Select(solid => (solid, floor)));

    static void RunNearTheAngle(AccuracySettings settings, double ratio, CaseResult result)
    {
        double angle = Math.Atan(Friction * ratio);
        double slid = SlidDistance("box", angle, settings);
        if (ratio < 1)
            result.Limit("creep", slid, .001, "m");
        else
            result.Limit("distance", slid / SlidingOracle.SlopeDistance(Gravity, angle, Friction, Duration) - 1, .05, "%").Note("slid", slid, "m");
    }

    /// <summary>Just below the angle of friction nothing creeps, just above it slides as it should, whatever lies on whatever.</summary>
    static void RunNearTheAngle(AccuracySettings settings, string solid, string floor, CaseResult result)
    {
        double below = Math.Atan(Friction * .98), above = Math.Atan(Friction * 1.02);
        double slid = SlidDistance(solid, floor, above, settings);
        result.Limit("creep at .98 mu", SlidDistance(solid, floor, below, settings), .001, "m")
            .Limit("distance at 1.02 mu", slid / SlidingOracle.SlopeDistance(Gravity, above, Friction, Duration) - 1, .05, "%");
    }

    /// <summary>Both where sliding is slow, so that the coefficient is known to a tenth of a percent, and where it is fast.</summary>
    static void RunCoefficient(Func<double, double> slidAt, CaseResult result)
    {
        double steep = Math.PI / 6, shallow = Math.Atan(Friction * 1.05);
        double atSteep = SlidingOracle.EffectiveFriction(Gravity, steep, slidAt(steep), Duration);
        double atShallow = SlidingOracle.EffectiveFriction(Gravity, shallow, slidAt(shallow), Duration);
        result.Limit("error at 30 degrees", atSteep / Friction - 1, .02, "%")
            .Limit("error at 1.05 mu", atShallow / Friction - 1, .02, "%")
            .Note("mu", atSteep);
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
