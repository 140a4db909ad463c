using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using Demos.Accuracy;
using DemoTests.Scenes;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Constraints;

/// <summary>Bodies that spin in hinges: without friction nothing changes their speed.</summary>
public class RotorTests(ITestOutputHelper output)
{
    static readonly Box bar = new(1, 0.2f, 0.2f);

    static TestWorld NewWorld(int substeps, int relaxations, float gravity = 0) => new(new AccuracySettings
    {
        Gravity = new(0, -gravity, 0),
        Contacts = ContactScope.None,
        SubstepCount = substeps,
        RelaxationCount = relaxations,
    });

    /// <summary>
    /// A bar of 10 kg that turns at 20 rad/s about a point a quarter of a metre from its centre. The pull m w^2 r of its joint turns with it, which
    /// the joint damps; but it never gains.
    /// </summary>
    [Theory]
    [InlineData(4, 0)]
    [InlineData(8, 0)]
    [InlineData(4, 1)]
    public void An_unbalanced_rotor_gains_no_energy(int substeps, int relaxations)
    {
        const float offset = 0.25f, speed = 20, mass = 10;
        using var world = NewWorld(substeps, relaxations);
        var anchor = world.AddKinematic(bar, new RigidPose(Vector3.Zero));
        var rotor = world.AddDynamic(bar, mass, new RigidPose(new Vector3(offset, 0, 0)));
        world.Bodies[rotor].Velocity = new(new Vector3(0, speed * offset, 0), new Vector3(0, 0, speed));
        world.Solver.Add(anchor, rotor, Hinge(default, new Vector3(-offset, 0, 0)));
        var moment = 1 / bar.ComputeInertia(mass).InverseInertiaTensor.ZZ;
        double Energy()
        {
            var velocity = world.Bodies[rotor].Velocity;
            return 0.5 * (mass * velocity.Linear.LengthSquared() + moment * velocity.Angular.LengthSquared());
        }
        double start = Energy(), most = 0;
        for (int step = 0; step < 600; ++step)
        {
            world.Step();
            most = Math.Max(most, Energy() / start - 1);
        }
        output.WriteLine($"{substeps} substeps, {relaxations} relaxations: at the end {Energy() / start - 1:P2}, at most {most:P2}");
        Assert.InRange(most, 0, 0.01);
    }

    /// <summary>A wheel on an axle through its centre bears fifty times its weight, and its hinge, which gives way by that, is no brake.</summary>
    [Theory]
    [InlineData(4, 0)]
    [InlineData(8, 0)]
    [InlineData(4, 1)]
    public void A_loaded_wheel_keeps_its_speed(int substeps, int relaxations)
    {
        const float speed = 50, mass = 20;
        var wheel = new Cylinder(0.35f, 0.2f);
        using var world = NewWorld(substeps, relaxations, gravity: 50 * 9.81f);
        var anchor = world.AddKinematic(bar, new RigidPose(new Vector3(0, 0, -1)));
        var turn = Quaternion.CreateFromAxisAngle(Vector3.UnitX, MathF.PI / 2);
        var spinning = world.AddDynamic(wheel, mass, new RigidPose(Vector3.Zero, turn));
        world.Bodies[spinning].Velocity.Angular = new Vector3(0, 0, speed);
        world.Solver.Add(anchor, spinning, new Hinge
        {
            LocalOffsetA = Vector3.UnitZ,
            LocalHingeAxisA = Vector3.UnitZ,
            LocalHingeAxisB = Vector3.Transform(Vector3.UnitZ, Quaternion.Conjugate(turn)),
        });
        for (int step = 0; step < 600; ++step)
            world.Step();
        output.WriteLine($"{world.Bodies[spinning].Velocity.Angular}");
        Assert.Equal(speed, world.Bodies[spinning].Velocity.Angular.Z, 0.001 * speed);
    }

    /// <summary>
    /// A bar between two hinges, which a motor brings to 300 rad/s about its long axis and lets go. With four substeps that is more than a turn's
    /// fifth in each.
    /// </summary>
    [Theory]
    [InlineData(8, 0)]
    [InlineData(8, 1)]
    [InlineData(16, 0)]
    public void A_flywheel_in_two_hinges_runs_up_and_keeps_its_speed(int substeps, int relaxations)
    {
        const float speed = 300, mass = 10;
        using var world = NewWorld(substeps, relaxations, gravity: 9.81f);
        var anchor = world.AddKinematic(bar, new RigidPose(Vector3.Zero));
        var rotor = world.AddDynamic(bar, mass, new RigidPose(Vector3.Zero));
        foreach (var end in new[] { -0.5f, 0.5f })
            world.Solver.Add(anchor, rotor, Hinge(new(end, 0, 0), new(end, 0, 0), Vector3.UnitX));
        var motor = world.Solver.Add(rotor, anchor, new AngularAxisMotor
        {
            LocalAxisA = Vector3.UnitX,
            TargetVelocity = speed,
            Settings = new MotorSettings(10, 0),
        });
        double gap = 0;
        void Step()
        {
            world.Step();
            var pose = world.Bodies[rotor].Pose;
            foreach (var end in new[] { -0.5f, 0.5f })
                gap = Math.Max(gap, (pose.Position + Vector3.Transform(new Vector3(end, 0, 0), pose.Orientation) - new Vector3(end, 0, 0)).Length());
        }
        for (int step = 0; step < 300; ++step)
            Step();
        Assert.Equal(speed, Math.Abs(world.Bodies[rotor].Velocity.Angular.X), 0.01 * speed);
        world.Solver.Remove(motor);
        for (int step = 0; step < 600; ++step)
            Step();
        var left = Math.Abs(world.Bodies[rotor].Velocity.Angular.X) / speed;
        output.WriteLine($"{substeps} substeps, {relaxations} relaxations: {left - 1:P3} of its speed, gap {gap * 1000:0.000} mm");
        // Energy goes with the square.
        Assert.InRange(left * left, 0.95, 1.01);
        // The weight is carried by both: half of g over the square of the frequency, and as much again until it has come to rest.
        var frequency = 2 * Math.PI * SpringSettings.JointCyclesPerSubstep(1, relaxations) * 60 * substeps;
        Assert.InRange(gap, 0, 2 * 9.81 / (frequency * frequency));
    }

    static Hinge Hinge(Vector3 onAnchor, Vector3 onRotor) => Hinge(onAnchor, onRotor, Vector3.UnitZ);

    static Hinge Hinge(Vector3 onAnchor, Vector3 onRotor, Vector3 axis) =>
        new() { LocalOffsetA = onAnchor, LocalHingeAxisA = axis, LocalOffsetB = onRotor, LocalHingeAxisB = axis };
}
