using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using Demos.Accuracy;
using Demos.Running;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Constraints;

/// <summary>
/// A spring on a ball that it holds at its centre, which is linear, against the damped oscillator that its settings describe: how often and how far it swings,
/// and where it hangs. And many of them, which may be no source of energy.
/// </summary>
public class SpringStepTests
{
    // A spring hangs where its frequency says and damps as its ratio says; what is left is that damped ones are slow by half of z w h, since two coefficients
    // cannot do all three (Docs/decisions/springs.md).
    [Theory]
    [InlineData(1, 1, 0, DirectJointsChoice.Off)]
    [InlineData(2, 1, 0, DirectJointsChoice.Off)]
    [InlineData(4, 1, 0, DirectJointsChoice.Off)]
    [InlineData(8, 1, 0, DirectJointsChoice.Off)]
    [InlineData(4, 3, 0, DirectJointsChoice.Off)]
    [InlineData(4, 1, 1, DirectJointsChoice.Off)]
    [InlineData(4, 1, 0, DirectJointsChoice.Always)]
    public void It_swings_and_hangs_as_its_settings_say(int substeps, int iterations, int relaxations, DirectJointsChoice directJoints)
    {
        var settings = new AccuracySettings
        {
            Contacts = ContactScope.None,
            SubstepCount = substeps,
            VelocityIterationCount = iterations,
            RelaxationCount = relaxations,
            DirectJoints = directJoints,
        };
        foreach (var frequency in new[] { .1f, 1, 3, 10 })
        {
            // As far as a substep is short beside the period.
            var angle = frequency * Math.Tau * TestWorld.Dt / substeps;
            if (angle > .3)
                continue;
            foreach (var ratio in new[] { 0, .05f, .1f, .3f, .7f, 1 })
            {
                var name = $"{frequency} Hz, damping ratio {ratio}";
                var (measured, damping) = Measure(settings, frequency, ratio);
                var slow = 1 + ratio * angle / 2;
                Assert.True(Math.Abs(measured / frequency * slow - 1) < .007, $"{name}: {measured} Hz");
                // What is kept after three periods.
                var kept = Math.Exp(-6 * Math.PI * (damping - ratio));
                Assert.True(Math.Abs(kept - 1) < .02, $"{name}: damping ratio {damping}, {kept} of the swing");
                Assert.Equal(1, Sag(settings, frequency, ratio), .001);
            }
        }
    }

    // Undamped and coupled through bodies that many of them hold, some at the greatest frequency that there is.
    [Theory]
    [InlineData(1), InlineData(2), InlineData(8), InlineData(50), InlineData(200)]
    public void Many_undamped_springs_on_a_body_gain_no_energy(int count)
    {
        foreach (var frequency in new[] { 1f, 3, 6, 10, 15, 20, 30 })
        {
            using var world = World(new AccuracySettings { Gravity = default, Contacts = ContactScope.None }, frequency, 0, Vector3.UnitX, count, out var ball);
            float first = 1, second = 0;
            for (int i = 0; i < 600; ++i)
            {
                world.Step();
                ref var greatest = ref i < 300 ? ref first : ref second;
                greatest = MathF.Max(greatest, world.Bodies[ball].Pose.Position.Length());
            }
            // Places of an explicit step that keeps its energy lie on an ellipse that is somewhat longer than where they began.
            Assert.True(first < 1.2f && second < 1.001f * first, $"{count} springs of {frequency} Hz: {first}, then {second}.");
        }
    }

    // Each on the one before; the last hangs.
    [Fact]
    public void A_chain_of_undamped_springs_gains_no_energy()
    {
        const int count = 12;
        foreach (var frequency in new[] { 1f, 3, 10, 30 })
        {
            using var world = new TestWorld(new AccuracySettings { Gravity = default, Contacts = ContactScope.None });
            var random = new Random(7);
            var last = world.AddKinematic(new Sphere(.1f), RigidPose.Identity);
            var balls = new List<BodyHandle>();
            var start = 0.0;
            for (int i = 0; i < count; ++i)
            {
                // All energy is that of motion to begin with.
                var speed = random.NextSingle() - .5f;
                var ball = world.AddDynamic(new Sphere(.1f), 1, RigidPose.Identity, new BodyVelocity(new Vector3(speed, 0, 0), default));
                world.Solver.Add(last, ball, new BallSocket { SpringSettings = new SpringSettings(frequency, 0) });
                balls.Add(last = ball);
                start += speed * speed;
            }
            for (int i = 0; i < 600; ++i)
            {
                world.Step();
                Assert.InRange(balls.Sum(ball => world.Bodies[ball].Velocity.Linear.LengthSquared()), 0, 1.1 * start);
            }
        }
    }

    static TestWorld World(AccuracySettings settings, float frequency, float ratio, Vector3 place, int count, out BodyHandle ball)
    {
        var world = new TestWorld(settings);
        ball = world.AddDynamic(new Sphere(.1f), 1, new RigidPose(place));
        for (int i = 0; i < count; ++i)
        {
            var anchor = world.AddKinematic(new Sphere(.1f), RigidPose.Identity);
            world.Solver.Add(anchor, ball, new BallSocket { SpringSettings = new SpringSettings(frequency, ratio) });
        }
        return world;
    }

    static (double Frequency, double Ratio) Measure(AccuracySettings settings, float frequency, float ratio)
    {
        using var world = World(settings with { Gravity = default }, frequency, ratio, Vector3.UnitX, 1, out var ball);
        var places = new List<double>();
        for (int i = 0; i < Math.Max(4, 1 / frequency / TestWorld.Dt); ++i)
        {
            world.Step();
            places.Add(world.Bodies[ball].Pose.Position.X);
        }
        // x'' = t x' - d x, by least squares.
        double aa = 0, ab = 0, bb = 0, ac = 0, bc = 0;
        for (int i = 2; i < places.Count; ++i)
        {
            var (a, b, c) = (places[i - 1], -places[i - 2], places[i]);
            (aa, ab, bb) = (aa + a * a, ab + a * b, bb + b * b);
            (ac, bc) = (ac + a * c, bc + b * c);
        }
        var det = aa * bb - ab * ab;
        var t = (ac * bb - bc * ab) / det;
        var d = (bc * aa - ac * ab) / det;
        var decay = -.5 * Math.Log(d);
        var root = t * t / 4 - d;
        double angular;
        if (root < 0)
        {
            var angle = Math.Atan2(Math.Sqrt(-root), t / 2);
            angular = Math.Sqrt(decay * decay + angle * angle);
        }
        else
        {
            var (l1, l2) = (Math.Log(t / 2 + Math.Sqrt(root)), Math.Log(t / 2 - Math.Sqrt(root)));
            angular = Math.Sqrt(l1 * l2);
        }
        return (angular / Math.Tau / TestWorld.Dt, decay / angular);
    }

    // Put where it hangs, it stays: its mean depth in four periods, or a second, as a part of that depth.
    static double Sag(AccuracySettings settings, float frequency, float ratio)
    {
        var angular = frequency * Math.Tau;
        var depth = 9.81 / (angular * angular);
        using var world = World(settings with { Gravity = new Vector3(0, -9.81f, 0) }, frequency, ratio, new Vector3(0, (float)-depth, 0), 1, out var ball);
        var sum = 0.0;
        var steps = (int)Math.Max(60, 4 / frequency / TestWorld.Dt);
        for (int i = 0; i < steps; ++i)
        {
            world.Step();
            sum -= world.Bodies[ball].Pose.Position.Y;
        }
        return sum / steps / depth;
    }
}
