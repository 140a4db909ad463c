using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using Demos.Accuracy;

namespace Demos.Mechanisms;

/// <summary>Three shafts geared 12:36 and 10:40, the last with a pinion that lifts a rack of 20 kg.</summary>
sealed class GearTrain : Mechanism
{
    const float PinionRadius = .15f, PinionTeeth = 15, Speed = 20;

    readonly BodyHandle housing, rack;
    readonly TurnCounter[] shafts = new TurnCounter[3];
    double phaseError, rackError;

    public GearTrain(AccuracySettings settings) : base(settings with { Contacts = ContactScope.None })
    {
        housing = World.AddAnchor(default);
        var handles = new BodyHandle[3];
        for (int i = 0; i < handles.Length; ++i)
        {
            handles[i] = World.AddDynamic(new Box(.3f, .3f, .2f), 10, new RigidPose(new Vector3(i, 0, 0)));
            AddHinge(housing, handles[i], new(i, 0, 0), default);
            shafts[i] = new TurnCounter(World.Bodies[handles[i]]);
        }
        Mesh(handles[0], handles[1], 12, 36);
        Mesh(handles[1], handles[2], 10, 40);
        rack = World.AddDynamic(new Box(.1f, 2, .1f), 20, new RigidPose(new Vector3(2 + PinionRadius, 0, 0)));
        Solver.Add(housing, rack, new Slider
        {
            LocalOffsetA = new(2 + PinionRadius, 0, 0),
            LocalAxisA = Vector3.UnitY,
            LocalOrientation = Quaternion.Identity,
        });
        Solver.Add(handles[2], rack, housing, new Rack
        {
            LocalBasisA = Quaternion.Identity,
            LocalHousingBasis = Quaternion.Identity,
            LocalHousingOffset = new(2 + PinionRadius, 0, 0),
            LocalHousingAxis = Vector3.UnitY,
            Radius = PinionRadius,
            Teeth = PinionTeeth,
        });
        Solver.Add(handles[0], housing, new AngularAxisMotor { LocalAxisA = Vector3.UnitZ, TargetVelocity = Speed, Settings = new MotorSettings(20, 0) });
    }

    public override int StepCount => 1200;

    public override int StartingSteps => 60;

    public override IEnumerable<Finding> Findings =>
    [
        new("turns of the first shaft", shafts[0].Angle / (2 * Math.PI), 60, 67),
        new("greatest error of a mesh, teeth", phaseError / (2 * Math.PI), 0, .05),
        new("greatest error of the rack, teeth", rackError / (2 * Math.PI * PinionRadius / PinionTeeth), 0, .05),
        new("height of the rack, m", World.Position(rack).Y, 4.7, 5.3),
    ];

    protected override void Observe(int step)
    {
        foreach (TurnCounter shaft in shafts)
            shaft.Observe();
        if (step < StartingSteps)
            return;
        phaseError = Math.Max(phaseError, Math.Abs(12 * shafts[0].Angle + 36 * shafts[1].Angle));
        phaseError = Math.Max(phaseError, Math.Abs(10 * shafts[1].Angle + 40 * shafts[2].Angle));
        rackError = Math.Max(rackError, Math.Abs(World.Position(rack).Y - PinionRadius * shafts[2].Angle));
    }

    void Mesh(BodyHandle a, BodyHandle b, float teethA, float teethB) => Solver.Add(a, b, housing, new Gear
    {
        LocalBasisA = Quaternion.Identity,
        LocalBasisB = Quaternion.Identity,
        LocalHousingBasisA = Quaternion.Identity,
        LocalHousingBasisB = Quaternion.Identity,
        TeethA = teethA,
        TeethB = teethB,
    });
}
