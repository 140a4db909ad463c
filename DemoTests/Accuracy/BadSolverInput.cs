using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Constraints;
using BepuUtilities.Memory;
using Demos.Accuracy;

namespace DemoTests.Accuracy;

/// <summary>Bad steps, bad counts, bad constraints.</summary>
static class BadSolverInput
{
    static readonly string[] offset = ["offset"];
    static readonly string[] axis = ["axis"];
    static readonly string[] spring = ["spring", "frequency", "damping"];
    static readonly string[] servo = ["servo", "speed", "force"];
    static readonly string[] constraint = ["handle", "constraint"];

    delegate void Edit<T>(ref T description, float value);

    public static void AddTo(BadInputList list)
    {
        Steps(list);
        Joints(list);
        Limits(list);
        Servos(list);
        Motors(list);
        Handles(list);
        BadConstraintInput.AddTo(list);
    }

    static void Steps(BadInputList list)
    {
        list.Add("Timestep, dt", ["dt"], BadInputList.NotPositive, static (w, v) => w.Simulation.Timestep(v));
        list.Add("Solver.SubstepCount", ["substep"], [0, -1, int.MinValue], static (w, v) => w.Solver.SubstepCount = (int)v);
        list.Add("Solver.VelocityIterationCount", ["iteration"], [0, -1, int.MinValue], static (w, v) =>
            w.Solver.VelocityIterationCount = (int)v);
        list.Add("Solver.RelaxationIterationCount", ["relaxation"], [-1, int.MinValue], static (w, v) =>
            w.Solver.RelaxationIterationCount = (int)v);
        list.Add("Simulation.Create, relaxation iteration count", ["relaxation"], [-1], static (w, v) =>
            Create(static v => new(1, 4) { RelaxationIterationCount = (int)v }, v));
        list.Add("Solver.DirectJoints", ["direct"], [-1, 3, int.MinValue], static (w, v) => w.Solver.DirectJoints = (DirectJointsMode)(int)v);
        list.Add("Simulation.Create, direct joints", ["direct"], [-1, 3], static (w, v) =>
            Create(static v => new(1, 4) { DirectJoints = (DirectJointsMode)(int)v }, v));
        list.Add("Simulation.Create, substep count", ["substep"], [0, -1], static (w, v) => Create(static v => new(1, (int)v), v));
        list.Add("Simulation.Create, velocity iteration count", ["iteration"], [0, -1], static (w, v) =>
            Create(static v => new((int)v, 4), v));
        list.Add("Simulation.Create, fallback batch threshold", ["fallback"], [0, -1], static (w, v) =>
            Create(static v => new(1, 4, (int)v), v));

        static void Create(Func<float, SolveDescription> solve, float value)
        {
            var settings = AccuracySettings.For(Effort.Default);
            var pool = new BufferPool();
            try
            {
                var contacts = EngineTraits.Contacts(settings);
                Simulation.Create(pool, contacts, new WorldGravity(settings), solve(value)).Dispose();
            }
            finally
            {
                // Also after a refusal.
                pool.AssertEmpty();
                pool.Clear();
            }
        }
    }

