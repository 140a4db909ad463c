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

namespace DemoTests.DirectJoints;

/// <summary>Joints that are solved at once, as they come and go.</summary>
public class DirectStateTests
{
    static readonly AccuracySettings direct = new() { DirectJoints = DirectJointsChoice.Always };
    static readonly Box link = new(.8f, .2f, .3f);

    static List<BodyHandle> AddChain(TestWorld world, Vector3 start, int count, bool closed = false)
    {
        var bodies = new List<BodyHandle> { world.AddKinematic(link, new RigidPose(start)) };
        for (int i = 1; i <= count; ++i)
        {
            bodies.Add(world.AddDynamic(link, 1, new RigidPose(start + new Vector3(i, 0, 0))));
            world.Solver.Add(bodies[i - 1], bodies[i], new BallSocket { LocalOffsetA = new(.5f, 0, 0), LocalOffsetB = new(-.5f, 0, 0) });
        }
        if (closed)
            world.Solver.Add(bodies[1], bodies[count], new DistanceServo(default, default, count - 1, new(30, 1), ServoSettings.Default));
        return bodies;
    }

    static float Gap(TestWorld world, List<BodyHandle> chain)
    {
        float greatest = 0;
        for (int i = 1; i < chain.Count; ++i)
        {
            var (a, b) = (world.Bodies[chain[i - 1]].Pose, world.Bodies[chain[i]].Pose);
            var gap = a.Position + Vector3.Transform(new(.5f, 0, 0), a.Orientation) - b.Position - Vector3.Transform(new(-.5f, 0, 0), b.Orientation);
            greatest = MathF.Max(greatest, gap.Length());
        }
        return greatest;
    }

    static void AddCrowd(TestWorld world)
    {
        world.AddStatic(new Box(100, 1, 100), new RigidPose(new Vector3(0, -3, 0)));
        for (int i = 0; i < 12; ++i)
            AddChain(world, new Vector3(i % 3, i, 2 * i), 3 + i, closed: i % 4 == 3);
    }

    [Theory]
    [InlineData(2)]
    [InlineData(3)]
    public void Threads_change_no_bit(int threads)
    {
        List<ulong> Hashes(int count)
        {
            using var world = new TestWorld(direct, count);
            AddCrowd(world);
            return world.HashSteps(60);
        }
        Assert.Equal(Hashes(1), Hashes(threads));
    }

    /// <summary>A structure moves as it does in a world of its own.</summary>
    [Fact]
    public void What_is_elsewhere_changes_no_bit()
    {
        Vector3 Last(bool others)
        {
            using var world = new TestWorld(direct);
            if (others)
                AddChain(world, new Vector3(0, 100, 0), 7);
            var chain = AddChain(world, Vector3.Zero, 9);
            if (others)
                AddChain(world, new Vector3(0, -100, 0), 5);
            world.Step(60);
            return world.Bodies[chain[^1]].Pose.Position;
        }
        Assert.Equal(Last(false), Last(true));
    }

    /// <summary>
    /// Joints of several types lie in memory as those of others before them have come and gone: that says nothing about how a structure moves.
    /// </summary>
    [Theory]
    [InlineData(1)]
    [InlineData(2)]
    [InlineData(3)]
    public void What_has_come_and_gone_changes_no_bit(int seed)
    {
        List<Vector3> Run(int others)
        {
            var random = new Random(seed);
            using var world = new TestWorld(direct with { Contacts = ContactScope.None });
            var there = new List<List<BodyHandle>>();
            void Shuffle(bool steps = false)
            {
                for (int i = 0; i < others; ++i)
                {
                    there.Add(random.Next(3) switch
                    {
                        0 => DirectStructures.AddTree(world, new Vector3(0, 100, 20 * i)),
                        1 => AddChain(world, new Vector3(0, 200, 20 * i), 1 + i, closed: i % 2 == 1),
                        _ => [.. DirectStructures.AddTree(world, new Vector3(0, 300, 20 * i)).Skip(1)],
                    });
                    var gone = there[random.Next(there.Count)];
                    if (random.Next(2) == 0 && there.Remove(gone))
                        gone.ForEach(world.Bodies.Remove);
                    if (steps)
                        world.Step();
                }
            }
            Shuffle(steps: true);
            var tree = DirectStructures.AddTree(world, Vector3.Zero);
            Shuffle();
            var chain = AddChain(world, new Vector3(0, 0, 50), 5, closed: true);
            Shuffle();
            var positions = new List<Vector3>();
            for (int step = 0; step < 60; ++step)
            {
                world.Step();
                if (step % 10 == 5)
                    Shuffle();
                positions.AddRange(tree.Concat(chain).Select(body => world.Bodies[body].Pose.Position));
            }
            return positions;
        }
        Assert.Equal(Run(0), Run(0));
        Assert.Equal(Run(0), Run(6));
    }

