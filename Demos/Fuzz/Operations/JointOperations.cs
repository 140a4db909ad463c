using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Constraints;

namespace Demos.Fuzz.Operations;

/// <summary>Calls with descriptions of every type of joint.</summary>
static class JointOperations
{
    public static FuzzOperation[] All { get; } =
    [
        .. Of(w => new BallSocket { LocalOffsetA = Point(w), LocalOffsetB = Point(w), SpringSettings = Spring(w) }),
        .. Of(w => new AngularHinge { LocalHingeAxisA = Axis(w), LocalHingeAxisB = Axis(w), SpringSettings = Spring(w) }),
        .. Of(w => new AngularSwivelHinge { LocalSwivelAxisA = Axis(w), LocalHingeAxisB = Axis(w), SpringSettings = Spring(w) }),
        .. Of(w => new SwingLimit { AxisLocalA = Axis(w), AxisLocalB = Axis(w), MinimumDot = w.Random.Number(-1, 1), SpringSettings = Spring(w) }),
        .. Of(w => new TwistServo
        {
            LocalBasisA = w.Random.Turn(), LocalBasisB = w.Random.Turn(), TargetAngle = w.Random.Number(-7, 7), SpringSettings = Spring(w),
            ServoSettings = Servo(w),
        }),
        .. Of(w => new TwistLimit
        {
            LocalBasisA = w.Random.Turn(), LocalBasisB = w.Random.Turn(), MinimumAngle = w.Random.Number(-3, 0),
            MaximumAngle = w.Random.Number(0, 3), SpringSettings = Spring(w),
        }),
        .. Of(w => new TwistMotor { LocalAxisA = Axis(w), LocalAxisB = Axis(w), TargetVelocity = w.Random.Number(-5, 5), Settings = Motor(w) }),
        .. Of(w => new AngularServo { TargetRelativeRotationLocalA = w.Random.Turn(), SpringSettings = Spring(w), ServoSettings = Servo(w) }),
        .. Of(w => new AngularMotor { TargetVelocityLocalA = w.Random.Vector(5), Settings = Motor(w) }),
        .. Of(w => new Weld { LocalOffset = Point(w), LocalOrientation = w.Random.Turn(), SpringSettings = Spring(w) }),
        .. OfFourBodies(w => new VolumeConstraint { TargetScaledVolume = w.Random.Number(-4, 4), SpringSettings = Spring(w) }),
        .. Of(w => new DistanceServo(Point(w), Point(w), w.Random.Number(0, 3), Spring(w), Servo(w))),
        .. Of(w => new DistanceLimit(Point(w), Point(w), w.Random.Number(0, 1), w.Random.Number(1, 3), Spring(w))),
        .. Of(w => new CenterDistanceConstraint(w.Random.Number(0, 3), Spring(w))),
        .. OfThreeBodies(w => new AreaConstraint { TargetScaledArea = w.Random.Number(0, 4), SpringSettings = Spring(w) }),
        .. Of(w => new PointOnLineServo
        {
            LocalOffsetA = Point(w), LocalOffsetB = Point(w), LocalDirection = Axis(w), ServoSettings = Servo(w), SpringSettings = Spring(w),
        }),
        .. Of(w => new LinearAxisServo
        {
            LocalOffsetA = Point(w), LocalOffsetB = Point(w), LocalPlaneNormal = Axis(w), TargetOffset = w.Random.Number(-2, 2),
            ServoSettings = Servo(w), SpringSettings = Spring(w),
        }),
        .. Of(w => new LinearAxisMotor
        {
            LocalOffsetA = Point(w), LocalOffsetB = Point(w), LocalAxis = Axis(w), TargetVelocity = w.Random.Number(-5, 5), Settings = Motor(w),
        }),
        .. Of(w => new LinearAxisLimit
        {
            LocalOffsetA = Point(w), LocalOffsetB = Point(w), LocalAxis = Axis(w), MinimumOffset = w.Random.Number(-2, 0),
            MaximumOffset = w.Random.Number(0, 2), SpringSettings = Spring(w),
        }),
        .. Of(w => new AngularAxisMotor { LocalAxisA = Axis(w), TargetVelocity = w.Random.Number(-5, 5), Settings = Motor(w) }),
        .. OfOneBody(w => new OneBodyAngularServo { TargetOrientation = w.Random.Turn(), SpringSettings = Spring(w), ServoSettings = Servo(w) }),
        .. OfOneBody(w => new OneBodyAngularMotor { TargetVelocity = w.Random.Vector(5), Settings = Motor(w) }),
        .. OfOneBody(w => new OneBodyLinearServo
        {
            LocalOffset = Point(w), Target = w.Random.Vector(3), SpringSettings = Spring(w), ServoSettings = Servo(w),
        }),
        .. OfOneBody(w => new OneBodyLinearMotor { LocalOffset = Point(w), TargetVelocity = w.Random.Vector(5), Settings = Motor(w) }),
        .. Of(w => new SwivelHinge
        {
            LocalOffsetA = Point(w), LocalSwivelAxisA = Axis(w), LocalOffsetB = Point(w), LocalHingeAxisB = Axis(w), SpringSettings = Spring(w),
        }),
        .. Of(w => new Hinge
        {
            LocalOffsetA = Point(w), LocalHingeAxisA = Axis(w), LocalOffsetB = Point(w), LocalHingeAxisB = Axis(w), SpringSettings = Spring(w),
        }),
        .. Of(w => new BallSocketMotor { LocalOffsetB = Point(w), TargetVelocityLocalA = w.Random.Vector(5), Settings = Motor(w) }),
        .. Of(w => new BallSocketServo { LocalOffsetA = Point(w), LocalOffsetB = Point(w), SpringSettings = Spring(w), ServoSettings = Servo(w) }),
        .. Of(w => new AngularAxisGearMotor { LocalAxisA = Axis(w), VelocityScale = w.Random.Number(-3, 3), Settings = Motor(w) }),
        .. Of(w => new CenterDistanceLimit(w.Random.Number(0, 1), w.Random.Number(1, 3), Spring(w))),
        .. Of(w => new Slider
        {
            LocalOffsetA = Point(w), LocalAxisA = Axis(w), LocalOffsetB = Point(w), LocalOrientation = w.Random.Turn(), SpringSettings = Spring(w),
        }),
        .. OfThreeBodies(w => new Gear
        {
            LocalBasisA = w.Random.Turn(), LocalBasisB = w.Random.Turn(), LocalHousingBasisA = w.Random.Turn(), LocalHousingBasisB = w.Random.Turn(),
            TeethA = 1 + w.Random.Below(40), TeethB = -1 - w.Random.Below(40), SpringSettings = Spring(w),
        }),
        .. OfThreeBodies(w => new Rack
        {
            LocalBasisA = w.Random.Turn(), LocalHousingBasis = w.Random.Turn(), LocalOffsetB = Point(w), LocalHousingOffset = Point(w),
            LocalHousingAxis = Axis(w), Radius = w.Random.Number(0.01f, 1), Teeth = 1 + w.Random.Below(40), SpringSettings = Spring(w),
        }),
        .. OfThreeBodies(w => new Pulley
        {
            LocalOffsetA = Point(w), LocalOffsetB = Point(w), LocalWheelA = Point(w), LocalWheelB = Point(w), Ratio = w.Random.Number(0.1f, 4),
            MaximumLength = w.Random.Number(0, 5), SpringSettings = Spring(w),
        }),
    ];