    static void Joints(BadInputList list)
    {
        var ballSocket = new BallSocket { LocalOffsetA = Vector3.UnitX, LocalOffsetB = -Vector3.UnitX, SpringSettings = new(30, 1) };
        Constraint(list, "LocalOffsetA.X", offset, BadInputList.NotReasonable, ballSocket, static (ref d, v) => d.LocalOffsetA.X = v);
        Constraint(list, "LocalOffsetB.Z", offset, BadInputList.NotReasonable, ballSocket, static (ref d, v) => d.LocalOffsetB.Z = v);
        Springs(list, ballSocket, static (ref d, v) => d.SpringSettings = v);

        var weld = new Weld { LocalOffset = Vector3.UnitX, LocalOrientation = Quaternion.Identity, SpringSettings = new(30, 1) };
        Constraint(list, "LocalOffset.Y", offset, BadInputList.NotReasonable, weld, static (ref d, v) => d.LocalOffset.Y = v);
        Constraint(list, "LocalOrientation.X", ["orientation"], BadInputList.NotFinite, weld, static (ref d, v) =>
            d.LocalOrientation.X = v);
        Constraint(list, "length of LocalOrientation", ["orientation"], [0, 2], weld, static (ref d, v) =>
            d.LocalOrientation = new(0, 0, 0, v));
        Springs(list, weld, static (ref d, v) => d.SpringSettings = v);

        var hinge = new Hinge
        {
            LocalOffsetA = Vector3.UnitX,
            LocalHingeAxisA = Vector3.UnitY,
            LocalOffsetB = -Vector3.UnitX,
            LocalHingeAxisB = Vector3.UnitY,
            SpringSettings = new(30, 1),
        };
        Constraint(list, "LocalOffsetA.Y", offset, BadInputList.NotReasonable, hinge, static (ref d, v) => d.LocalOffsetA.Y = v);
        Constraint(list, "LocalHingeAxisA.X", axis, BadInputList.NotFinite, hinge, static (ref d, v) => d.LocalHingeAxisA.X = v);
        Constraint(list, "length of LocalHingeAxisA", axis, [0], hinge, static (ref d, v) => d.LocalHingeAxisA = new(0, v, 0));
        Constraint(list, "length of LocalHingeAxisB", axis, [0], hinge, static (ref d, v) => d.LocalHingeAxisB = new(0, v, 0));
        Springs(list, hinge, static (ref d, v) => d.SpringSettings = v);
    }

    static void Limits(BadInputList list)
    {
        var up = Vector3.UnitY;
        var swing = new SwingLimit { AxisLocalA = up, AxisLocalB = up, MinimumDot = .5f, SpringSettings = new(30, 1) };
        Constraint(list, "AxisLocalA.Z", axis, BadInputList.NotFinite, swing, static (ref d, v) => d.AxisLocalA.Z = v);
        Constraint(list, "length of AxisLocalB", axis, [0], swing, static (ref d, v) => d.AxisLocalB = new(0, v, 0));
        Constraint(list, "MinimumDot", ["dot", "angle"], BadInputList.NotFinite, swing, static (ref d, v) => d.MinimumDot = v);
        Springs(list, swing, static (ref d, v) => d.SpringSettings = v);

        var twist = new TwistLimit
        {
            LocalBasisA = Quaternion.Identity,
            LocalBasisB = Quaternion.Identity,
            MinimumAngle = -1,
            MaximumAngle = 1,
            SpringSettings = new(30, 1),
        };
        Constraint(list, "LocalBasisA.X", ["basis"], BadInputList.NotFinite, twist, static (ref d, v) => d.LocalBasisA.X = v);
        Constraint(list, "length of LocalBasisB", ["basis"], [0, 2], twist, static (ref d, v) => d.LocalBasisB = new(0, 0, 0, v));
        Constraint(list, "MinimumAngle", ["angle"], BadInputList.NotFinite, twist, static (ref d, v) => d.MinimumAngle = v);
        Constraint(list, "MaximumAngle", ["angle"], BadInputList.NotFinite, twist, static (ref d, v) => d.MaximumAngle = v);
        Constraint(list, "MaximumAngle below MinimumAngle", ["angle"], [-2], twist, static (ref d, v) => d.MaximumAngle = v);
        Springs(list, twist, static (ref d, v) => d.SpringSettings = v);

        var distance = new DistanceLimit { MinimumDistance = 1, MaximumDistance = 2, SpringSettings = new(30, 1) };
        Constraint(list, "LocalOffsetA.Z", offset, BadInputList.NotReasonable, distance, static (ref d, v) => d.LocalOffsetA.Z = v);
        Constraint(list, "MinimumDistance", ["distance"], [.. BadInputList.NotFinite, -1], distance, static (ref d, v) =>
            d.MinimumDistance = v);
        Constraint(list, "MaximumDistance", ["distance"], [float.NaN, float.NegativeInfinity, -1], distance, static (ref d, v) =>
            d.MaximumDistance = v);
        Constraint(list, "MaximumDistance below MinimumDistance", ["distance"], [.5f], distance, static (ref d, v) =>
            d.MaximumDistance = v);
        Springs(list, distance, static (ref d, v) => d.SpringSettings = v);
    }

