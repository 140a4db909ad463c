using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Demos.Accuracy;

namespace Demos.Mechanisms;

/// <summary>24 planks of 10 kg, hinged end to end in an arc between two anchors, onto which a ball of 100 kg falls.</summary>
sealed class Bridge : Mechanism
{
    const int Planks = 24;
    const float Spacing = .5f, Thickness = .1f, BallRadius = .5f;
    const double Bend = .9;

    readonly BodyHandle ball;

    public Bridge(AccuracySettings settings) : base(settings)
    {
        Vector2 end = default;
        BodyHandle previous = World.AddAnchor(default);
        Vector3 previousOffset = default, half = new(Spacing / 2, 0, 0);
        float lowest = 0;
        for (int i = 0; i < Planks; ++i)
        {
            double angle = Bend * ((i + .5) / Planks - .5);
            var orientation = new Quaternion(0, 0, (float)Math.Sin(angle / 2), (float)Math.Cos(angle / 2));
            var along = new Vector2((float)Math.Cos(angle), (float)Math.Sin(angle)) * Spacing;
            // Shorter than the way from hinge to hinge, so that neighbours do not touch.
            BodyHandle plank = World.AddDynamic(new Box(Spacing * .95f, Thickness, 2), 10, new RigidPose(new Vector3(end + along / 2, 0), orientation));
            AddHinge(previous, plank, previousOffset, -half);
            (previous, previousOffset) = (plank, half);
            end += along;
            lowest = Math.Min(lowest, end.Y);
        }
        AddHinge(previous, World.AddAnchor(new Vector3(end, 0)), previousOffset, default);
        ball = World.AddDynamic(new Sphere(BallRadius), 100, new RigidPose(new Vector3(end.X / 2, lowest + Thickness / 2 + BallRadius + .3f, 0)));
    }

    public override int StepCount => 600;

    public override IEnumerable<Finding> Findings =>
    [
        new("greatest gap of a hinge, parts of a plank", WorstGap / Spacing, 0, .1),
        new("height of the ball, m", World.Position(ball).Y, -2, 0),
        new("energy gained, parts of the greatest motion", EnergyGained / GreatestMotion, 0, .01),
    ];
}
