using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using Demos.Accuracy;
using Demos.References;

namespace Demos.Mechanisms;

/// <summary>A car with sprung wheels, steered in front and driven behind: straight on, then a circle to one side and one to the other.</summary>
sealed class Car : Mechanism
{
    const float Wheelbase = 2.6f, HalfTrack = 1, WheelRadius = .4f, Suspension = .5f, Speed = 4, TurningRadius = 8;
    const int StraightSteps = 120;

    readonly BodyHandle chassis;
    readonly List<(ConstraintHandle Hinge, Vector3 Axis)> steered = [];
    double heading, lastHeading, greatestAside, leastAside, tilt;
    Double3 crossing, end;
    int phase;

    public Car(AccuracySettings settings) : base(settings with { Friction = 1 })
    {
        World.AddGround();
        float height = WheelRadius + Suspension;
        chassis = World.AddDynamic(new Box(1.2f, .5f, 4), 800, new RigidPose(new Vector3(0, height, 0)));
        foreach (float z in (float[])[-Wheelbase / 2, Wheelbase / 2])
        {
            foreach (float x in (float[])[-HalfTrack, HalfTrack])
                AddWheel(new Vector3(x, 0, z), isFront: z < 0);
        }
    }

    public override int StepCount => 2400;

    // Both circles have the steering's radius, and end where they began: the diameter is to the side, and nothing is left of the way.
    public override IEnumerable<Finding> Findings =>
    [
        new("circles driven", phase - 1, 2, 2),
        new("way to the left, diameters", -leastAside / (2 * TurningRadius), .8, 1.2),
        new("way to the right, diameters", greatestAside / (2 * TurningRadius), .8, 1.2),
        new("from the crossing after both, m", (end - crossing).Length, 0, 2.5),
        new("greatest tilt, rad", tilt, 0, .1),
    ];

    void AddWheel(Vector3 place, bool isFront)
    {
        // A cylinder's axis is its Y; here it points to the right.
        var upright = new Quaternion(0, 0, -MathF.Sqrt(.5f), MathF.Sqrt(.5f));
        BodyHandle wheel = World.AddDynamic(
            new Cylinder(WheelRadius, .3f), 20, new RigidPose(World.Bodies[chassis].Pose.Position + place - new Vector3(0, Suspension, 0), upright));
        Solver.Add(chassis, wheel, new LinearAxisServo
        {
            LocalOffsetA = place,
            LocalPlaneNormal = -Vector3.UnitY,
            TargetOffset = Suspension,
            ServoSettings = ServoSettings.Default,
            SpringSettings = new SpringSettings(4, .7f),
        });
        Solver.Add(chassis, wheel, new PointOnLineServo { LocalOffsetA = place, LocalDirection = -Vector3.UnitY, ServoSettings = ServoSettings.Default });
        ConstraintHandle hinge = Solver.Add(chassis, wheel, new AngularHinge { LocalHingeAxisA = Vector3.UnitX, LocalHingeAxisB = Vector3.UnitY });
        if (isFront)
            steered.Add((hinge, Vector3.UnitY));
        else
            // Forwards is -Z: the wheel turns about the axis to the right with the negative sign.
            Solver.Add(wheel, chassis, new AngularAxisMotor
            {
                LocalAxisA = Vector3.UnitY,
                TargetVelocity = -Speed / WheelRadius,
                Settings = new MotorSettings(300, 1e-4f),
            });
    }

    protected override void Drive(int step)
    {
        double wanted = phase switch
        {
            1 => Math.Atan(Wheelbase / TurningRadius),
            2 => -Math.Atan(Wheelbase / TurningRadius),
            _ => 0,
        };
        var axis = new Vector3((float)Math.Cos(wanted), 0, (float)-Math.Sin(wanted));
        foreach ((ConstraintHandle hinge, Vector3 wheelAxis) in steered)
            Solver.ApplyDescription(hinge, new AngularHinge { LocalHingeAxisA = axis, LocalHingeAxisB = wheelAxis });
    }

    protected override void Observe(int step)
    {
        Double3 forward = World.Orientation(chassis).Rotate(new Vector3(0, 0, -1)), up = World.Orientation(chassis).Rotate(Vector3.UnitY);
        double now = Math.Atan2(-forward.X, -forward.Z);
        heading += Math.IEEERemainder(now - lastHeading, 2 * Math.PI);
        lastHeading = now;
        tilt = Math.Max(tilt, Math.Acos(Math.Min(1, up.Y)));
        Double3 place = World.Position(chassis);
        if (phase == 0 && step >= StraightSteps)
            (phase, crossing) = (1, place);
        if (phase == 1 && heading >= 2 * Math.PI)
            phase = 2;
        if (phase == 2 && heading <= 0)
            (phase, end) = (3, place);
        if (phase is 1 or 2)
        {
            leastAside = Math.Min(leastAside, place.X - crossing.X);
            greatestAside = Math.Max(greatestAside, place.X - crossing.X);
        }
    }
}
