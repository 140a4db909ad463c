using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Constraints;

namespace Demos.Pages;

/// <summary>
/// One example for each type of constraint, in a method of its name: the page of the type shows its text, the picture is drawn from what it adds, and a test
/// runs it. Bodies stand as <see cref="JointStage"/> places them.
/// </summary>
static class JointExamples
{
    public static ConstraintHandle BallSocket(Simulation simulation, BodyHandle a, BodyHandle b) =>
        simulation.Solver.Add(a, b, new BallSocket { LocalOffsetA = new Vector3(0.75f, 0, 0), LocalOffsetB = new Vector3(-0.75f, 0, 0) });

    public static ConstraintHandle AngularHinge(Simulation simulation, BodyHandle a, BodyHandle b) =>
        simulation.Solver.Add(a, b, new AngularHinge { LocalHingeAxisA = Vector3.UnitY, LocalHingeAxisB = Vector3.UnitY });

    public static ConstraintHandle AngularSwivelHinge(Simulation simulation, BodyHandle a, BodyHandle b) =>
        simulation.Solver.Add(a, b, new AngularSwivelHinge { LocalSwivelAxisA = Vector3.UnitY, LocalHingeAxisB = Vector3.UnitZ });

    public static ConstraintHandle SwingLimit(Simulation simulation, BodyHandle a, BodyHandle b) =>
        simulation.Solver.Add(a, b, new SwingLimit
        {
            AxisLocalA = Vector3.UnitY,
            AxisLocalB = Vector3.UnitX,
            MaximumSwingAngle = MathF.PI / 2,
        });

    public static ConstraintHandle TwistServo(Simulation simulation, BodyHandle a, BodyHandle b) =>
        simulation.Solver.Add(a, b, new TwistServo
        {
            LocalBasisA = Quaternion.Identity,
            LocalBasisB = Quaternion.Identity,
            TargetAngle = 0,
            SpringSettings = new SpringSettings(10, 1),
            ServoSettings = new ServoSettings(maximumSpeed: 2, baseSpeed: 0, maximumForce: 50),
        });

    // A knee: it bends one way only.
    public static ConstraintHandle TwistLimit(Simulation simulation, BodyHandle a, BodyHandle b) =>
        simulation.Solver.Add(a, b, new TwistLimit
        {
            LocalBasisA = Quaternion.Identity,
            LocalBasisB = Quaternion.Identity,
            MinimumAngle = -2,
            MaximumAngle = 0,
        });

    public static ConstraintHandle TwistMotor(Simulation simulation, BodyHandle a, BodyHandle b) =>
        simulation.Solver.Add(a, b, new TwistMotor
        {
            LocalAxisA = Vector3.UnitX,
            LocalAxisB = Vector3.UnitX,
            TargetVelocity = 3,
            Settings = new MotorSettings(maximumForce: 20, softness: 0),
        });

    public static ConstraintHandle AngularServo(Simulation simulation, BodyHandle a, BodyHandle b) =>
        simulation.Solver.Add(a, b, new AngularServo
        {
            TargetRelativeRotationLocalA = Quaternion.Identity,
            SpringSettings = new SpringSettings(10, 1),
            ServoSettings = new ServoSettings(maximumSpeed: 5, baseSpeed: 0, maximumForce: 100),
        });

    public static ConstraintHandle AngularMotor(Simulation simulation, BodyHandle a, BodyHandle b) =>
        simulation.Solver.Add(a, b, new AngularMotor { TargetVelocityLocalA = new Vector3(0, 2, 0), Settings = new MotorSettings(100, 0) });

    public static ConstraintHandle Weld(Simulation simulation, BodyHandle a, BodyHandle b) =>
        simulation.Solver.Add(a, b, new Weld { LocalOffset = new Vector3(1.5f, 0, 0), LocalOrientation = Quaternion.Identity });

    public static ConstraintHandle VolumeConstraint(Simulation simulation, BodyHandle a, BodyHandle b, BodyHandle c, BodyHandle d) =>
        simulation.Solver.Add(a, b, c, d, new VolumeConstraint(
            simulation.Bodies[a].Pose.Position,
            simulation.Bodies[b].Pose.Position,
            simulation.Bodies[c].Pose.Position,
            simulation.Bodies[d].Pose.Position,
            new SpringSettings(30, 1)));

    public static ConstraintHandle DistanceServo(Simulation simulation, BodyHandle a, BodyHandle b) =>
        simulation.Solver.Add(a, b, new DistanceServo(
            new Vector3(0.4f, 0, 0), new Vector3(-0.4f, 0, 0), 0.7f, new SpringSettings(5, 0.5f), new ServoSettings(2, 0, 200)));

