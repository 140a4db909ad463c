using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using Demos.Accuracy;
using Demos.JointTables;
using Demos.Running;
using DemoTests.Scenes;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.DirectJoints;

/// <summary>All joints of a structure at once: beside equations in double precision, and mechanics.</summary>
public class DirectJointTests(ITestOutputHelper output)
{
    static readonly AccuracySettings direct = new() { DirectJoints = DirectJointsChoice.Always, Contacts = ContactScope.None };

    /// <summary>One substep of random structures, beside dense elimination with pivots.</summary>
    [Theory]
    [InlineData(0)]
    [InlineData(4)]
    [InlineData(8)]
    public void Velocities_are_those_that_solve_all_joints(int loops)
    {
        const float radius = .5f;
        for (int seed = 1; seed <= 20; ++seed)
        {
            var random = new Random(1000 * loops + seed);
            float Next() => 2 * random.NextSingle() - 1;
            Vector3 Direction() => new(Next(), Next(), Next());
            using var world = new TestWorld(direct with { SubstepCount = 1, Gravity = default });
            var reference = new DenseJoints();
            var handles = new List<BodyHandle>();
            for (int i = 0; i < 15; ++i)
            {
                var pose = new RigidPose(3 * Direction(), Quaternion.Normalize(new(Next(), Next(), Next(), 1.5f)));
                var mass = MathF.Exp(3 * Next());
                handles.Add(i == 0 ? world.AddKinematic(new Sphere(radius), pose) : world.AddDynamic(new Sphere(radius), mass, pose));
                var velocity = new BodyVelocity(Direction(), Direction());
                world.Bodies[handles[i]].Velocity = velocity;
                reference.AddBody(
                    i == 0 ? 0 : 1d / mass, i == 0 ? 0 : 2.5 / mass / (radius * radius), [.. Numbers(velocity.Linear), .. Numbers(velocity.Angular)]);
            }
            for (int i = 1; i < 15 + loops; ++i)
            {
                var b = i < 15 ? i : random.Next(1, 15);
                var a = i < 15 ? random.Next(0, i) : (b + random.Next(1, 15)) % 15;
                var socket = new BallSocket { LocalOffsetA = Direction(), LocalOffsetB = Direction() };
                var (poseA, poseB) = (world.Bodies[handles[a]].Pose, world.Bodies[handles[b]].Pose);
                // Loops are closed where bodies happen to be.
                if (i >= 15)
                {
                    var point = poseA.Position + Vector3.Transform(socket.LocalOffsetA, poseA.Orientation);
                    socket.LocalOffsetB = Vector3.Transform(point - poseB.Position, Quaternion.Conjugate(poseB.Orientation));
                }
                var armA = Vector3.Transform(socket.LocalOffsetA, poseA.Orientation);
                var armB = Vector3.Transform(socket.LocalOffsetB, poseB.Orientation);
                if (i < 15)
                {
                    // Almost where it belongs.
                    poseB.Position = poseA.Position + armA - armB + .001f * Direction();
                    world.Bodies[handles[b]].Pose = poseB;
                }
                var gap = poseB.Position + armB - poseA.Position - armA;
                world.Solver.Add(handles[a], handles[b], socket);
                reference.AddSocket(a, b, Numbers(armA), Numbers(armB), Numbers(gap));
            }
            world.Step();
            // A spring of thirty periods per substep, w h = 60 pi: it closes w / (w h + 2) of a gap in a second, and gives by 1 / (w h (w h + 2)).
            var angle = 60 * Math.PI;
            var expected = reference.Solve(angle / (angle + 2) / TestWorld.Dt, loops > 0 ? 1 / (angle * (angle + 2)) : 0);
            var fastest = expected.Max(velocity => velocity.Max(Math.Abs));
            for (int i = 1; i < handles.Count; ++i)
            {
                var velocity = world.Bodies[handles[i]].Velocity;
                double[] found = [.. Numbers(velocity.Linear), .. Numbers(velocity.Angular)];
                for (int k = 0; k < 6; ++k)
                {
                    // Rows of loops may say nearly the same: what the arms are rounded by, 1e-7, counts as much more as they are soft.
                    Assert.True(Math.Abs(found[k] - expected[i][k]) < (loops > 0 ? 2e-3 : 1e-4) * fastest,
                        $"seed {seed}, body {i}, {k}: {found[k]:G6}, not {expected[i][k]:G6}");
                }
            }
        }
    }