    static void Servos(BadInputList list)
    {
        Servo("LocalOffset.X", offset, BadInputList.NotReasonable, static (ref d, v) => d.LocalOffset.X = v);
        Servo("Target.Y", ["target"], BadInputList.NotReasonable, static (ref d, v) => d.Target.Y = v);
        float[] bad = [float.NaN, float.NegativeInfinity, -1];
        Servo("MaximumSpeed", servo, bad, static (ref d, v) => d.ServoSettings.MaximumSpeed = v);
        Servo("BaseSpeed", servo, bad, static (ref d, v) => d.ServoSettings.BaseSpeed = v);
        Servo("MaximumForce", servo, bad, static (ref d, v) => d.ServoSettings.MaximumForce = v);
        Servo("frequency", spring, [float.NaN, float.PositiveInfinity, -1], static (ref d, v) => d.SpringSettings = new(v, 1));
        Servo("damping ratio", spring, [float.NaN, float.PositiveInfinity, -1], static (ref d, v) => d.SpringSettings = new(5, v));

        void Servo(string subject, string[] words, float[] values, Edit<OneBodyLinearServo> edit)
        {
            list.Add($"Solver.Add(OneBodyLinearServo), {subject}", words, values, (w, v) => w.Solver.Add(w.FreeBody, Edited(v)));
            list.Add($"Solver.ApplyDescription(OneBodyLinearServo), {subject}", words, values, (w, v) =>
                w.Solver.ApplyDescription(w.Joint<OneBodyLinearServo>(), Edited(v)));

            OneBodyLinearServo Edited(float value)
            {
                var description = new OneBodyLinearServo { ServoSettings = ServoSettings.Default, SpringSettings = new(5, 1) };
                edit(ref description, value);
                return description;
            }
        }
    }

    static void Motors(BadInputList list)
    {
        string[] settings = ["settings", "motor", "force"];
        string[] velocity = ["velocity"];
        float[] bad = [float.NaN, float.NegativeInfinity, -1];
        var axisMotor = new AngularAxisMotor { LocalAxisA = Vector3.UnitY, TargetVelocity = 1, Settings = new(1, 0) };
        Constraint(list, "LocalAxisA.X", axis, BadInputList.NotFinite, axisMotor, static (ref d, v) => d.LocalAxisA.X = v);
        Constraint(list, "length of LocalAxisA", axis, [0, 2], axisMotor, static (ref d, v) => d.LocalAxisA = new(0, v, 0));
        Constraint(list, "TargetVelocity", velocity, BadInputList.NotReasonable, axisMotor, static (ref d, v) => d.TargetVelocity = v);
        Constraint(list, "MaximumForce", settings, bad, axisMotor, static (ref d, v) => d.Settings.MaximumForce = v);
        Constraint(list, "Damping", settings, bad, axisMotor, static (ref d, v) => d.Settings.Damping = v);
        list.Add("Solver.Add(OneBodyAngularMotor), TargetVelocity.Z", velocity, BadInputList.NotReasonable, static (w, v) =>
            w.Solver.Add(w.FreeBody, new OneBodyAngularMotor { TargetVelocity = new(0, 0, v), Settings = new(1, 0) }));
        list.Add("Solver.Add(OneBodyAngularMotor), MaximumForce", settings, bad, static (w, v) =>
            w.Solver.Add(w.FreeBody, new OneBodyAngularMotor { Settings = new(v, 0) }));
    }

