using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using Demos.Accuracy;
using Demos.References;

namespace Demos.Mechanisms;

/// <summary>A boom on a stay that draws it up, and a carriage on it that draws a load of 500 kg up by a rope over the boom's end.</summary>
sealed class Crane : Mechanism
{
    const float BoomLength = 6, RopeLength = 5, StayTarget = 5, CarriageTarget = -1;

    readonly BodyHandle boom, carriage, load;
    static readonly Vector3 mastTop = new(0, 6, 0), tip = new(BoomLength / 2, 0, 0);
    double ropeError;

    public Crane(AccuracySettings settings) : base(settings with { Contacts = ContactScope.None })
    {
        BodyHandle mast = World.AddAnchor(default);
        boom = AddBar(default, new Vector2(BoomLength, 0), 200, .3f);
        AddHinge(mast, boom, default, -tip);
        float stay = (new Vector3(BoomLength, 0, 0) - mastTop).Length();
        Solver.Add(mast, boom, new DistanceServo(mastTop, tip, Math.Min(stay, StayTarget), default, new ServoSettings(.4f, 0, 1e6f)));
        // The carriage begins 2 m from the boom's end, and the load 3 m below it: the rope is taut.
        carriage = World.AddDynamic(new Box(.5f, .3f, .3f), 50, new RigidPose(new Vector3(BoomLength - 2, 0, 0)));
        Solver.Add(boom, carriage, new Slider { LocalAxisA = Vector3.UnitX, LocalOrientation = Quaternion.Identity });
        Solver.Add(boom, carriage, new LinearAxisServo
        {
            LocalPlaneNormal = Vector3.UnitX,
            TargetOffset = CarriageTarget,
            ServoSettings = new ServoSettings(.4f, 0, 1e6f),
        });
        load = World.AddDynamic(new Sphere(.4f), 500, new RigidPose(new Vector3(BoomLength, -3, 0)));
        Solver.Add(load, carriage, boom, new Pulley { LocalWheelA = tip, LocalWheelB = tip, Ratio = 1, MaximumLength = RopeLength });
    }

    public override int StepCount => 1200;

    // With the stay at 5 m, boom and mast at 6 m, the boom's end is at 6 - 5^2 / 12 m: of an isosceles triangle. The load may swing.
    public override IEnumerable<Finding> Findings =>
    [
        new("greatest gap of the boom's hinge, m", WorstGap, 0, .01),
        new("the rope beyond its length, m", ropeError, 0, .05),
        new("height of the boom's end, m", Point(boom, tip).Y, BoomLength - 25 / 12.0 - .02, BoomLength - 25 / 12.0 + .02),
        new("carriage from its place on the boom, m", (Point(boom, new(CarriageTarget, 0, 0)) - World.Position(carriage)).Length, 0, .01),
        new("length of the load's part of the rope, m", LoadPart, RopeLength - 4 - .05, RopeLength - 4 + .05),
    ];

    double LoadPart => (World.Position(load) - Point(boom, tip)).Length;

    protected override void Observe(int step)
    {
        Double3 end = Point(boom, tip);
        ropeError = Math.Max(ropeError, LoadPart + (World.Position(carriage) - end).Length - RopeLength);
    }
}
