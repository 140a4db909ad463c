using System;
using System.Numerics;
using Demos.Scenes;
using Demos.Towers.Structures;

namespace Demos.Towers.Trials;

/// <summary>A box on a platform that turns slowly, until it slips or tips over.</summary>
static class TippingPlatform
{
    const double DegreesPerSecond = .5;
    const double Rate = DegreesPerSecond * Math.PI / 180;
    // What counts as having slipped, over the width of the box.
    const double SlippedPart = .01;
    // What counts as having tipped over, in radians against the platform.
    const double TippedAngle = .02;
    const double GreatestDegrees = 40;

    /// <summary>A wide box slips, a narrow one tips over.</summary>
    public static Trial[] All() =>
    [
        new("slips", "a cube on a platform that turns slowly, with friction .5: where it slips", "degrees", SlipsInTruth(.5),
            settings => Measure(settings, Vector3.One, .5f, (width, slid, _) => slid > SlippedPart * width)),
        new("tips", "a box of .5 x 1 m on a platform that turns slowly: where it tips over", "degrees", TipsInTruth(.5, 1),
            settings => Measure(settings, new Vector3(.5f, 1, .5f), 1, (_, _, tilt) => tilt > TippedAngle)),
    ];

    static double Measure(TowerSettings settings, Vector3 size, float friction, Func<double, double, double, bool> isOver)
    {
        const float halfThickness = .5f;
        var scene = new SceneDescription { Name = "platform", Friction = friction, Damping = 0 };
        scene.Bodies.Add(new SceneBody
        {
            Kind = SceneBodyKind.Kinematic,
            Children = [new SceneChild(scene.AddBox(5, halfThickness, 5), Vector3.Zero, Quaternion.Identity)],
            Position = new Vector3(0, -halfThickness, 0),
            AngularVelocity = new Vector3(0, 0, -(float)Rate),
        });
        scene.AddBox(size, new Vector3(0, size.Y / 2, 0));
        using var world = new TowerWorld(scene, settings);
        double start = Place(world);
        for (int step = 0; ; ++step)
        {
            double angle = Rate * step * settings.StepDuration;
            double tilt = Turn(world, 0) - Turn(world, 1);
            if (isOver(size.X, Math.Abs(Place(world) - start), Math.Abs(tilt)) || angle > GreatestDegrees * Math.PI / 180)
                return angle * 180 / Math.PI;
            world.Step(settings.StepDuration);
        }
    }

    // Along the platform, from its centre.
    static double Place(TowerWorld world)
    {
        double turn = Turn(world, 0);
        Vector3 way = world.Position(1) - world.Position(0);
        return way.X * Math.Cos(turn) + way.Y * Math.Sin(turn);
    }

    static double Turn(TowerWorld world, int part)
    {
        Quaternion orientation = world[part].Pose.Orientation;
        return 2 * Math.Atan2(orientation.Z, orientation.W);
    }

    // From where friction no longer holds on it slides faster and faster, and takes a moment to go so far.
    static double SlipsInTruth(double friction) => When((angle, _) => Math.Max(0, Math.Sin(angle) - friction * Math.Cos(angle)) * Weight, SlippedPart);

    // About its lower edge: half a diagonal squared and the moment of inertia about the centre are four thirds of the former.
    static double TipsInTruth(double width, double height)
    {
        double half = Math.Sqrt(width * width + height * height) / 2, stable = Math.Atan(width / height);
        return When((angle, tilt) => Math.Max(0, Math.Sin(angle + tilt - stable)) * Weight / (4.0 / 3 * half), TippedAngle);
    }

    static double Weight => -TowerWorld.Gravity;

    static double When(Func<double, double, double> acceleration, double limit)
    {
        const double dt = 1e-4;
        double time = 0, way = 0, speed = 0;
        for (; way < limit; time += dt)
        {
            speed += acceleration(Rate * time, way) * dt;
            way += speed * dt;
        }
        return Rate * time * 180 / Math.PI;
    }
}
