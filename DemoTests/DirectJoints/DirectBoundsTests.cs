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
using Xunit.Abstractions;

namespace DemoTests.DirectJoints;

/// <summary>Limits, servos and motors that are solved together with the joints beside them.</summary>
public class DirectBoundsTests(ITestOutputHelper output)
{
    static readonly AccuracySettings direct = new() { DirectJoints = DirectJointsChoice.Always, Contacts = ContactScope.None };
    static readonly AccuracySettings swept = direct with { DirectJoints = DirectJointsChoice.Off };

    // 1 / (w h (w h + 2)) with thirty periods per substep.
    const double Softness = 2.785e-5;

    /// <summary>One substep of random structures, beside a solution that tries which bounds hold.</summary>
    [Fact]
    public void Velocities_are_those_that_obey_all_bounds()
    {
        const float radius = .5f;
        var (active, inside) = (0, 0);
        for (int seed = 1; seed <= 40; ++seed)
        {
            var random = new Random(seed);
            float Next() => 2 * random.NextSingle() - 1;
            Vector3 Direction() => new(Next(), Next(), Next());
            using var world = new TestWorld(direct with { SubstepCount = 1, Gravity = default });
            var reference = new BoundedRows();
            var handles = new List<BodyHandle>();
            var count = 8;
            for (int i = 0; i < count; ++i)
            {
                var pose = new RigidPose(3 * Direction(), Quaternion.Normalize(new(Next(), Next(), Next(), 1.5f)));
                var mass = MathF.Exp(3 * Next());
                handles.Add(i == 0 ? world.AddKinematic(new Sphere(radius), pose) : world.AddDynamic(new Sphere(radius), mass, pose));
                var velocity = new BodyVelocity(3 * Direction(), 3 * Direction());
                world.Bodies[handles[i]].Velocity = velocity;
                reference.AddBody(
                    i == 0 ? 0 : 1d / mass, i == 0 ? 0 : 2.5 / mass / (radius * radius), [.. Numbers(velocity.Linear), .. Numbers(velocity.Angular)]);
            }
            for (int b = 1; b < count; ++b)
            {
                var a = random.Next(0, b);
                var socket = new BallSocket { LocalOffsetA = Direction(), LocalOffsetB = Direction() };
                var (poseA, poseB) = (world.Bodies[handles[a]].Pose, world.Bodies[handles[b]].Pose);
                var armA = Vector3.Transform(socket.LocalOffsetA, poseA.Orientation);
                var armB = Vector3.Transform(socket.LocalOffsetB, poseB.Orientation);
                poseB.Position = poseA.Position + armA - armB;
                world.Bodies[handles[b]].Pose = poseB;
                world.Solver.Add(handles[a], handles[b], socket);
                foreach (var axis in new[] { Vector3.UnitX, Vector3.UnitY, Vector3.UnitZ })
                    reference.Add([(a, Along(-axis, armA)), (b, Along(axis, armB))], 0);
            }
            var impulses = new List<(ConstraintHandle Handle, double Least, double Most)>();
            for (int i = 0; i < 5; ++i)
            {
                var b = random.Next(1, count);
                var a = (b + random.Next(1, count)) % count;
                var (poseA, poseB) = (world.Bodies[handles[a]].Pose, world.Bodies[handles[b]].Pose);
                if (i % 2 == 0)
                {
                    var difference = poseB.Position - poseA.Position;
                    var distance = difference.Length();
                    // Some violated, some just reached, some with slack.
                    var most = distance + .03f * Next();
                    var direction = difference / distance;
                    world.Solver.Add(handles[a], handles[b], new DistanceLimit { MaximumDistance = most });
                    var slack = most - distance;
                    // What is violated goes back as fast as by sweeps with one of them: w h = tau / 8.
                    var angle = Math.Tau / 8;
                    var target = -slack * (slack > 0 ? 1 : angle / (angle + 2)) / TestWorld.Dt;
                    reference.Add([(a, Along(direction, default)), (b, Along(-direction, default))], target, Softness, least: 0);
                    continue;
                }
                var motor = new AngularAxisMotor
                {
                    LocalAxisA = Vector3.Normalize(Direction()),
                    TargetVelocity = 4 * Next(),
                    Settings = new(MathF.Exp(4 + 3 * Next()), 0),
                };
                world.Solver.Add(handles[a], handles[b], motor);
                var turn = Numbers(Vector3.Transform(motor.LocalAxisA, poseA.Orientation));
                var bound = motor.Settings.MaximumForce * TestWorld.Dt;
                reference.Add([(a, [0, 0, 0, .. turn]), (b, [0, 0, 0, -turn[0], -turn[1], -turn[2]])], motor.TargetVelocity, Softness, -bound, bound);
            }
            world.Step();
            var expected = reference.Solve();
            active += reference.CountAtBound;
            inside += 5 - reference.CountAtBound;
            var fastest = expected.Max(velocity => velocity.Max(Math.Abs));
            for (int i = 1; i < handles.Count; ++i)
            {
                var velocity = world.Bodies[handles[i]].Velocity;
                double[] found = [.. Numbers(velocity.Linear), .. Numbers(velocity.Angular)];
                for (int k = 0; k < 6; ++k)
                    Assert.True(Math.Abs(found[k] - expected[i][k]) < 1e-3 * fastest, $"seed {seed}, body {i}, {k}: {found[k]:G6}, not {expected[i][k]:G6}");
            }
        }
        output.WriteLine($"{active} at a bound, {inside} within");
        Assert.True(active > 60 && inside > 60);
    }

