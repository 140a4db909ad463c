using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using BepuUtilities;
using BepuUtilities.Memory;
using DemoTests.Support;
using Xunit;

namespace DemoTests.Scenes;

/// <summary>Whatever values within <see cref="Limits"/> are put together, steps end in numbers; beyond, a value is refused.</summary>
public class LimitsTests
{
    public enum Scene { Free, OnStatic, OnBody, BallSocket, Weld, Hinge, SwingLimit, TwistLimit, DistanceLimit, Servo }

    public static TheoryData<Scene> Scenes => [.. Enum.GetValues<Scene>()];

    [Theory]
    [MemberData(nameof(Scenes))]
    public void WhatIsAcceptedCanBeSimulated(Scene scene)
    {
        var random = new Random(31 + (int)scene);
        int simulated = 0;
        for (int i = 0; i < 800; ++i)
        {
            var draw = new Draw(random, false);
            if (Run(scene, draw) is not { } finite)
                continue;
            Assert.True(finite, $"{scene}, {i}:{draw.Text}");
            ++simulated;
        }
        Assert.True(simulated > 600, $"{simulated} of 800 simulated");
    }

    /// <summary>The ranges that games need: 10,000 km from the origin, 1 km/s, 1e-6 to 1e6 kg, 1 mm to 1 km. Nothing of them may be refused.</summary>
    [Theory]
    [MemberData(nameof(Scenes))]
    public void WhatGamesNeedIsAcceptedAndSimulated(Scene scene)
    {
        var random = new Random(71 + (int)scene);
        for (int i = 0; i < 300; ++i)
        {
            var draw = new Draw(random, true);
            Assert.True(Run(scene, draw) == true, $"{scene}, {i}:{draw.Text}");
        }
    }

    [Fact]
    public void BeyondTheLimitsEachValueIsRefusedAndNothingChanges()
    {
        using var pool = new BufferPool();
        using var simulation = EmptySimulation.Create(pool);
        var good = BodyDescription.CreateDynamic(RigidPose.Identity, new Sphere(1).ComputeInertia(1), default, new(0.01f));
        BodyHandle a = simulation.Bodies.Add(good), b = simulation.Bodies.Add(good);
        var body = simulation.Bodies[a];
        const float beyond = 1.01f;
        var pose = good with { Pose = new Vector3(0, Limits.MaximumPosition * beyond, 0) };
        var linear = good with { Velocity = new(new Vector3(-Limits.MaximumLinearVelocity * beyond, 0, 0)) };
        var angular = good with { Velocity = new(default, new Vector3(0, 0, Limits.MaximumAngularVelocity * beyond)) };
        var light = good with { LocalInertia = good.LocalInertia with { InverseMass = beyond / Limits.MinimumMass } };
        var heavy = good with { LocalInertia = good.LocalInertia with { InverseMass = 1 / (Limits.MaximumMass * beyond) } };
        var thin = good with
        {
            LocalInertia = good.LocalInertia with { InverseInertiaTensor = Symmetric3x3.Diagonal(Limits.MaximumInverseInertia * beyond, 1, 1) },
        };
        var far = new Vector3(Limits.MaximumOffset * beyond, 0, 0);
        var stiff = new SpringSettings(Limits.MaximumSpringFrequency * beyond, 1);
        var damped = new SpringSettings(30, Limits.MaximumDampingRatio * beyond);
        foreach (var description in (BodyDescription[])[pose, linear, angular, light, heavy, thin])
        {
            Refuses(() => simulation.Bodies.Add(description));
            Refuses(() => simulation.Bodies.ApplyDescription(a, description));
        }
        Refuses(() => simulation.Solver.Add(a, b, new BallSocket { LocalOffsetA = far }));
        Refuses(() => simulation.Solver.Add(a, b, new BallSocket { SpringSettings = stiff }));
        Refuses(() => simulation.Solver.Add(a, b, new BallSocket { SpringSettings = damped }));
        Refuses(() => simulation.Solver.Add(a, b, new DistanceLimit(default, default, Limits.MaximumDistance * beyond, float.MaxValue, default)));
        Refuses(() => simulation.Solver.Add(a, new OneBodyLinearServo
        { Target = new(Limits.MaximumPosition * beyond), ServoSettings = ServoSettings.Default }));
        Refuses(() => simulation.Solver.Add(a, new OneBodyLinearServo { ServoSettings = new(1, Limits.MaximumServoBaseSpeed * beyond, 1) }));
        Refuses(() => simulation.Timestep(Limits.MaximumTimestep * beyond));
        Refuses(() => simulation.Timestep(Limits.MinimumTimestep / beyond));
        // Not the impulse: the velocity that it would give.
        var impulse = new Vector3(Limits.MaximumLinearVelocity * beyond, 0, 0);
        Refuses(() => body.ApplyLinearImpulse(impulse));
        Refuses(() => body.ApplyImpulse(impulse, default));
        Refuses(() => body.ApplyAngularImpulse(impulse));
        Refuses(() => body.ApplyImpulse(new(1000, 0, 0), new(0, Limits.MaximumAngularVelocity, 0)));
        body.ApplyLinearImpulse(new(0.99f * Limits.MaximumLinearVelocity, 0, 0));

        void Refuses(Action call)
        {
            var hash = simulation.StateHash();
            Assert.ThrowsAny<ArgumentException>(call);
            Assert.Equal((2, 0, hash), (simulation.Bodies.CountBodies(), simulation.Solver.CountConstraints(), simulation.StateHash()));
        }
    }