    // A rope that is taut.
    public static ConstraintHandle DistanceLimit(Simulation simulation, BodyHandle a, BodyHandle b) =>
        simulation.Solver.Add(a, b, new DistanceLimit(
            new Vector3(0.4f, 0, 0), new Vector3(-0.4f, 0, 0), minimumDistance: 0, maximumDistance: 0.7f, SpringSettings.Rigid));

    public static ConstraintHandle CenterDistanceConstraint(Simulation simulation, BodyHandle a, BodyHandle b) =>
        simulation.Solver.Add(a, b, new CenterDistanceConstraint(1.5f, new SpringSettings(30, 1)));

    public static ConstraintHandle AreaConstraint(Simulation simulation, BodyHandle a, BodyHandle b, BodyHandle c) =>
        simulation.Solver.Add(a, b, c, new AreaConstraint(
            simulation.Bodies[a].Pose.Position,
            simulation.Bodies[b].Pose.Position,
            simulation.Bodies[c].Pose.Position,
            new SpringSettings(30, 1)));

    public static ConstraintHandle PointOnLineServo(Simulation simulation, BodyHandle a, BodyHandle b) =>
        simulation.Solver.Add(a, b, new PointOnLineServo
        {
            LocalOffsetA = new Vector3(0.75f, 0, 0),
            LocalOffsetB = new Vector3(-0.75f, 0, 0),
            LocalDirection = Vector3.UnitY,
            ServoSettings = ServoSettings.Default,
        });

    // The spring and damper of a wheel.
    public static ConstraintHandle LinearAxisServo(Simulation simulation, BodyHandle a, BodyHandle b) =>
        simulation.Solver.Add(a, b, new LinearAxisServo
        {
            LocalOffsetA = new Vector3(0.75f, 0, 0),
            LocalOffsetB = new Vector3(-0.75f, 0, 0),
            LocalPlaneNormal = Vector3.UnitY,
            TargetOffset = 0,
            ServoSettings = ServoSettings.Default,
            SpringSettings = new SpringSettings(5, 0.7f),
        });

    public static ConstraintHandle LinearAxisMotor(Simulation simulation, BodyHandle a, BodyHandle b) =>
        simulation.Solver.Add(a, b, new LinearAxisMotor
        {
            LocalOffsetA = new Vector3(0.75f, 0, 0),
            LocalOffsetB = new Vector3(-0.75f, 0, 0),
            LocalAxis = Vector3.UnitY,
            TargetVelocity = 0.5f,
            Settings = new MotorSettings(maximumForce: 200, softness: 0),
        });

    // The lower end of a slider.
    public static ConstraintHandle LinearAxisLimit(Simulation simulation, BodyHandle a, BodyHandle b) =>
        simulation.Solver.Add(a, b, new LinearAxisLimit
        {
            LocalOffsetA = new Vector3(0.75f, 0, 0),
            LocalOffsetB = new Vector3(-0.75f, 0, 0),
            LocalAxis = Vector3.UnitY,
            MinimumOffset = 0,
            MaximumOffset = 1,
        });

    public static ConstraintHandle AngularAxisMotor(Simulation simulation, BodyHandle a, BodyHandle b) =>
        simulation.Solver.Add(a, b, new AngularAxisMotor { LocalAxisA = Vector3.UnitX, TargetVelocity = 3, Settings = new MotorSettings(100, 0) });

    public static ConstraintHandle OneBodyAngularServo(Simulation simulation, BodyHandle a) =>
        simulation.Solver.Add(a, new OneBodyAngularServo
        {
            TargetOrientation = Quaternion.Identity,
            SpringSettings = new SpringSettings(5, 1),
            ServoSettings = ServoSettings.Default,
        });

    public static ConstraintHandle OneBodyAngularMotor(Simulation simulation, BodyHandle a) =>
        simulation.Solver.Add(a, new OneBodyAngularMotor { TargetVelocity = new Vector3(0, 2, 0), Settings = new MotorSettings(100, 0) });

    // A grabbed corner.
    public static ConstraintHandle OneBodyLinearServo(Simulation simulation, BodyHandle a) =>
        simulation.Solver.Add(a, new OneBodyLinearServo
        {
            LocalOffset = new Vector3(0.4f, 0.2f, 0.2f),
            Target = new Vector3(0.4f, 0.2f, 0.2f),
            SpringSettings = new SpringSettings(5, 1),
            ServoSettings = new ServoSettings(maximumSpeed: 10, baseSpeed: 0, maximumForce: 500),
        });