    static Vector3 Point(FuzzWorld w) => w.Random.Vector(1);

    static Vector3 Axis(FuzzWorld w) => w.Random.Direction();

    static SpringSettings Spring(FuzzWorld w) =>
        w.Random.Percent(50) ? default : new SpringSettings(w.Random.Magnitude(0.1f, 1000), w.Random.Number(0, 3));

    static ServoSettings Servo(FuzzWorld w) =>
        w.Random.Percent(50) ? ServoSettings.Default : new(w.Random.Number(0, 5), w.Random.Number(0, 1), w.Random.Number(0, 100));

    static MotorSettings Motor(FuzzWorld w) => w.Random.Percent(50) ? new(float.MaxValue, 0) : new(w.Random.Number(0, 100), w.Random.Number(0, 1));

    // What can be called with every type of constraint. Handles of other types are among those that are drawn.
    static FuzzOperation[] Any<T>(Func<FuzzWorld, T> describe) where T : unmanaged, IConstraintDescription<T> =>
    [
        new($"Solver.ApplyDescription<{typeof(T).Name}>", 2, w => w.Simulation.Solver.ApplyDescription(w.AnyConstraint(), Spoiled(w, describe))),
        new($"Solver.ApplyDescriptionWithoutWaking<{typeof(T).Name}>", 1,
            w => w.Simulation.Solver.ApplyDescriptionWithoutWaking(w.AnyConstraint(), Spoiled(w, describe))),
        new($"Solver.GetDescription<{typeof(T).Name}>", 2, w => w.Simulation.Solver.GetDescription(w.AnyConstraint(), out T _)),
        new($"Solver.Add<{typeof(T).Name}> to a list", 2, w =>
        {
            var bodies = new BodyHandle[w.Random.Percent(80) ? T.BodyCount : w.Random.Below(5)];
            for (int i = 0; i < bodies.Length; ++i)
                bodies[i] = w.AnyBody();
            T description = Spoiled(w, describe);
            w.Constraints.Live.Add(w.Simulation.Solver.Add(bodies.AsSpan(), description));
        }),
        new($"Solver.Register<{typeof(T).Name}>", 1, w => w.Simulation.Solver.Register<T>()),
    ];

