using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using Demos.Accuracy;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Constraints;

/// <summary>Motors in worlds whose answer is known.</summary>
public class MotorSceneTests
{
    // Inertia of a ball of this radius and mass: 2/5 m r^2 = 0.2 kg m^2.
    static readonly Sphere ball = new(0.5f);
    const float Mass = 2;
    const float Inertia = 0.2f;

    static TestWorld World(int relaxations = 0) => new(new AccuracySettings { Gravity = default, RelaxationCount = relaxations, Contacts = ContactScope.None });

    static BodyHandle AddBall(TestWorld world, Vector3 spin = default, float x = 0) =>
        world.AddDynamic(ball, Mass, new RigidPose(new Vector3(x, 0, 0)), new BodyVelocity(default, spin));

    static Vector3 Spin(TestWorld world, BodyHandle body) => world.Bodies[body].Velocity.Angular;

    static void AssertClose(Vector3 expected, Vector3 actual, float tolerance) =>
        Assert.True((expected - actual).Length() <= tolerance, $"Expected {expected}, actual {actual}.");

    /// <summary>t = I w / T, and no torque is left over when it is there.</summary>
    [Theory, InlineData(0), InlineData(1)]
    public void A_limited_torque_takes_its_time(int relaxations)
    {
        using var world = World(relaxations);
        var body = AddBall(world);
        var target = new Vector3(2, -4, 4);
        const float Torque = 0.8f;
        var motor = world.Solver.Add(body, new OneBodyAngularMotor { TargetVelocity = target, Settings = new(Torque, 0) });
        // 0.2 * 6 / 0.8 s = 1.5 s = 90 steps.
        for (int step = 1; step <= 89; ++step)
        {
            world.Step();
            AssertClose(target * (step / 90f), Spin(world, body), 2e-4f);
        }
        world.Step(2);
        AssertClose(target, Spin(world, body), 1e-4f);
        Assert.Equal(0, world.Solver.GetAccumulatedImpulseMagnitude(motor), 1e-5f);
        world.Step(60);
        AssertClose(target, Spin(world, body), 1e-4f);
    }

    [Fact]
    public void Without_a_limit_it_stops_at_once()
    {
        using var world = World();
        var body = AddBall(world, new Vector3(30, 10, -20));
        world.Solver.Add(body, new OneBodyAngularMotor { Settings = new(float.MaxValue, 0) });
        // By the end of the first substep, which is seen at the beginning of the second.
        var seen = new Vector3(1);
        world.Solver.SubstepStarted += substep =>
        {
            if (substep == 1)
                seen = Spin(world, body);
        };
        world.Step();
        AssertClose(default, seen, 1e-4f);
        AssertClose(default, Spin(world, body), 1e-4f);
    }

    /// <summary>Under a load T the velocity stays behind by softness T / I, whatever the length of the steps.</summary>
    [Theory, InlineData(1 / 60f), InlineData(1 / 240f), InlineData(1 / 30f)]
    public void Softness_yields_to_a_load(float dt)
    {
        using var world = World();
        var body = AddBall(world);
        const float Load = 0.3f;
        const float Softness = 0.25f;
        // A motor that never gets where it wants to be is a constant torque.
        world.Solver.Add(body, new OneBodyAngularMotor { TargetVelocity = new Vector3(0, -1e4f, 0), Settings = new(Load, 0) });
        world.Solver.Add(body, new OneBodyAngularMotor { TargetVelocity = new Vector3(0, 5, 0), Settings = new(float.MaxValue, Softness) });
        for (float time = 0; time < 6; time += dt)
            world.Step(dt);
        AssertClose(new Vector3(0, 5 - Softness * Load / Inertia, 0), Spin(world, body), 2e-3f);
    }

    /// <summary>Without a load the error falls by exp(-t / softness), to first order in the substep.</summary>
    [Fact]
    public void Softness_is_the_time_constant()
    {
        using var world = World();
        var body = AddBall(world);
        world.Solver.Add(body, new OneBodyAngularMotor { TargetVelocity = new Vector3(0, 5, 0), Settings = new(float.MaxValue, 0.5f) });
        world.Step(60);
        Assert.Equal(5 * (1 - MathF.Exp(-2)), Spin(world, body).Y, 0.01f);
    }

    [Fact]
    public void Two_bodies_keep_their_angular_momentum()
    {
        using var world = World();
        var axis = Vector3.Normalize(new Vector3(1, 2, -2));
        var a = AddBall(world);
        var heavy = new Sphere(1);
        var b = world.AddDynamic(heavy, 3, new RigidPose(new Vector3(5, 0, 0)));
        world.Solver.Add(a, b, new AngularAxisMotor { LocalAxisA = axis, TargetVelocity = 6, Settings = new(1, 0) });
        var energy = 0f;
        for (int i = 0; i < 240; ++i)
        {
            world.Step();
            var momentum = Spin(world, a) * Inertia + Spin(world, b) * 1.2f;
            AssertClose(default, momentum, 1e-4f);
            // What a torque can have done: it never takes back, and never gives more than that of the target.
            var now = (Spin(world, a).LengthSquared() * Inertia + Spin(world, b).LengthSquared() * 1.2f) / 2;
            Assert.True(now >= energy * 0.9999f, $"{now} after {energy}");
            energy = now;
        }
        // Reduced inertia 0.2 * 1.2 / 1.4 at 6 rad/s.
        Assert.Equal(0.2f * 1.2f / 1.4f * 36 / 2, energy, 1e-3f);
        AssertClose(axis * 6, Spin(world, a) - Spin(world, b), 1e-3f);
    }