    static double[] Numbers(Vector3 v) => [v.X, v.Y, v.Z];

    /// <summary>By sweeps a hundred links with a thousand times their mass at the end are five times as long with four substeps.</summary>
    [Theory]
    [InlineData(1, 1000, ChainStart.HangingKicked, 1e-4)]
    [InlineData(2, 1000, ChainStart.HangingKicked, 1e-4)]
    [InlineData(4, 1000, ChainStart.HangingKicked, 1e-4)]
    [InlineData(4, 1000, ChainStart.HangingStraight, 1e-4)]
    [InlineData(2, 1000, ChainStart.HorizontalZigzag, 1e-3)]
    [InlineData(4, 10_000, ChainStart.HorizontalZigzag, 1e-3)]
    // The free end of a light chain cracks like a whip.
    [InlineData(4, 1, ChainStart.HorizontalStraight, 1e-2)]
    public void A_chain_does_not_stretch(int substeps, float load, ChainStart start, double most)
    {
        using var world = new AccuracyWorld(direct with { SubstepCount = substeps });
        var chain = new LoadedChain(world, start, 100, load);
        double worst = 0, greatest = 0;
        var before = chain.Energy;
        world.Run(5, () =>
        {
            chain.Gaps(out var stretch, ref worst);
            greatest = Math.Max(greatest, stretch);
        });
        output.WriteLine($"stretch {greatest:P5}, gap {1000 * worst:0.000} mm, energy {chain.Energy - before:G3} J");
        Assert.InRange(greatest, 0, most);
        Assert.True(chain.Energy - before < 1e-3 * Math.Abs(before) + 1);
    }

    /// <summary>By sweeps a double pendulum loses more than half of its energy in a minute.</summary>
    [Theory]
    [InlineData("double-pendulum", .05, .5)]
    [InlineData("four-bar", .02, .2)]
    [InlineData("slider-crank", .05, .5)]
    public void Linkages_keep_their_energy_and_their_joints(string name, double energy, double gap)
    {
        var run = LinkageRun.Measure(LinkageLibrary.All.Single(linkage => linkage.Name == name), direct);
        output.WriteLine($"{run}");
        Assert.InRange(run.EnergyLeft, -energy, .01);
        Assert.InRange(run.EnergyGain, 0, .01);
        Assert.InRange(1000 * run.Gap, 0, gap * 10);
    }

    [Fact]
    public void What_floats_keeps_its_momentum()
    {
        using var world = new TestWorld(direct with { Gravity = default });
        var bodies = new List<BodyHandle>();
        var box = new Box(.3f, 1, .2f);
        for (int i = 0; i < 12; ++i)
        {
            bodies.Add(world.AddDynamic(box, 1 + i, new RigidPose(new Vector3(0, 1.2f * i, 0))));
            world.Bodies[bodies[i]].Velocity = new(new Vector3(i % 3, i % 2, -i % 4), new Vector3(1, i % 5, 2));
            if (i > 0)
                world.Solver.Add(bodies[i - 1], bodies[i], new BallSocket { LocalOffsetA = new(0, .6f, 0), LocalOffsetB = new(0, -.6f, 0) });
        }
        var (linear, angular) = Momentum(world, bodies, box);
        world.Step(120);
        var (linearAfter, angularAfter) = Momentum(world, bodies, box);
        Assert.True((linearAfter - linear).Length() < 1e-4f * linear.Length());
        Assert.True((angularAfter - angular).Length() < 2e-3f * angular.Length(), $"{angular} {angularAfter}");
    }

