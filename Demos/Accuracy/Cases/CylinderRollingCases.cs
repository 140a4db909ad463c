using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Demos.References;

namespace Demos.Accuracy.Cases;

/// <summary>Cylinders and prisms that roll straight on (C2): how far they come, and whether they keep their line.</summary>
/// <remarks>
/// Nothing turns a rolling cylinder: any deviation is an error of the contacts. One of a millimetre for each metre is a constant curvature that
/// takes it half a metre aside in thirty, or a steady tilt of .06 degrees; half a degree of the axis is ten such metres.
/// </remarks>
static class CylinderRollingCases
{
    const double Gravity = 9.81f;
    const float Radius = .5f;
    const float Length = 1;
    static readonly (string Floor, double Yaw)[] level =
        [(Floors.Box, 0), (Floors.Box, .5), (Floors.Hull, .5), (Floors.Triangle, .5), (Floors.Pair, .5)];

    public static IEnumerable<AccuracyCase> All { get; } =
    [
        .. new[] { Floors.Box, Floors.Hull, Floors.Triangle }.SelectMany(floor => AccuracySuite.AtBothEfforts("C2",
            $"cylinder rolling on 20 degrees, {floor}", (settings, result) => RunDownTwentyDegrees(settings, floor, result))),
        .. level.SelectMany(start => AccuracySuite.AtBothEfforts("C2",
            FormattableString.Invariant($"cylinder rolling at 5 m/s, yaw {start.Yaw}, {start.Floor}"),
            (settings, result) => RunOnTheLevel(settings, start.Floor, start.Yaw, result))),
        .. new[] { Floors.Box, Floors.Triangle }.SelectMany(floor => AccuracySuite.AtBothEfforts("C2",
            $"prism of 64 sides rolling on 20 degrees, {floor}", (settings, result) => RunPrism(settings, floor, result))),
    ];

    static void RunDownTwentyDegrees(AccuracySettings settings, string floor, CaseResult result)
    {
        const double angle = Math.PI / 9, time = 5;
        using var world = new AccuracyWorld(settings);
        using var solids = new Solids(world);
        var slope = new Incline(solids, angle, floor);
        var body = world.AddDynamic(new Cylinder(Radius, Length), 1, slope.CrossPose(Radius));
        var line = new StraightLine(world, body, slope.Downhill);
        world.Run(time, line.Look);
        // Two thirds: a solid cylinder has half of m r2 about its axis.
        double expected = 2 / 3d * Gravity * Math.Sin(angle) * time * time / 2;
        line.Judge(result).Limit("distance", line.Way / expected - 1, .02, "%");
    }

    /// <summary>Two triangles know nothing of each other: the edge between them is one to stumble over.</summary>
    static void RunOnTheLevel(AccuracySettings settings, string floor, double yaw, CaseResult result)
    {
        using var world = new AccuracyWorld(settings);
        using var solids = new Solids(world);
        var line = Start(solids, floor, yaw, pose => world.AddDynamic(new Cylinder(Radius, Length), 1, pose));
        world.Run(10, line.Look);
        line.Judge(result).Limit("distance", line.Way / 50 - 1, .02, "%");
    }

    /// <summary>
    /// A polygon does not roll without loss. At each corner its angular speed about the new corner is 1 - 2/3 (1 - cos t) of that about
    /// the old one, where t is the angle between neighbours, which for 64 corners is a decay over 15 m at a radius of half a metre; and
    /// faster than sqrt(g r), 2.2 m/s, it leaves the ground between corners.
    /// </summary>
    static void RunPrism(AccuracySettings settings, string floor, CaseResult result)
    {
        const double angle = Math.PI / 9, time = 5;
        using var world = new AccuracyWorld(settings);
        using var solids = new Solids(world);
        var slope = new Incline(solids, angle, floor);
        // One of its sides lies on the slope.
        var body = solids.Create("64-gon prism").Place(slope.CrossPose(Radius * Math.Cos(Math.PI / 64)));
        var line = new StraightLine(world, body, slope.Downhill);
        world.Run(time, line.Look);
        double round = 2 / 3d * Gravity * Math.Sin(angle) * time * time / 2;
        line.Judge(result)
            .Limit("distance", line.Way / PrismDistance(angle, time) - 1, .05, "%")
            .Note("against a round one", line.Way / round - 1, "%");
    }

    /// <summary>Way of the prism while it pivots about one corner after the other, every one of them without bounce.</summary>
    static double PrismDistance(double angle, double time)
    {
        const double sector = 2 * Math.PI / 64, h = 1e-5;
        double lossPerRadian = 2 / 3d * (1 - Math.Cos(sector)) / sector;
        double speed = 0, way = 0;
        for (double t = 0; t < time; t += h)
        {
            speed += h * (2 / 3d * Gravity * Math.Sin(angle) - lossPerRadian * speed * speed / Radius);
            way += h * speed;
        }
        return way;
    }

    static StraightLine Start(Solids solids, string floor, double yaw, Func<RigidPose, BodyHandle> add)
    {
        const float speed = 5;
        Floors.Add(solids, floor, RigidPose.Identity, -60, 60, 60);
        var turn = DoubleQuaternion.FromAxisAngle(new(0, 1, 0), yaw);
        var forward = turn.Rotate(new(1, 0, 0));
        var axis = turn.Rotate(new(0, 0, 1));
        var lying = turn * DoubleQuaternion.FromAxisAngle(new(1, 0, 0), Math.PI / 2);
        var body = add(new RigidPose(
            Round(forward * -25) + new Vector3(0, Radius, 0), new((float)lying.X, (float)lying.Y, (float)lying.Z, (float)lying.W)));
        solids.World.Bodies[body].Velocity = new BodyVelocity(Round(forward * speed), Round(axis * (-speed / Radius)));
        return new StraightLine(solids.World, body, forward);
    }

    static Vector3 Round(Double3 v) => new((float)v.X, (float)v.Y, (float)v.Z);

    /// <summary>The line that a rolling body should keep, and how far it is from it.</summary>
    sealed class StraightLine(AccuracyWorld world, BodyHandle body, Double3 forward)
    {
        readonly Double3 start = world.Position(body);
        readonly Double3 startAxis = world.Orientation(body).Rotate(new(0, 1, 0));
        double aside, turned;

        public double Way => Double3.Dot(world.Position(body) - start, forward);

        public void Look()
        {
            aside = Tally.Worst(aside, Double3.Dot(world.Position(body) - start, startAxis));
            var axis = world.Orientation(body).Rotate(new(0, 1, 0));
            double angle = Math.Atan2(Double3.Cross(axis, startAxis).Length, Double3.Dot(axis, startAxis));
            turned = Tally.Most(turned, angle * 180 / Math.PI);
        }

        public CaseResult Judge(CaseResult result) => result
            .Limit("aside per metre", aside / Way, .001)
            .Limit("axis turned", turned, .5, "degrees")
            .Limit("slip", 1 - world.AngularVelocity(body).Length * Radius / world.LinearVelocity(body).Length, .02, "%");
    }
}