    static double[] Numbers(Vector3 v) => [v.X, v.Y, v.Z];

    // The velocity of a point along an axis is axis v + (r x axis) w.
    static double[] Along(Vector3 axis, Vector3 arm) => [.. Numbers(axis), .. Numbers(Vector3.Cross(arm, axis))];

    /// <summary>
    /// Six links of 1 kg in hinges with servos, about Z and Y in turn, and 100 kg at the tip. Each servo has to bear a torque that is known.
    /// </summary>
    [Theory]
    [InlineData(1, .01)]
    [InlineData(4, 1e-3)]
    public void A_robot_arm_holds_a_load_a_hundred_times_its_links(int substeps, double most)
    {
        var (gap, turn, torque) = HoldArm(direct with { SubstepCount = substeps });
        var (sweptGap, sweptTurn, sweptTorque) = HoldArm(swept with { SubstepCount = substeps });
        output.WriteLine($"at once: gap {1000 * gap:G3} mm, servos off by {turn:G3} rad, torque by {torque:P3}");
        output.WriteLine($"by sweeps: gap {1000 * sweptGap:G3} mm, servos off by {sweptTurn:G3} rad, torque by {sweptTorque:P3}");
        Assert.InRange(gap, 0, 1e-4);
        // What has bounds gives by 3e-5 of what a sweep does.
        Assert.InRange(turn, 0, most);
        Assert.InRange(torque, 0, 1e-2);
        Assert.True(sweptTurn > 20 * turn && sweptGap > 100 * gap);
    }

    static (double Gap, double Turn, double Torque) HoldArm(AccuracySettings settings)
    {
        using var world = new TestWorld(settings);
        var arm = new RobotArm(world, 100, new SpringSettings(), ServoSettings.Default);
        double gap = 0, turn = 0;
        for (int i = 0; i < 240; ++i)
        {
            world.Step();
            if (i < 120)
                continue;
            gap = Math.Max(gap, arm.Gap());
            turn = Math.Max(turn, arm.Turn());
        }
        return (gap, turn, arm.TorqueError(9.81));
    }