    public static ConstraintHandle OneBodyLinearMotor(Simulation simulation, BodyHandle a) =>
        simulation.Solver.Add(a, new OneBodyLinearMotor { LocalOffset = default, TargetVelocity = new Vector3(1, 0, 0), Settings = new MotorSettings(500, 0) });

    public static ConstraintHandle SwivelHinge(Simulation simulation, BodyHandle a, BodyHandle b) =>
        simulation.Solver.Add(a, b, new SwivelHinge
        {
            LocalOffsetA = new Vector3(0.75f, 0, 0),
            LocalSwivelAxisA = Vector3.UnitY,
            LocalOffsetB = new Vector3(-0.75f, 0, 0),
            LocalHingeAxisB = Vector3.UnitZ,
        });

    // A door.
    public static ConstraintHandle Hinge(Simulation simulation, BodyHandle a, BodyHandle b) =>
        simulation.Solver.Add(a, b, new Hinge
        {
            LocalOffsetA = new Vector3(0.75f, 0, 0),
            LocalHingeAxisA = Vector3.UnitY,
            LocalOffsetB = new Vector3(-0.75f, 0, 0),
            LocalHingeAxisB = Vector3.UnitY,
        });

    public static ConstraintHandle BallSocketMotor(Simulation simulation, BodyHandle a, BodyHandle b) =>
        simulation.Solver.Add(a, b, new BallSocketMotor
        {
            LocalOffsetB = new Vector3(-0.4f, 0, 0),
            TargetVelocityLocalA = new Vector3(0, 0.5f, 0),
            Settings = new MotorSettings(maximumForce: 100, softness: 0),
        });

    public static ConstraintHandle BallSocketServo(Simulation simulation, BodyHandle a, BodyHandle b) =>
        simulation.Solver.Add(a, b, new BallSocketServo
        {
            LocalOffsetA = new Vector3(0.75f, 0, 0),
            LocalOffsetB = new Vector3(-0.75f, 0, 0),
            SpringSettings = new SpringSettings(10, 1),
            ServoSettings = new ServoSettings(maximumSpeed: 5, baseSpeed: 0, maximumForce: 300),
        });

    // B turns twice as fast as A.
    public static ConstraintHandle AngularAxisGearMotor(Simulation simulation, BodyHandle a, BodyHandle b) =>
        simulation.Solver.Add(a, b, new AngularAxisGearMotor { LocalAxisA = Vector3.UnitX, VelocityScale = 2, Settings = new MotorSettings(100, 0) });

    public static ConstraintHandle CenterDistanceLimit(Simulation simulation, BodyHandle a, BodyHandle b) =>
        simulation.Solver.Add(a, b, new CenterDistanceLimit(minimumDistance: 0.5f, maximumDistance: 1.5f, SpringSettings.Rigid));

    public static ConstraintHandle Slider(Simulation simulation, BodyHandle a, BodyHandle b) =>
        simulation.Solver.Add(a, b, new Slider
        {
            LocalOffsetA = new Vector3(0.75f, 0, 0),
            LocalAxisA = Vector3.UnitY,
            LocalOffsetB = new Vector3(-0.75f, 0, 0),
            LocalOrientation = Quaternion.Identity,
        });

    public static ConstraintHandle Gear(Simulation simulation, BodyHandle a, BodyHandle b, BodyHandle c) =>
        simulation.Solver.Add(a, b, c, new Gear
        {
            LocalBasisA = Quaternion.Identity,
            LocalBasisB = Quaternion.Identity,
            LocalHousingBasisA = Quaternion.Identity,
            LocalHousingBasisB = Quaternion.Identity,
            TeethA = 20,
            TeethB = 40,
        });

    public static ConstraintHandle Rack(Simulation simulation, BodyHandle a, BodyHandle b, BodyHandle c) =>
        simulation.Solver.Add(a, b, c, new Rack
        {
            LocalBasisA = Quaternion.Identity,
            LocalHousingBasis = Quaternion.Identity,
            LocalOffsetB = default,
            LocalHousingOffset = new Vector3(0.75f, -1.5f, 0),
            LocalHousingAxis = Vector3.UnitX,
            Radius = 0.2f,
            Teeth = 20,
        });

    public static ConstraintHandle Pulley(Simulation simulation, BodyHandle a, BodyHandle b, BodyHandle c) =>
        simulation.Solver.Add(a, b, c, new Pulley
        {
            LocalOffsetA = new Vector3(0, 0.2f, 0),
            LocalOffsetB = new Vector3(0, 0.2f, 0),
            LocalWheelA = new Vector3(-0.75f, 0, 0),
            LocalWheelB = new Vector3(0.75f, 0, 0),
            Ratio = 1,
            MaximumLength = 2.6f,
        });
}
