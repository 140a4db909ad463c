using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using Demos.Accuracy;

namespace Demos.Trade.Cases;

/// <summary>
/// Planks that hang between two anchors along an arc, hinged end to end, and a load a hundred times as heavy as a plank on the middle. Hinges have
/// no gap, and what lies on the bridge stays there.
/// </summary>
sealed class BridgeCase : TradeCase
{
    const int Planks = 40;
    const float Spacing = .5f, Thickness = .1f, Width = 2, PlankMass = 10, LoadMass = 1000;

    /// <summary>Angle between the first plank and the last; a straight bridge could carry nothing at all.</summary>
    const double Bend = .9;

    /// <summary>The whole bridge, hanging straight down, is as long as this.</summary>
    const double Fallen = Planks * Spacing / 2;

    readonly JointGaps gaps;
    readonly BodyHandle load;

    public BridgeCase(AccuracySettings settings) : base(settings)
    {
        gaps = new JointGaps(World);
        var end = Vector3.Zero;
        BodyHandle previous = World.AddAnchor(end);
        Vector3 previousOffset = Vector3.Zero, half = new(Spacing / 2, 0, 0);
        for (int i = 0; i < Planks; ++i)
        {
            double angle = Bend * ((i + .5) / Planks - .5);
            var along = new Vector3((float)Math.Cos(angle), (float)Math.Sin(angle), 0);
            var turned = new Quaternion(0, 0, (float)Math.Sin(angle / 2), (float)Math.Cos(angle / 2));
            // Shorter than the way from hinge to hinge, so that neighbours do not touch.
            BodyHandle plank = World.AddDynamic(
                new Box(Spacing * .95f, Thickness, Width), PlankMass, new RigidPose(end + along * (Spacing / 2), turned));
            AddHinge(previous, plank, previousOffset, -half);
            (previous, previousOffset) = (plank, half);
            end += along * Spacing;
        }
        AddHinge(previous, World.AddAnchor(end), previousOffset, Vector3.Zero);
        float lowest = (float)(-Spacing * LowestPoint());
        load = World.AddDynamic(new Box(1, 1, 1), LoadMass, new RigidPose(new Vector3(end.X / 2, lowest + Thickness / 2 + .5f, 0)));
    }

    public override int StepCount => 480;

    public override double Error => World.Position(load).Y > -Fallen ? gaps.Mean : double.NaN;

    public override void Observe(int step)
    {
        if (step >= StepCount / 2)
            gaps.Observe();
    }

    void AddHinge(BodyHandle a, BodyHandle b, Vector3 offsetA, Vector3 offsetB)
    {
        World.Simulation.Solver.Add(a, b, new Hinge
        {
            LocalOffsetA = offsetA,
            LocalHingeAxisA = Vector3.UnitZ,
            LocalOffsetB = offsetB,
            LocalHingeAxisB = Vector3.UnitZ,
            SpringSettings = World.Settings.Spring,
        });
        gaps.Add(a, b, offsetA, offsetB);
    }

    /// <summary>How far the middle is below the ends, in planks.</summary>
    static double LowestPoint()
    {
        double depth = 0;
        for (int i = 0; i < Planks / 2; ++i)
            depth -= Math.Sin(Bend * ((i + .5) / Planks - .5));
        return depth;
    }
}