    // Null when something was refused, else whether all is finite after some steps.
    static bool? Run(Scene scene, Draw draw)
    {
        using var pool = new BufferPool();
        using var simulation = EmptySimulation.Create(pool, draw.Below(4) + 1);
        try
        {
            var origin = draw.Vector("origin", 1e-3f, draw.IsTame ? 1e7f : Limits.MaximumPosition * 0.5f, 0);
            var size = draw.Number("size", draw.IsTame ? 1e-3f : 2 * Limits.MinimumSize, draw.IsTame ? 1e3f : 2 * Limits.MaximumSize, 1);
            var box = new Box(size, size, size);
            var shape = simulation.Shapes.Add(box);
            var a = Add(simulation, draw, scene, origin, box, shape);
            if (scene == Scene.OnStatic)
                simulation.Statics.Add(new StaticDescription(origin - new Vector3(0, size * 0.9f, 0), shape));
            else if (scene == Scene.Servo)
                simulation.Solver.Add(a, draw.Servo(origin));
            else if (scene != Scene.Free)
                Connect(simulation, draw, scene, a, Add(simulation, draw, scene, origin + new Vector3(size * 0.9f, 0.1f * size, 0), box, shape));
            var dt = draw.Number("dt", draw.IsTame ? 1e-4f : Limits.MinimumTimestep, draw.IsTame ? 0.1f : Limits.MaximumTimestep, 1 / 60f);
            for (int step = 0; step < 4; ++step)
                simulation.Timestep(dt);
        }
        catch (ArgumentException)
        {
            return null;
        }
        return IsFinite(simulation);
    }

    static BodyHandle Add(Simulation simulation, Draw draw, Scene scene, Vector3 position, Box box, TypedIndex shape)
    {
        var mass = draw.Number("mass", draw.IsTame ? 1e-6f : Limits.MinimumMass, draw.IsTame ? 1e6f : Limits.MaximumMass, 1);
        var velocity = new BodyVelocity(
            draw.Vector("linear", 1e-3f, draw.IsTame ? 1e3f : Limits.MaximumLinearVelocity, 1),
            draw.Vector("angular", 1e-3f, draw.IsTame ? 1e3f : Limits.MaximumAngularVelocity, 1));
        CollidableDescription collidable = scene is Scene.OnStatic or Scene.OnBody ? new(shape) : default;
        return simulation.Bodies.Add(BodyDescription.CreateDynamic(
            new RigidPose(position, draw.Turn()), velocity, box.ComputeInertia(mass), collidable, new(0.01f)));
    }

