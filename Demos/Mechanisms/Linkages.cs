using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using Demos.Accuracy;
using Demos.References;

namespace Demos.Mechanisms;

/// <summary>Closed loops: a four-bar linkage and a slider-crank, both driven, and a platform on six legs that goes to a pose.</summary>
sealed class Linkages : Mechanism
{
    const float Crank = 1, Coupler = 4, Rocker = 3, Ground = 4, Rod = 3;
    static readonly Vector3 platformTarget = new(.2f, 12.3f, -.1f);

    readonly BodyHandle ground, fourBarCrank, rocker, sliderCrank, piston, platform;
    double fourBarError, sliderError;

    public Linkages(AccuracySettings settings) : base(settings with { Contacts = ContactScope.None })
    {
        ground = World.AddAnchor(default);
        Vector2 pivot = new(Ground, 0), pin = new(0, Crank), joint = ToSingle(CouplerEnd(pin.X, pin.Y));
        fourBarCrank = AddBar(default, pin, 1);
        BodyHandle coupler = AddBar(pin, joint, 2);
        rocker = AddBar(joint, pivot, 2);
        AddHinge(ground, fourBarCrank, default, new(-Crank / 2, 0, 0));
        AddHinge(fourBarCrank, coupler, new(Crank / 2, 0, 0), new(-Coupler / 2, 0, 0));
        AddHinge(coupler, rocker, new(Coupler / 2, 0, 0), new(-Rocker / 2, 0, 0));
        AddHinge(rocker, ground, new(Rocker / 2, 0, 0), new(pivot, 0));
        AddMotor(fourBarCrank);

        // Below the other, in a plane of its own.
        sliderCrank = AddBar(default, new(Crank, 0), 1);
        BodyHandle rod = AddBar(new(Crank, 0), new(Crank + Rod, 0), 1);
        piston = World.AddDynamic(new Box(.5f, .5f, .5f), 5, new RigidPose(new Vector3(Crank + Rod, 0, 0)));
        AddHinge(ground, sliderCrank, default, new(-Crank / 2, 0, 0));
        AddHinge(sliderCrank, rod, new(Crank / 2, 0, 0), new(-Rod / 2, 0, 0));
        AddHinge(rod, piston, new(Rod / 2, 0, 0), default);
        Solver.Add(ground, piston, new Slider { LocalAxisA = Vector3.UnitX, LocalOrientation = Quaternion.Identity });
        AddMotor(sliderCrank);

        platform = World.AddDynamic(new Box(2, .2f, 2), 50, new RigidPose(new Vector3(0, 12, 0)));
        for (int i = 0; i < 6; ++i)
        {
            // Pairs of legs are near each other at the ground and apart at the platform.
            Vector3 foot = new Vector3(0, 10, 0) + Around(1.5f, i / 2 * 120 + (i % 2 == 0 ? -15 : 15)), head = Around(1, i / 2 * 120 + (i % 2 == 0 ? -45 : 45));
            Solver.Add(ground, platform, new DistanceServo(foot, head, (platformTarget + head - foot).Length(), default, new ServoSettings(.5f, 0, 1e5f)));
        }
    }

    public override int StepCount => 900;

    public override int StartingSteps => 60;

    public override IEnumerable<Finding> Findings =>
    [
        new("greatest gap of a hinge, m", WorstGap, 0, .01),
        new("four-bar: coupler's end from where the crank's angle puts it, m", fourBarError, 0, .02),
        new("slider-crank: piston from where the crank's angle puts it, m", sliderError, 0, .01),
        new("platform: from its pose at the end, m", (World.Position(platform) - (Double3)platformTarget).Length, 0, .005),
    ];

    protected override void Observe(int step)
    {
        if (step < StartingSteps)
            return;
        Double3 pin = Point(fourBarCrank, new(Crank / 2, 0, 0));
        (double x, double y) = CouplerEnd(pin.X, pin.Y);
        Double3 joint = Point(rocker, new(-Rocker / 2, 0, 0));
        fourBarError = Math.Max(fourBarError, Math.Sqrt((joint.X - x) * (joint.X - x) + (joint.Y - y) * (joint.Y - y)));
        Double3 crankEnd = Point(sliderCrank, new(Crank / 2, 0, 0));
        double there = crankEnd.X + Math.Sqrt(Rod * Rod - crankEnd.Y * crankEnd.Y);
        sliderError = Math.Max(sliderError, Math.Abs(World.Position(piston).X - there));
    }

    // Where circles about the crank's pin and the rocker's pivot meet, above the line between them.
    static (double X, double Y) CouplerEnd(double pinX, double pinY)
    {
        double x = Ground - pinX, y = -pinY, distance = Math.Sqrt(x * x + y * y);
        double along = (Coupler * Coupler - Rocker * Rocker + distance * distance) / (2 * distance);
        double across = Math.Sqrt(Coupler * Coupler - along * along);
        return (pinX + (x * along - y * across) / distance, pinY + (y * along + x * across) / distance);
    }

    static Vector2 ToSingle((double X, double Y) point) => new((float)point.X, (float)point.Y);

    static Vector3 Around(float radius, double degrees)
    {
        double angle = degrees * Math.PI / 180;
        return new Vector3((float)Math.Cos(angle), 0, (float)Math.Sin(angle)) * radius;
    }

    void AddMotor(BodyHandle crank) => Solver.Add(crank, ground, new AngularAxisMotor
    {
        LocalAxisA = Vector3.UnitZ,
        TargetVelocity = 3,
        Settings = new MotorSettings(200, 0),
    });
}
