using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using BepuUtilities.Memory;
using Demos.Accuracy;
using DemoTests.Scenes;
using DemoTests.Support;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Constraints;

/// <summary>Joints that are added between bodies which are not where they belong.</summary>
public class AddedGapTests(ITestOutputHelper output)
{
    static readonly AccuracySettings weightless = new() { Gravity = default, Contacts = ContactScope.None };
    // As in JointGap: the time constant, s, and radii of gyration in a second.
    const double Time = .2;
    const double Speed = 5;

    static TestWorld World(AccuracySettings settings)
    {
        var world = new TestWorld(settings);
        world.Solver.ClosesGapsSlowly = true;
        return world;
    }

    /// <summary>
    /// Two balls, joined at their centres: each goes at five of its radii of gyration in a second, then the gap goes with its time constant. As a critically
    /// damped spring of a substep they would come together at 69 m/s from a metre.
    /// </summary>
    [Theory]
    [InlineData(1, 4, 60, false)]
    [InlineData(1, 1, 60, false)]
    [InlineData(1, 16, 60, true)]
    [InlineData(1, 4, 30, true)]
    [InlineData(1, 4, 240, false)]
    [InlineData(.001f, 4, 60, false)]
    [InlineData(100, 4, 60, true)]
    public void It_closes_as_fast_as_bodies_can_follow(float size, int substeps, int stepsPerSecond, bool isEnabled)
    {
        using var world = World(weightless with { SubstepCount = substeps });
        var ball = new Sphere(.5f * size);
        var a = world.AddDynamic(ball, 1, new RigidPose(Vector3.Zero));
        var b = world.AddDynamic(ball, 1, new RigidPose(new Vector3(3 * size, 0, 0)));
        var joint = world.Solver.Add(a, b, new BallSocket());
        if (isEnabled)
        {
            world.Solver.SetEnabled(joint, false);
            world.Step(1f / stepsPerSecond);
            world.Solver.SetEnabled(joint, true);
        }
        var greatest = 2 * Speed * Math.Sqrt(.4) * .5;
        var slow = (3 - greatest * Time) / greatest;
        for (int step = 1; step <= 3 * stepsPerSecond; ++step)
        {
            world.Step(1f / stepsPerSecond);
            var time = (double)step / stepsPerSecond;
            var expected = time < slow ? 3 - greatest * time : greatest * Time * Math.Exp(-(time - slow) / Time);
            var gap = (world.Bodies[b].Pose.Position - world.Bodies[a].Pose.Position).Length() / size;
            var speed = (world.Bodies[b].Velocity.Linear - world.Bodies[a].Velocity.Linear).Length() / size;
            // What is left as it ends is no gap any more, and goes at once, by short substeps at more than this speed.
            Assert.True(Math.Abs(gap - expected) < .05, $"{gap} at {time} s, not {expected}");
            Assert.InRange(speed, 0, 1.4 * greatest);
        }
        Assert.InRange((world.Bodies[b].Pose.Position - world.Bodies[a].Pose.Position).Length(), 0, 1e-3f * size);
    }

    /// <summary>
    /// Chains that hang or fly, of which one joint after the other is removed and added again a part of a second later. By springs as stiff as a substep can
    /// hold 13 of the 32 gained more than half of what a fall by their whole length is worth, up to hundreds of times it.
    /// </summary>
    [Theory]
    [InlineData(DirectJointsMode.Off)]
    [InlineData(DirectJointsMode.Always)]
    [InlineData(DirectJointsMode.WhereNeeded)]
    public void Ropes_that_are_cut_and_joined_again_are_not_thrown_about(DirectJointsMode mode)
    {
        var gains = Enumerable.Range(0, 32).Select(seed => CutAndJoin(seed, mode)).Order().ToArray();
        output.WriteLine($"{gains.Count(gain => gain > .5)} above .5, {gains.Count(gain => gain > .05)} above .05, at most {gains[^1]}");
        Assert.InRange(gains.Count(gain => gain > .5), 0, 2);
        Assert.InRange(gains[^1], double.MinValue, 2);
    }