    /// <summary>A servo that is too weak is a torque: a bar that it cannot hold falls as mechanics says, integrated in double precision.</summary>
    [Theory]
    [InlineData(1)]
    [InlineData(4)]
    [InlineData(16)]
    public void A_servo_at_its_greatest_force_is_a_torque(int substeps)
    {
        const float torque = 20;
        using var world = new TestWorld(direct with { SubstepCount = substeps });
        var bar = new Box(1, .1f, .1f);
        var anchor = world.AddKinematic(bar, new RigidPose(Vector3.Zero));
        var body = world.AddDynamic(bar, 10, new RigidPose(new Vector3(.5f, 0, 0)));
        world.Solver.Add(anchor, body, new Hinge { LocalOffsetB = new(-.5f, 0, 0), LocalHingeAxisA = Vector3.UnitZ, LocalHingeAxisB = Vector3.UnitZ });
        world.Solver.Add(anchor, body, new TwistServo
        {
            LocalBasisA = Quaternion.Identity,
            LocalBasisB = Quaternion.Identity,
            ServoSettings = new(float.MaxValue, 0, torque),
        });
        var moment = 10 * (1 + .1 * .1) / 12 + 10 * .25;
        double angle = 0, speed = 0, worst = 0;
        for (int step = 0; step < 30; ++step)
        {
            world.Step();
            const int parts = 1000;
            for (int i = 0; i < parts; ++i)
            {
                // The middle of each part, so that its error is of second order.
                var h = TestWorld.Dt / parts;
                var middle = angle + speed * h / 2;
                speed += h * (torque - 10 * 9.81 * .5 * Math.Cos(middle)) / moment;
                angle = middle + speed * h / 2;
            }
            var pose = world.Bodies[body].Pose;
            worst = Math.Max(worst, Math.Abs(Math.Atan2(pose.Position.Y, pose.Position.X) - angle));
        }
        output.WriteLine($"{worst:G3} rad of {angle:G4}");
        Assert.InRange(-angle, .5, 1.6);
        // Bodies move by their velocity at the end of a substep: they are half a substep ahead.
        Assert.InRange(worst, 0, .6 * Math.Abs(speed) * TestWorld.Dt / substeps);
    }

    /// <summary>Servos that are told where to turn by and by: the tip is where it should be, by the angles alone.</summary>
    [Theory]
    [InlineData(DirectJointsChoice.Always)]
    [InlineData(DirectJointsChoice.WhereNeeded)]
    public void A_robot_arm_goes_where_it_is_told(DirectJointsChoice mode)
    {
        var error = MoveArm(direct with { DirectJoints = mode });
        var bySweeps = MoveArm(swept);
        output.WriteLine($"tip off by {error:G3} m, by sweeps {bySweeps:G3} m");
        // A servo that corrects part p of its error in a substep is (1 / p - 1) substeps late: 11 ms of .7 rad/s in six joints, at up to 3 m.
        Assert.InRange(error, 0, .1);
        Assert.True(bySweeps > 5 * error);
    }

    static double MoveArm(AccuracySettings settings)
    {
        using var world = new TestWorld(settings);
        var arm = new RobotArm(world, 100, new SpringSettings(), ServoSettings.Default);
        double worst = 0;
        for (int step = 1; step <= 240; ++step)
        {
            var time = step * TestWorld.Dt;
            // At first it holds still, so that all that goes over from sweeps has done so.
            var part = .35 * (1 - Math.Cos(2 * Math.Max(0, time - 2)));
            var angles = new double[RobotArm.LinkCount];
            for (int i = 0; i < RobotArm.LinkCount; ++i)
            {
                angles[i] = i % 3 == 0 ? part : -part;
                arm.Aim(i, (float)angles[i]);
            }
            world.Step();
            if (time > 2)
                worst = Math.Max(worst, (world.Bodies[arm.Tip].Pose.Position - RobotArm.TipAt(angles)).Length());
        }
        return worst;
    }

    /// <summary>A body that hangs by a hand, whose arm may bend by .3 rad in each joint and twist by .2, so that limits bear its weight.</summary>
    [Theory]
    [InlineData(DirectJointsChoice.Always)]
    [InlineData(DirectJointsChoice.WhereNeeded)]
    public void A_ragdoll_hangs_by_a_hand_and_its_limits_hold(DirectJointsChoice mode)
    {
        var (gap, limit) = HangRagdoll(direct with { DirectJoints = mode });
        var (sweptGap, sweptLimit) = HangRagdoll(swept);
        output.WriteLine($"gap {1000 * gap:G3} mm, limits overstepped by {limit:G3} rad; by sweeps {1000 * sweptGap:G3} mm, {sweptLimit:G3} rad");
        Assert.InRange(gap, 0, 1e-4);
        // An axis that goes round its cone at 10 rad/s is out of it by .003 rad after each substep. Legs swing for long, so it is the mean that counts.
        Assert.InRange(limit, 0, 2e-3);
        Assert.True(sweptLimit > 20 * limit && sweptGap > 10 * gap);
    }