    [Theory, InlineData(false), InlineData(true)]
    public void A_kinematic_partner_turns_the_other(bool kinematicFirst)
    {
        using var world = World();
        var body = AddBall(world);
        var partner = world.AddKinematic(ball, new RigidPose(new Vector3(5, 0, 0)));
        world.Bodies[partner].Velocity.Angular = new Vector3(0, 2, 0);
        var motor = new AngularAxisMotor { LocalAxisA = Vector3.UnitY, TargetVelocity = 3, Settings = new(float.MaxValue, 0) };
        if (kinematicFirst)
            world.Solver.Add(partner, body, motor);
        else
            world.Solver.Add(body, partner, motor);
        world.Step(30);
        AssertClose(new Vector3(0, kinematicFirst ? -1 : 5, 0), Spin(world, body), 1e-4f);
        AssertClose(new Vector3(0, 2, 0), Spin(world, partner), 0);
    }

    [Fact]
    public void It_turns_about_its_axis_only()
    {
        using var world = World();
        var body = AddBall(world, new Vector3(1, 0, 3));
        var partner = world.AddKinematic(ball, new RigidPose(new Vector3(5, 0, 0)));
        // The axis is that of the partner, so that it stays where it is.
        world.Solver.Add(partner, body, new AngularAxisMotor { LocalAxisA = Vector3.UnitY, TargetVelocity = -4, Settings = new(float.MaxValue, 0) });
        world.Step(30);
        AssertClose(new Vector3(1, 4, 3), Spin(world, body), 1e-3f);
    }

    /// <summary>About the axes of A, which stays where it is: the opposite turns the other.</summary>
    [Fact]
    public void An_angular_motor_turns_A_against_B()
    {
        using var world = World();
        var quarter = Quaternion.CreateFromAxisAngle(Vector3.UnitZ, MathF.PI / 2);
        var a = world.AddKinematic(ball, new RigidPose(Vector3.Zero, quarter));
        var b = AddBall(world, x: 5);
        world.Solver.Add(a, b, new AngularMotor { TargetVelocityLocalA = new Vector3(2, 0, 1), Settings = new(float.MaxValue, 0) });
        world.Step(30);
        // X of A is Y of the world.
        AssertClose(new Vector3(0, -2, -1), Spin(world, b), 1e-4f);
    }

    [Theory, InlineData(2f), InlineData(-0.5f)]
    public void A_gear_turns_B_by_a_multiple_of_A(float scale)
    {
        using var world = World();
        var a = AddBall(world, new Vector3(0, 6, 0));
        var b = AddBall(world, new Vector3(1, 0, 0), x: 5);
        world.Solver.Add(a, b, new AngularAxisGearMotor { LocalAxisA = Vector3.UnitY, VelocityScale = scale, Settings = new(float.MaxValue, 0) });
        world.Step(30);
        // scale wA = wB, with torques scale : -1 on equal inertias: 6 - scale^2 x = x for wA, and wB = scale wA.
        var expected = 6 / (1 + scale * scale);
        Assert.Equal(expected, Spin(world, a).Y, 1e-3f);
        Assert.Equal(expected * scale, Spin(world, b).Y, 1e-3f);
        Assert.Equal(1, Spin(world, b).X, 1e-3f);
    }

    [Fact]
    public void Torque_and_target_can_be_changed()
    {
        using var world = World();
        var body = AddBall(world);
        var motor = world.Solver.Add(body, new OneBodyAngularMotor { TargetVelocity = Vector3.UnitX, Settings = new(10, 0) });
        world.Step(10);
        AssertClose(Vector3.UnitX, Spin(world, body), 1e-4f);
        world.Solver.ApplyDescription(motor, new OneBodyAngularMotor { TargetVelocity = Vector3.UnitZ, Settings = default });
        world.Step(10);
        AssertClose(Vector3.UnitX, Spin(world, body), 1e-4f);
        world.Solver.GetDescription<OneBodyAngularMotor>(motor, out var read);
        Assert.Equal(Vector3.UnitZ, read.TargetVelocity);
    }

    [Fact]
    public void A_setting_says_what_it_is()
    {
        var settings = new MotorSettings(7, 0.25f);
        Assert.Equal((7, 4, 0.25f), (settings.MaximumForce, settings.Damping, settings.Softness));
        Assert.Equal(float.MaxValue, new MotorSettings(7, 0).Damping);
        Assert.True(MotorSettings.Validate(settings) && MotorSettings.Validate(default) && MotorSettings.Validate(new(float.PositiveInfinity, 0)));
        Assert.False(MotorSettings.Validate(new(-1, 0)) || MotorSettings.Validate(new(float.NaN, 0)) || MotorSettings.Validate(new(1, float.NaN)));
    }
}