    // The greatest energy beyond that of the beginning, as a part of what a fall by the length of the chain is worth.
    static double CutAndJoin(int seed, DirectJointsMode mode)
    {
        using var world = World(new AccuracySettings { Contacts = ContactScope.None });
        world.Solver.DirectJoints = mode;
        var random = new Random(seed);
        float Uniform(float from, float to) => from + random.NextSingle() * (to - from);
        Vector3 Direction() => new(Uniform(-1, 1), Uniform(-1, 1), Uniform(-1, 1));
        var count = random.Next(5, 25);
        var length = Uniform(.2f, 1);
        var box = new Box(length, .3f * length, .3f * length);
        var type = seed % 4;
        var greatestMass = seed / 4 % 2 == 0 ? 1 : 100;
        var velocity = 3 * Direction();
        var bodies = new List<BodyHandle>();
        double mass = 0;
        if (seed / 8 % 2 == 0)
            bodies.Add(world.AddKinematic(box, new RigidPose(new Vector3(-length, 0, 0))));
        var first = bodies.Count;
        for (int i = 0; i < count; ++i)
        {
            var own = MathF.Pow(greatestMass, random.NextSingle());
            mass += own;
            bodies.Add(world.AddDynamic(box, own, new RigidPose(new Vector3(i * length, 0, 0)), new BodyVelocity(velocity + Direction(), Direction())));
        }
        ConstraintHandle Join(int joint) => Add(world.Solver, bodies[joint], bodies[joint + 1], type, length);
        var joints = Enumerable.Range(0, bodies.Count - 1).Select(Join).ToArray();
        double Energy() => bodies.Skip(first).Sum(body => BodyEnergy.Of(world.Bodies[body], 9.81));
        var start = Energy();
        var scale = start + mass * 9.81 * length * count;
        double most = 0;
        for (int cut = 0; cut < 4; ++cut)
        {
            Step(random.Next(10, 70));
            var joint = random.Next(joints.Length);
            world.Solver.Remove(joints[joint]);
            Step(random.Next(3, 60));
            joints[joint] = Join(joint);
        }
        Step(120);
        return most;

        void Step(int steps)
        {
            for (int i = 0; i < steps; ++i)
            {
                world.Step();
                most = Math.Max(most, (Energy() - start) / scale);
                Assert.True(double.IsFinite(most), $"chain {seed}");
            }
        }
    }

    static ConstraintHandle Add(Solver solver, BodyHandle a, BodyHandle b, int type, float length)
    {
        var half = new Vector3(length / 2, 0, 0);
        return type switch
        {
            0 => solver.Add(a, b, new BallSocket { LocalOffsetA = half, LocalOffsetB = -half }),
            1 => solver.Add(a, b, new Hinge { LocalOffsetA = half, LocalOffsetB = -half, LocalHingeAxisA = Vector3.UnitZ, LocalHingeAxisB = Vector3.UnitZ }),
            2 => solver.Add(a, b, new Weld { LocalOffset = 2 * half, LocalOrientation = Quaternion.Identity }),
            _ => solver.Add(a, b, new DistanceLimit(half, -half, 0, .2f * length, default)),
        };
    }

    /// <summary>What opens later is corrected as ever: a ball follows a kinematic body that a game moves by its pose alone.</summary>
    [Fact]
    public void What_a_game_pulls_by_its_pose_comes_along()
    {
        using var world = World(weightless);
        var ball = new Sphere(.1f);
        var hand = world.AddKinematic(ball, new RigidPose(Vector3.Zero));
        var pulled = world.AddDynamic(ball, 1, new RigidPose(Vector3.Zero));
        world.Solver.Add(hand, pulled, new BallSocket());
        world.Step();
        for (int step = 0; step < 60; ++step)
        {
            world.Bodies[hand].Pose.Position.X += .25f;
            world.Step();
        }
        Assert.InRange(world.Bodies[hand].Pose.Position.X - world.Bodies[pulled].Pose.Position.X, 0, .4f);
    }

    /// <summary>The same from the step on in which the joint is added: what it has to follow is no gap that it was added with.</summary>
    [Theory]
    [InlineData(DirectJointsMode.Off, 0)]
    [InlineData(DirectJointsMode.Always, 0)]
    [InlineData(DirectJointsMode.Off, .1f)]
    [InlineData(DirectJointsMode.Always, .1f)]
    public void What_a_game_pulls_at_once_comes_along(DirectJointsMode mode, float gap)
    {
        using var world = World(weightless);
        world.Solver.DirectJoints = mode;
        var ball = new Sphere(.1f);
        var hand = world.AddKinematic(ball, new RigidPose(Vector3.Zero));
        var pulled = world.AddDynamic(ball, 1, new RigidPose(new Vector3(0, gap, 0)));
        world.Solver.Add(hand, pulled, new BallSocket());
        for (int step = 0; step < 60; ++step)
        {
            world.Bodies[hand].Pose.Position.X += .02f;
            world.Step();
        }
        Assert.InRange((world.Bodies[hand].Pose.Position - world.Bodies[pulled].Pose.Position).Length(), 0, .2f);
    }