    static void Connect(Simulation simulation, Draw draw, Scene scene, BodyHandle a, BodyHandle b)
    {
        Vector3 offsetA = draw.Offset(), offsetB = draw.Offset();
        var spring = draw.Spring();
        Vector3 axisA = Vector3.Transform(Vector3.UnitX, draw.Turn()), axisB = Vector3.Transform(Vector3.UnitX, draw.Turn());
        var least = draw.Number("distance", 1e-3f, draw.IsTame ? 1e4f : Limits.MaximumDistance, 1);
        var solver = simulation.Solver;
        switch (scene)
        {
            case Scene.BallSocket:
                solver.Add(a, b, new BallSocket { LocalOffsetA = offsetA, LocalOffsetB = offsetB, SpringSettings = spring });
                break;
            case Scene.Weld:
                solver.Add(a, b, new Weld { LocalOffset = offsetA, LocalOrientation = draw.Turn(), SpringSettings = spring });
                break;
            case Scene.Hinge:
                solver.Add(a, b, new Hinge
                { LocalOffsetA = offsetA, LocalOffsetB = offsetB, LocalHingeAxisA = axisA, LocalHingeAxisB = axisB, SpringSettings = spring });
                break;
            case Scene.SwingLimit:
                solver.Add(a, b, new SwingLimit { AxisLocalA = axisA, AxisLocalB = axisB, MinimumDot = 0.9f, SpringSettings = spring });
                break;
            case Scene.TwistLimit:
                solver.Add(a, b, new TwistLimit
                { LocalBasisA = draw.Turn(), LocalBasisB = draw.Turn(), MinimumAngle = -0.1f, MaximumAngle = 0.1f, SpringSettings = spring });
                break;
            case Scene.DistanceLimit:
                solver.Add(a, b, new DistanceLimit(offsetA, offsetB, least, draw.Below(3) == 0 ? float.MaxValue : 2 * least, spring));
                break;
        }
    }

    static bool IsFinite(Simulation simulation)
    {
        for (int i = 0; i < simulation.Bodies.ActiveSet.Count; ++i)
        {
            ref var motion = ref simulation.Bodies.ActiveSet.MotionStates[i];
            var sum = motion.Pose.Position * 0 + motion.Velocity.Linear * 0 + motion.Velocity.Angular * 0;
            if (sum != Vector3.Zero || !(Math.Abs(motion.Pose.Orientation.Length() - 1) < 0.01f))
                return false;
        }
        return true;
    }

    /// <summary>Values from a least to a greatest, each power of ten as likely, and the ends and an ordinary value often.</summary>
    sealed class Draw(Random random, bool isTame)
    {
        public bool IsTame => isTame;

        public string Text { get; private set; } = "";

        public int Below(int count) => random.Next(count);

        public float Number(string name, float least, float greatest, float ordinary)
        {
            var value = random.Next(10) switch
            {
                < 3 => ordinary,
                3 => least,
                4 => greatest,
                _ => (float)(least * Math.Pow((double)greatest / least, random.NextDouble())),
            };
            Text += FormattableString.Invariant($" {name} {value:g3}");
            return value;
        }

        public Vector3 Vector(string name, float least, float greatest, float ordinary)
        {
            var size = Number(name, least, greatest, ordinary);
            return new Vector3(1, random.NextSingle() * 2 - 1, random.NextSingle() * 2 - 1) * size;
        }

        public Vector3 Offset() => Vector("offset", 1e-6f, isTame ? 1e3f : Limits.MaximumOffset, 1);

        public Quaternion Turn() => Quaternion.Normalize(
            new(random.NextSingle() - 0.5f, random.NextSingle() - 0.5f, random.NextSingle() - 0.5f, random.NextSingle() - 0.5f));

        public SpringSettings Spring() => random.Next(2) == 0 ? default : new(
            Number("frequency", 1e-3f, isTame ? 1e6f : Limits.MaximumSpringFrequency, 30),
            Number("damping", 1e-3f, isTame ? 1e3f : Limits.MaximumDampingRatio, 1));

        public OneBodyLinearServo Servo(Vector3 origin) => new()
        {
            LocalOffset = Offset(),
            Target = Below(2) == 0 ? origin + new Vector3(1, 2, 3) : Vector("target", 1e-3f, isTame ? 1e7f : Limits.MaximumPosition, 1),
            SpringSettings = Spring(),
            ServoSettings = new(Number("speed", 1e-3f, float.MaxValue, 1), Number("base", 1e-3f, isTame ? 1e3f : Limits.MaximumServoBaseSpeed, 1),
                Number("force", 1e-3f, float.MaxValue, 100)),
        };
    }
}
