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
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.DirectJoints;

/// <summary>What may become of joints that are on their way from the sweeps.</summary>
public class OnTheWayTests(ITestOutputHelper output)
{
    static readonly AccuracySettings alone = new() { Contacts = ContactScope.None };

    /// <summary>Springs have nothing to go over to, and do not keep awake what rests.</summary>
    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void What_hangs_in_springs_sleeps(bool withRigid)
    {
        using var world = new TestWorld(alone);
        var chain = DirectStructures.AddChain(world, default, 3, spring: new SpringSettings(3, 1), downwards: true);
        if (withRigid)
        {
            var last = world.AddDynamic(new Box(.8f, .2f, .3f), 1, new RigidPose(new Vector3(0, -4, 0), world.Bodies[chain[^1]].Pose.Orientation));
            world.Solver.Add(chain[^1], last, new BallSocket { LocalOffsetA = new(.5f, 0, 0), LocalOffsetB = new(-.5f, 0, 0) });
            chain.Add(last);
        }
        world.Step(300);
        world.Solver.DirectJoints = DirectJointsMode.Always;
        MaySleep(world, chain);
        Assert.InRange(StepsUntilAsleep(world, chain[1], 400), 1, 200);
    }

    /// <summary>Joints that cannot all be right never get there. After sixteen seconds they keep nothing awake, which is seen in each 32nd step.</summary>
    [Theory]
    [InlineData(DirectJointsMode.Off, 3)]
    [InlineData(DirectJointsMode.Always, 3)]
    [InlineData(DirectJointsMode.Off, 30)]
    [InlineData(DirectJointsMode.Always, 30)]
    [InlineData(DirectJointsMode.Always, 8)]
    public void What_contradicts_itself_sleeps_in_the_end(DirectJointsMode mode, float distance)
    {
        using var world = new TestWorld(alone);
        var chain = DirectStructures.AddChain(world, default, 3, downwards: true);
        var top = world.AddKinematic(new Box(1, 1, 1), new RigidPose(new Vector3(distance, -3, 0)));
        world.Solver.Add(chain[^1], top, new BallSocket { LocalOffsetA = new(.5f, 0, 0) });
        world.Step(300);
        world.Solver.DirectJoints = mode;
        MaySleep(world, chain);
        var steps = StepsUntilAsleep(world, chain[1], 20000);
        output.WriteLine($"{steps} steps");
        Assert.InRange(steps, 1, 16 * 60 + 32);
    }

    static void MaySleep(TestWorld world, List<BodyHandle> bodies) => bodies.ForEach(body => world.Bodies[body].Activity.SleepThreshold = .01f);

    static int StepsUntilAsleep(TestWorld world, BodyHandle body, int most)
    {
        var steps = 0;
        for (; steps < most && world.Bodies[body].Awake; ++steps)
            world.Step();
        return steps;
    }

    /// <summary>Off and on again between two steps is nothing that has happened.</summary>
    [Theory]
    [InlineData(DirectJointsMode.Always)]
    [InlineData(DirectJointsMode.WhereNeeded)]
    public void Off_and_on_between_two_steps_changes_nothing(DirectJointsMode mode)
    {
        List<ulong> Run(bool blinks)
        {
            using var chain = new HeavyChain(1, crooked: 0);
            var world = chain.World;
            world.Step(30);
            world.Solver.DirectJoints = mode;
            var hashes = new List<ulong>();
            for (int i = 0; i < 60; ++i)
            {
                if (blinks && i % 7 == 3)
                {
                    world.Solver.DirectJoints = DirectJointsMode.Off;
                    world.Simulation.Validate();
                    world.Solver.DirectJoints = mode;
                }
                world.Step();
                world.Simulation.Validate();
                hashes.Add(world.Simulation.StateHash());
            }
            return hashes;
        }
        Assert.Equal(Run(false), Run(true));
    }

    /// <summary>Modes, links, sleep and snapshots at random, on one thread and on three: the same bits, also of what goes on from a snapshot.</summary>
    [Theory]
    [InlineData(1)]
    [InlineData(2)]
    [InlineData(3)]
    [InlineData(4)]
    public void Whatever_happens_on_the_way_is_repeated(int seed)
    {
        var once = Scramble(seed, 1, restores: false);
        output.WriteLine($"{once[^1]:x16}");
        Assert.Equal(once, Scramble(seed, 3, restores: false));
        Assert.Equal(once, Scramble(seed, 1, restores: true));
    }

    static List<ulong> Scramble(int seed, int threads, bool restores)
    {
        var random = new Random(seed);
        using var world = new TestWorld(new AccuracySettings(), threads);
        using var pool = new BufferPool();
        using var snapshot = new SimulationSnapshot(pool);
        world.AddStatic(new Box(200, 1, 200), new RigidPose(new Vector3(0, -14, 0)));
        var chains = Enumerable.Range(0, 30).Select(i => DirectStructures.AddChain(
            world, new Vector3(0, 0, 3 * i), 2 + i % 9, load: MathF.Pow(10, i % 4), spring: i % 7 == 3 ? new SpringSettings(5, 1) : default)).ToList();
        chains.ForEach(chain => MaySleep(world, chain));
        var joints = new List<ConstraintHandle>();
        var hashes = new List<ulong>();
        for (int step = 0; step < 240; ++step)
        {
            var chain = chains[random.Next(chains.Count)];
            var link = random.Next(chain.Count);
            switch (random.Next(16))
            {
                case 0:
                case 1:
                    world.Solver.DirectJoints = (DirectJointsMode)random.Next(3);
                    break;
                case 2 when chain.Count > 2:
                    world.Bodies.Remove(chain[link]);
                    chain.RemoveAt(link);
                    break;
                case 3:
                    var end = world.Bodies[chain[^1]].Pose;
                    chain.Add(world.AddDynamic(new Box(.8f, .2f, .3f), 1, new RigidPose(end.Position + Vector3.UnitX, end.Orientation)));
                    joints.Add(world.Solver.Add(chain[^2], chain[^1], new BallSocket { LocalOffsetA = new(.5f, 0, 0), LocalOffsetB = new(-.5f, 0, 0) }));
                    break;
                case 4:
                case 5:
                    var body = world.Bodies[chain[link]];
                    body.Awake = !body.Awake;
                    break;
                case 6 when joints.Count > 0:
                    var joint = joints[random.Next(joints.Count)];
                    if (world.Solver.ConstraintExists(joint))
                        world.Solver.SetEnabled(joint, !world.Solver.IsEnabled(joint));
                    break;
            }
            if (restores && step % 5 == 2)
            {
                world.Simulation.Save(snapshot);
                var mode = world.Solver.DirectJoints;
                world.Solver.DirectJoints = (DirectJointsMode)(((int)mode + 1 + step % 2) % 3);
                world.Step(1 + step % 3);
                world.Simulation.Restore(snapshot);
            }
            world.Step();
            world.Simulation.Validate();
            hashes.Add(world.Simulation.StateHash());
        }
        return hashes;
    }
}