    /// <summary>Small bodies close a gap more slowly than what counts as rest: they stay awake until it is closed.</summary>
    [Theory]
    [InlineData(DirectJointsMode.Off)]
    [InlineData(DirectJointsMode.Always)]
    public void It_does_not_fall_asleep_with_its_gap(DirectJointsMode mode)
    {
        using var world = World(weightless);
        world.Solver.DirectJoints = mode;
        var ball = new Sphere(.005f);
        var a = world.AddDynamic(ball, 1, new RigidPose(Vector3.Zero));
        var b = world.AddDynamic(ball, 1, new RigidPose(new Vector3(.05f, 0, 0)));
        world.Bodies[a].Activity.SleepThreshold = world.Bodies[b].Activity.SleepThreshold = .01f;
        world.Solver.Add(a, b, new BallSocket());
        world.Step(600);
        Assert.False(world.Bodies[a].Awake);
        Assert.InRange((world.Bodies[b].Pose.Position - world.Bodies[a].Pose.Position).Length(), 0, 1e-4f);
    }

    /// <summary>It bears what it would: a ball that is hung up a metre too low is drawn up, and hangs where one does that was hung up in its place.</summary>
    [Fact]
    public void A_load_is_borne_meanwhile()
    {
        using var world = World(new AccuracySettings { Contacts = ContactScope.None });
        var ball = new Sphere(.25f);
        var hook = world.AddKinematic(ball, new RigidPose(Vector3.Zero));
        BodyHandle Hang(float low)
        {
            var hung = world.AddDynamic(ball, 1, new RigidPose(new Vector3(0, -1 - low, 0)));
            world.Solver.Add(hook, hung, new BallSocket { LocalOffsetB = new(0, 1, 0) });
            return hung;
        }
        var (inPlace, low) = (Hang(0), Hang(1));
        var before = world.Bodies[low].Pose.Position.Y;
        for (int step = 0; step < 240; ++step)
        {
            world.Step();
            var height = world.Bodies[low].Pose.Position.Y;
            Assert.True(height > before - 1e-3f, $"it falls from {before} to {height} in step {step}");
            before = height;
        }
        Assert.Equal(world.Bodies[inPlace].Pose.Position.Y, world.Bodies[low].Pose.Position.Y, 4);
    }

    /// <summary>What a game gave a frequency keeps it: half of the gap is there after 1.68 / w.</summary>
    [Fact]
    public void A_spring_closes_as_fast_as_it_says()
    {
        using var world = World(weightless with { SubstepCount = 16 });
        var ball = new Sphere(.5f);
        var a = world.AddDynamic(ball, 1, new RigidPose(Vector3.Zero));
        var b = world.AddDynamic(ball, 1, new RigidPose(new Vector3(3, 0, 0)));
        world.Solver.Add(a, b, new BallSocket { SpringSettings = new(3, 1) });
        var step = 1.678f / (2 * MathF.PI * 3) / 16;
        for (int i = 0; i < 16; ++i)
            world.Step(step);
        Assert.Equal(1.5f, (world.Bodies[b].Pose.Position - world.Bodies[a].Pose.Position).Length(), .05f);
    }

    /// <summary>A snapshot knows which gaps close.</summary>
    [Theory]
    [InlineData(DirectJointsMode.Off)]
    [InlineData(DirectJointsMode.Always)]
    public void A_snapshot_goes_on_with_it(DirectJointsMode mode)
    {
        using var world = World(weightless);
        using var pool = new BufferPool();
        using var snapshot = new SimulationSnapshot(pool);
        world.Solver.DirectJoints = mode;
        var ball = new Sphere(.5f);
        var a = world.AddDynamic(ball, 1, new RigidPose(Vector3.Zero));
        var b = world.AddDynamic(ball, 2, new RigidPose(new Vector3(3, 0, 0)));
        var c = world.AddDynamic(ball, 3, new RigidPose(new Vector3(3, 4, 0)));
        world.Solver.Add(a, b, new BallSocket());
        world.Solver.Add(b, c, new Hinge { LocalHingeAxisA = Vector3.UnitZ, LocalHingeAxisB = Vector3.UnitX });
        world.Step(10);
        world.Simulation.Save(snapshot);
        var expected = world.HashSteps(40);
        world.Simulation.Restore(snapshot);
        world.Simulation.Validate();
        Assert.Equal(expected, world.HashSteps(40));
    }
}