    static (double Gap, double Limit) HangRagdoll(AccuracySettings settings)
    {
        using var world = new TestWorld(settings);
        var doll = new HungRagdoll(world);
        double gap = 0, limit = 0;
        for (int step = 0; step < 360; ++step)
        {
            world.Step();
            if (step < 240)
                continue;
            gap = Math.Max(gap, doll.Gap());
            limit += doll.Limit() / 120;
        }
        return (gap, limit);
    }

    /// <summary>What has no joint that holds both ways is left to the sweeps; what is too much with its limits is solved at once without them.</summary>
    [Fact]
    public void Bounds_go_with_joints()
    {
        using var world = new TestWorld(direct with { Gravity = default });
        var last = world.AddDynamic(new Sphere(.3f), 1, new RigidPose(Vector3.Zero));
        for (int i = 1; i <= 3; ++i)
        {
            var next = world.AddDynamic(new Sphere(.3f), 1, new RigidPose(new Vector3(i, 0, 0)));
            world.Solver.Add(last, next, new DistanceLimit { MaximumDistance = 1 });
            last = next;
        }
        world.Step();
        Assert.Equal(0, DirectNeedTests.DirectCount(world.Solver));
        var hub = world.AddDynamic(new Sphere(1), 100, new RigidPose(new Vector3(0, 50, 0)));
        for (int i = 0; i < 20; ++i)
        {
            var arm = world.AddDynamic(new Sphere(.2f), 1, new RigidPose(new Vector3(2, 50 + i, 0)));
            world.Solver.Add(hub, arm, new BallSocket { LocalOffsetA = new(1, i, 0), LocalOffsetB = new(-1, 0, 0) });
            world.Solver.Add(hub, arm, new SwingLimit { AxisLocalA = Vector3.UnitX, AxisLocalB = Vector3.UnitX, MaximumSwingAngle = 1 });
            world.Solver.Add(hub, arm, new AngularMotor { Settings = new(1, .1f) });
        }
        world.Step(2);
        Assert.Equal(20, DirectNeedTests.DirectCount(world.Solver));
        world.Simulation.Validate();
    }

    /// <summary>
    /// Parts of a few centimetres that are put together a metre apart: what corrects a joint is limited by their size, whether it has rows about axes or not.
    /// </summary>
    [Theory]
    [InlineData(0)]
    [InlineData(1)]
    [InlineData(2)]
    public void Small_parts_are_not_brought_together_faster_than_their_size_allows(int joint)
    {
        using var world = new TestWorld(direct with { SubstepCount = 1, Gravity = default });
        var box = new Box(.04f, .04f, .04f);
        var a = world.AddDynamic(box, 1, new RigidPose(Vector3.Zero));
        var b = world.AddDynamic(box, 1, new RigidPose(new Vector3(1, 0, 0)));
        var (offsetA, offsetB) = (new Vector3(.03f, 0, 0), new Vector3(-.03f, 0, 0));
        if (joint == 0)
            world.Solver.Add(a, b, new BallSocket { LocalOffsetA = offsetA, LocalOffsetB = offsetB });
        else if (joint == 1)
        {
            var axis = Vector3.UnitZ;
            world.Solver.Add(a, b, new Hinge { LocalOffsetA = offsetA, LocalOffsetB = offsetB, LocalHingeAxisA = axis, LocalHingeAxisB = axis });
        }
        else
            world.Solver.Add(a, b, new Weld { LocalOffset = new(.06f, 0, 0), LocalOrientation = Quaternion.Identity });
        world.Step();
        var speed = (world.Bodies[b].Velocity.Linear - world.Bodies[a].Velocity.Linear).Length();
        // A fifth of its radius of gyration about the joint, 3.4 cm, in a substep; the weld holds one of them at its middle, and the other at an arm of 6 cm.
        Assert.InRange(speed * TestWorld.Dt, .2f * .03f, joint == 2 ? .2f * .065f : .2f * .035f);
    }
}