    static FuzzOperation[] Of<T>(Func<FuzzWorld, T> describe) where T : unmanaged, ITwoBodyConstraintDescription<T> =>
    [
        new($"Solver.Add<{typeof(T).Name}>", 7, w =>
        {
            BodyHandle a = w.AnyBody(), b = w.AnyBody();
            w.Constraints.Live.Add(w.Simulation.Solver.Add(a, b, Spoiled(w, describe)));
        }),
        .. Any(describe),
    ];

    static FuzzOperation[] OfOneBody<T>(Func<FuzzWorld, T> describe) where T : unmanaged, IOneBodyConstraintDescription<T> =>
    [
        new($"Solver.Add<{typeof(T).Name}>", 7, w => w.Constraints.Live.Add(w.Simulation.Solver.Add(w.AnyBody(), Spoiled(w, describe)))),
        .. Any(describe),
    ];

    static unsafe T Spoiled<T>(FuzzWorld w, Func<FuzzWorld, T> describe) where T : unmanaged
    {
        T description = w.Random.Spoil(describe(w), 10);
        if (w.IsVerbose)
        {
            foreach (float field in new ReadOnlySpan<float>(&description, sizeof(T) / sizeof(float)))
                w.Tell($"{field}");
        }
        return description;
    }

    static FuzzOperation[] OfThreeBodies<T>(Func<FuzzWorld, T> describe) where T : unmanaged, IThreeBodyConstraintDescription<T> =>
    [
        new($"Solver.Add<{typeof(T).Name}>", 7, w =>
        {
            BodyHandle a = w.AnyBody(), b = w.AnyBody(), c = w.AnyBody();
            w.Constraints.Live.Add(w.Simulation.Solver.Add(a, b, c, Spoiled(w, describe)));
        }),
        .. Any(describe),
    ];

    static FuzzOperation[] OfFourBodies<T>(Func<FuzzWorld, T> describe) where T : unmanaged, IFourBodyConstraintDescription<T> =>
    [
        new($"Solver.Add<{typeof(T).Name}>", 7, w =>
        {
            BodyHandle a = w.AnyBody(), b = w.AnyBody(), c = w.AnyBody(), d = w.AnyBody();
            w.Constraints.Live.Add(w.Simulation.Solver.Add(a, b, c, d, Spoiled(w, describe)));
        }),
        .. Any(describe),
    ];
}