    static (Vector3 Linear, Vector3 Angular) Momentum(TestWorld world, List<BodyHandle> bodies, Box box)
    {
        Vector3 linear = default, angular = default;
        for (int i = 0; i < bodies.Count; ++i)
        {
            var body = world.Bodies[bodies[i]];
            var inverse = box.ComputeInertia(1 + i).InverseInertiaTensor;
            var spin = Vector3.Transform(body.Velocity.Angular, Quaternion.Conjugate(body.Pose.Orientation));
            linear += (1 + i) * body.Velocity.Linear;
            angular += Vector3.Cross(body.Pose.Position, (1 + i) * body.Velocity.Linear) +
                Vector3.Transform(new Vector3(spin.X / inverse.XX, spin.Y / inverse.YY, spin.Z / inverse.ZZ), body.Pose.Orientation);
        }
        return (linear, angular);
    }

    /// <summary>A bar that turns about a point beside its centre; by sweeps it loses 43 % of its energy in ten seconds.</summary>
    [Fact]
    public void An_unbalanced_rotor_keeps_its_speed()
    {
        using var world = new TestWorld(direct with { Gravity = default });
        var left = DirectStructures.TurnRotor(world);
        output.WriteLine($"{left - 1:P2} of its speed");
        Assert.InRange(left, .95f, 1.001f);
    }

    [Fact]
    public void Joints_that_say_the_same_are_as_one()
    {
        Vector3 Last(int copies)
        {
            using var world = new TestWorld(direct);
            var last = world.AddKinematic(new Sphere(.2f), new RigidPose(Vector3.Zero));
            for (int i = 0; i < 10; ++i)
            {
                var next = world.AddDynamic(new Box(1, .2f, .3f), 1, new RigidPose(new Vector3(i + .5f, 0, 0)));
                for (int copy = 0; copy < copies; ++copy)
                    world.Solver.Add(last, next, new BallSocket { LocalOffsetA = new(i == 0 ? 0 : .5f, 0, 0), LocalOffsetB = new(-.5f, 0, 0) });
                last = next;
            }
            world.Step(60);
            return world.Bodies[last].Pose.Position;
        }
        var one = Last(1);
        Assert.True((Last(20) - one).Length() < 1e-3f * one.Length());
    }

    /// <summary>A spring that a game asked for keeps its frequency: only what is rigid is more so.</summary>
    [Fact]
    public void A_spring_keeps_its_frequency()
    {
        const float frequency = 3;
        using var world = new TestWorld(direct with { Gravity = default, SubstepCount = 8 });
        var anchor = world.AddKinematic(new Sphere(.2f), new RigidPose(Vector3.Zero));
        var ball = world.AddDynamic(new Sphere(.2f), 2, new RigidPose(new Vector3(.1f, 0, 0)));
        world.Solver.Add(anchor, ball, new BallSocket { SpringSettings = new(frequency, 0) });
        var crossings = new List<double>();
        var previous = .1f;
        for (int step = 1; step < 240; ++step)
        {
            world.Step();
            var x = world.Bodies[ball].Pose.Position.X;
            if (x < 0 != previous < 0)
                crossings.Add((step - x / (x - previous)) * TestWorld.Dt);
            previous = x;
        }
        var found = (crossings.Count - 1) / (2 * (crossings[^1] - crossings[0]));
        Assert.Equal(frequency, found, .02 * frequency);
    }