    /// <summary>Structures come, break, become kinematic, fall asleep and are removed; what is left holds together.</summary>
    [Fact]
    public void It_follows_what_becomes_of_joints_and_bodies()
    {
        using var world = new TestWorld(direct with { Contacts = ContactScope.None });
        var chain = AddChain(world, Vector3.Zero, 20);
        world.Step(10);
        Assert.InRange(Gap(world, chain), 0, 1e-3f);
        // In the middle: two chains, of which one falls.
        world.Bodies.Remove(chain[10]);
        world.Simulation.Validate();
        world.Step(5);
        Assert.InRange(Gap(world, chain[..10]), 0, 1e-3f);
        Assert.InRange(Gap(world, chain[11..]), 0, 1e-3f);
        world.Bodies[chain[5]].BecomeKinematic();
        world.Bodies[chain[5]].Velocity = default;
        world.Step(5);
        Assert.Equal(default, world.Bodies[chain[5]].Velocity.Linear);
        Assert.InRange(Gap(world, chain[..10]), 0, 1e-3f);
        world.Bodies[chain[5]].SetLocalInertia(link.ComputeInertia(3));
        var more = AddChain(world, new Vector3(0, 5, 0), 6);
        world.Step(20);
        world.Simulation.Validate();
        Assert.InRange(Gap(world, chain[..10]), 0, 1e-3f);
        Assert.InRange(Gap(world, more), 0, 1e-3f);
        world.Simulation.Clear();
        world.Step();
    }

    /// <summary>
    /// From sweeps to all at once and back, in mid-swing: impulses stay, so that nothing jumps. What the sweeps had let open is closed when it has gone over.
    /// </summary>
    [Fact]
    public void The_mode_may_change_at_any_time()
    {
        using var world = new TestWorld(new AccuracySettings { Contacts = ContactScope.None });
        var chain = AddChain(world, Vector3.Zero, 10);
        for (int i = 0; i < 6; ++i)
        {
            world.Solver.DirectJoints = i % 2 == 0 ? DirectJointsMode.Always : DirectJointsMode.Off;
            world.Step(i % 2 == 0 ? 90 : 10);
            world.Simulation.Validate();
            if (i % 2 == 0)
                Assert.InRange(Gap(world, chain), 0, 1e-3f);
        }
        Assert.Throws<ArgumentOutOfRangeException>(() => world.Solver.DirectJoints = (DirectJointsMode)7);
        Assert.Equal(DirectJointsMode.Off, world.Solver.DirectJoints);
    }

    [Fact]
    public void It_sleeps_and_wakes()
    {
        using var world = new TestWorld(direct);
        world.AddStatic(new Box(100, 1, 100), new RigidPose(new Vector3(0, -1, 0)));
        var bodies = new List<BodyHandle>();
        for (int i = 0; i < 6; ++i)
        {
            bodies.Add(world.AddDynamic(link, 1, new RigidPose(new Vector3(i, 0, 0))));
            world.Bodies[bodies[i]].Activity.SleepThreshold = .05f;
            if (i > 0)
                world.Solver.Add(bodies[i - 1], bodies[i], new BallSocket { LocalOffsetA = new(.5f, 0, 0), LocalOffsetB = new(-.5f, 0, 0) });
        }
        for (int i = 0; i < 600 && world.Bodies[bodies[0]].Awake; ++i)
            world.Step();
        Assert.False(world.Bodies[bodies[0]].Awake);
        world.Step(3);
        var first = world.Bodies[bodies[0]];
        first.Awake = true;
        first.ApplyLinearImpulse(new Vector3(0, 5, 0));
        world.Step(20);
        world.Simulation.Validate();
        Assert.InRange(Gap(world, bodies), 0, 2e-3f);
        Assert.True(world.Bodies[bodies[3]].Awake);
    }

    /// <summary>A hub of hundreds, or a large cloth, would take longer than it is worth: they stay as they are without the mode.</summary>
    [Fact]
    public void What_would_take_too_long_is_left_to_sweeps()
    {
        ulong Hash(bool isDirect)
        {
            using var world = new TestWorld(direct with
            {
                DirectJoints = isDirect ? DirectJointsChoice.Always : DirectJointsChoice.Off,
                Contacts = ContactScope.None,
            });
            var hub = world.AddDynamic(new Sphere(1), 100, new RigidPose(Vector3.Zero));
            for (int i = 0; i < 100; ++i)
            {
                var arm = world.AddDynamic(new Sphere(.2f), 1, new RigidPose(new Vector3(2, i, 0)));
                world.Solver.Add(hub, arm, new BallSocket { LocalOffsetA = new(1, i, 0), LocalOffsetB = new(-1, 0, 0) });
            }
            world.Step(20);
            return world.Simulation.StateHash();
        }
        Assert.Equal(Hash(false), Hash(true));
    }

    [Fact]
    public void A_step_allocates_nothing()
    {
        using var world = new TestWorld(direct);
        AddCrowd(world);
        // As long as it goes on falling there may be more contacts than ever before.
        world.Step(240);
        var before = GC.GetAllocatedBytesForCurrentThread();
        world.Step(30);
        Assert.Equal(0, GC.GetAllocatedBytesForCurrentThread() - before);
        var pooled = world.Pool.GetTotalAllocatedByteCount();
        world.Step(30);
        Assert.Equal(pooled, world.Pool.GetTotalAllocatedByteCount());
    }
}