    static void Handles(BadInputList list)
    {
        var ballSocket = new BallSocket { LocalOffsetA = Vector3.UnitX, LocalOffsetB = -Vector3.UnitX, SpringSettings = new(30, 1) };
        var weld = new Weld { LocalOffset = Vector3.UnitX, LocalOrientation = Quaternion.Identity, SpringSettings = new(30, 1) };
        Use("SetEnabled", static (w, h) => w.Solver.SetEnabled(h, false));
        Use("IsEnabled", static (w, h) => w.Solver.IsEnabled(h));
        Use("SetCollideConnected", static (w, h) => w.Solver.SetCollideConnected(h, false));
        Use("GetCollideConnected", static (w, h) => w.Solver.GetCollideConnected(h));
        Use("SetBreakThreshold", static (w, h) => w.Solver.SetBreakThreshold(h, new(1)));
        Use("GetBreakThreshold", static (w, h) => w.Solver.GetBreakThreshold(h));
        Use("GetSeparation", static (w, h) => w.Solver.GetSeparation(h));
        list.Add("Solver.SetBreakThreshold, impulse", ["threshold"], [float.NaN, 0, -1, float.NegativeInfinity], static (w, v) =>
            w.Solver.SetBreakThreshold(w.Joint<BallSocket>(), new(v)));
        list.Add("Solver.SetBreakThreshold, angular impulse", ["threshold"], [float.NaN, 0, -1, float.NegativeInfinity], static (w, v) =>
            w.Solver.SetBreakThreshold(w.Joint<BallSocket>(), new(1, v)));
        Use("Remove", static (w, h) => w.Solver.Remove(h));
        Use("GetDescription", static (w, h) => w.Solver.GetDescription<BallSocket>(h, out _));
        Use("ApplyDescription", (w, h) => w.Solver.ApplyDescription(h, ballSocket));
        list.Add("Solver.GetDescription, of another type", [.. constraint, "type"], static w =>
            w.Solver.GetDescription<Weld>(w.Joint<BallSocket>(), out _));
        list.Add("Solver.ApplyDescription, of another type", [.. constraint, "type"], w =>
            w.Solver.ApplyDescription(w.Joint<BallSocket>(), weld));

        string[] body = ["body", "bodies", "handle"];
        list.Add("Solver.Add, one body twice", body, w => w.Solver.Add(w.FreeBody, w.FreeBody, ballSocket));
        list.Add("Solver.Add, body that never was", body, w => w.Solver.Add(w.FreeBody, new BodyHandle(100_000), ballSocket));
        list.Add("Solver.Add, negative body handle", body, w => w.Solver.Add(new BodyHandle(-1), w.FreeBody, ballSocket));
        list.Add("Solver.Add, removed body", body, w => w.Solver.Add(w.RemovedBody, w.FreeBody, ballSocket));
        list.Add("Solver.Add, removed body for one-body constraint", body, static w => w.Solver.Add(
            w.RemovedBody, new OneBodyLinearServo { ServoSettings = ServoSettings.Default, SpringSettings = new(5, 1) }));
        list.Add("Solver.Add, too few bodies in the span", body, w => w.Solver.Add([w.FreeBody], ballSocket));
        list.Add("Solver.Add, too many bodies in the span", body, w => w.Solver.Add(
            [w.FreeBody, w.OtherBody, w.Bodies.ActiveSet.IndexToHandle[0]], ballSocket));

        void Use(string entry, Action<BadInputWorld, ConstraintHandle> use)
        {
            foreach (int value in new[] { -1, 100_000, int.MaxValue })
                list.Add($"Solver.{entry}, handle {value}", constraint, w => use(w, new ConstraintHandle(value)));
            list.Add($"Solver.{entry}, handle of a removed constraint", constraint, w => use(w, w.RemovedJoint));
        }
    }

    delegate void SpringEdit<T>(ref T description, SpringSettings value);

    /// <summary>All zeros mean rigid and are good; what is no number, or negative, is not.</summary>
    static void Springs<T>(BadInputList list, T healthy, SpringEdit<T> edit) where T : unmanaged, ITwoBodyConstraintDescription<T>
    {
        float[] bad = [float.NaN, float.PositiveInfinity, -1];
        Constraint(list, "frequency", spring, bad, healthy, (ref d, v) => edit(ref d, new SpringSettings(v, 1)));
        Constraint(list, "damping ratio", spring, bad, healthy, (ref d, v) => edit(ref d, new SpringSettings(30, v)));
    }

    /// <summary>The same bad description at both of its doors.</summary>
    static void Constraint<T>(BadInputList list, string subject, string[] words, float[] values, T healthy, Edit<T> edit)
        where T : unmanaged, ITwoBodyConstraintDescription<T>
    {
        list.Add($"Solver.Add({typeof(T).Name}), {subject}", words, values, (w, v) => w.Solver.Add(w.FreeBody, w.OtherBody, Edited(v)));
        list.Add($"Solver.ApplyDescription({typeof(T).Name}), {subject}", words, values, (w, v) =>
            w.Solver.ApplyDescription(w.Joint<T>(), Edited(v)));

        T Edited(float value)
        {
            var description = healthy;
            edit(ref description, value);
            return description;
        }
    }
}