    /// <summary>A spring may be so soft that floats know nothing of it: what hangs in it falls, and joints beside it hold.</summary>
    [Fact]
    public void A_spring_that_does_nothing_harms_nothing()
    {
        using var world = new TestWorld(direct);
        var anchor = world.AddKinematic(new Sphere(.2f), new RigidPose(Vector3.Zero));
        var a = world.AddDynamic(new Sphere(.2f), 1, new RigidPose(new Vector3(0, -1, 0)));
        var b = world.AddDynamic(new Sphere(.2f), 1, new RigidPose(new Vector3(0, -2, 0)));
        world.Solver.Add(anchor, a, new BallSocket { LocalOffsetA = new(0, -1, 0), SpringSettings = new(1e-22f, 1e-20f) });
        world.Solver.Add(a, b, new BallSocket { LocalOffsetA = new(0, -1, 0) });
        world.Step(60);
        var (poseA, poseB) = (world.Bodies[a].Pose, world.Bodies[b].Pose);
        Assert.Equal(-9.81f / 2, poseA.Position.Y + 1, .1f);
        Assert.InRange((poseA.Position + Vector3.Transform(new Vector3(0, -1, 0), poseA.Orientation) - poseB.Position).Length(), 0, 1e-3f);
    }

    /// <summary>What cannot turn or move has nothing to solve, and nothing goes wrong.</summary>
    [Fact]
    public void Locked_bodies_and_coincident_anchors_stay_finite()
    {
        using var world = new TestWorld(direct);
        var shape = world.Simulation.Shapes.Add(new Sphere(.3f));
        BodyHandle last = world.AddKinematic(new Sphere(.3f), new RigidPose(Vector3.Zero));
        for (int i = 0; i < 8; ++i)
        {
            var inertia = new BodyInertia { InverseMass = i % 3 == 0 ? 1e-6f : 1 };
            if (i % 2 == 0)
                inertia.InverseInertiaTensor.YY = i % 4 == 0 ? 1e6f : 1;
            var next = world.Bodies.Add(BodyDescription.CreateDynamic(new Vector3(.01f * i, 0, 0), inertia, shape, -1));
            world.Solver.Add(last, next, new Weld { LocalOrientation = Quaternion.Identity });
            world.Solver.Add(last, next, new BallSocket());
            world.Solver.Add(last, next, new DistanceLimit { MaximumDistance = 1 });
            last = next;
        }
        world.Step(120);
        for (int i = 0; i < world.Bodies.ActiveSet.Count; ++i)
        {
            var motion = world.Bodies.ActiveSet.MotionStates[i];
            Assert.True(motion.Pose.Position.Length() < 1 && motion.Velocity.Linear.Length() < 1, $"{motion.Pose.Position} {motion.Velocity.Linear}");
        }
    }

    /// <summary>
    /// Parts that a game puts together a metre apart come together, and are thrown about no worse than by sweeps: without a limit 300 MJ were left of such
    /// a start.
    /// </summary>
    [Theory]
    [InlineData(1)]
    [InlineData(4)]
    public void Parts_that_begin_apart_are_not_thrown(int substeps)
    {
        for (int seed = 0; seed < 10; ++seed)
        {
            var bySweeps = EnergyLeft(direct with { DirectJoints = DirectJointsChoice.Off, SubstepCount = 4, Gravity = default }, seed);
            var atOnce = EnergyLeft(direct with { SubstepCount = substeps, Gravity = default }, seed);
            Assert.InRange(atOnce, 0, 15 * bySweeps);
        }
    }

    static float EnergyLeft(AccuracySettings settings, int seed)
    {
        var random = new Random(seed);
        using var world = new TestWorld(settings);
        var box = new Box(.2f, .8f, .2f);
        var parts = new List<(BodyHandle Handle, float Mass)>();
        for (int i = 0; i < 8; ++i)
        {
            var mass = MathF.Exp(3 * random.NextSingle() - 1.5f);
            parts.Add((world.AddDynamic(box, mass, new RigidPose(new Vector3(0, i, 0) + TestWorld.Scatter(random, 2))), mass));
            if (i > 0)
            {
                var socket = new BallSocket { LocalOffsetA = new(0, .5f, 0), LocalOffsetB = new(0, -.5f, 0) };
                world.Solver.Add(parts[random.Next(i)].Handle, parts[i].Handle, socket);
            }
        }
        world.Step(120);
        return parts.Sum(part => .5f * part.Mass * world.Bodies[part.Handle].Velocity.Linear.LengthSquared());
    }
}
