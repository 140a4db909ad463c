using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using BepuUtilities.Memory;
using Demos.Accuracy;
using Demos.Running;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.DirectJoints;

/// <summary>Who is solved at once where the solver chooses follows from the state of a structure alone, and goes with it wherever it goes.</summary>
public class DirectNeedStateTests
{
    static readonly AccuracySettings needed = new() { DirectJoints = DirectJointsChoice.WhereNeeded };

    // Some are chosen at once, some when they have fallen, some never.
    static List<List<BodyHandle>> AddCrowd(TestWorld world)
    {
        world.AddStatic(new Box(100, 1, 100), new RigidPose(new Vector3(0, -6, 0)));
        var chains = new List<List<BodyHandle>>();
        for (int i = 0; i < 12; ++i)
            chains.Add(DirectStructures.AddChain(world, new Vector3(i % 3, i, 2 * i), 1 + i, load: i % 3 == 0 ? 30 : 1, downwards: i % 2 == 0));
        return chains;
    }

    [Theory]
    [InlineData(2)]
    [InlineData(3)]
    public void Threads_change_no_bit(int threads)
    {
        List<ulong> Hashes(int count)
        {
            using var world = new TestWorld(needed, count);
            AddCrowd(world);
            return world.HashSteps(90);
        }
        Assert.Equal(Hashes(1), Hashes(threads));
    }

    /// <summary>Others are added before or after, are chosen and let go at other times, and are removed meanwhile.</summary>
    [Fact]
    public void What_is_elsewhere_changes_no_bit()
    {
        List<Vector3> Run(int others)
        {
            using var world = new TestWorld(needed with { Contacts = ContactScope.None });
            var before = Enumerable.Range(0, others).Select(i => AddOther(world, i)).ToList();
            var chain = DirectStructures.AddChain(world, Vector3.Zero, 9, load: 5);
            var welded = DirectStructures.AddTree(world, new Vector3(0, 0, 20));
            var after = Enumerable.Range(others, others).Select(i => AddOther(world, i)).ToList();
            var positions = new List<Vector3>();
            for (int step = 0; step < 150; ++step)
            {
                world.Step();
                if (others > 0 && step % 20 == 7)
                {
                    world.Bodies.Remove(before[step / 20 % others][1]);
                    before[step / 20 % others] = AddOther(world, step);
                }
                // The load goes, and with it the need.
                if (step == 60)
                    world.Bodies.Remove(chain[^1]);
                positions.AddRange([world.Bodies[chain[8]].Pose.Position, world.Bodies[welded[^1]].Pose.Position]);
            }
            return positions;
        }
        var alone = Run(0);
        Assert.Equal(alone, Run(1));
        Assert.Equal(alone, Run(3));
    }

    static List<BodyHandle> AddOther(TestWorld world, int i) => i % 2 == 0
        ? DirectStructures.AddChain(world, new Vector3(0, 100 + i, 0), 3 + i % 5, load: i % 3 == 0 ? 50 : 1)
        : DirectStructures.AddTree(world, new Vector3(0, -100 - i, 0));

    static void SetAwake(TestWorld world, BodyHandle body, bool isAwake)
    {
        var reference = world.Bodies[body];
        reference.Awake = isAwake;
    }

    /// <summary>It is solved at once from its first step on, as when it fell asleep, and goes on so for as long as it would have.</summary>
    [Fact]
    public void It_sleeps_and_wakes()
    {
        using var world = new TestWorld(needed with { Contacts = ContactScope.None });
        var chain = DirectStructures.AddChain(world, Vector3.Zero, 6, load: 100, downwards: true);
        world.Step(30);
        Assert.Equal(6, DirectNeedTests.DirectCount(world.Solver));
        SetAwake(world, chain[1], false);
        Assert.False(world.Bodies[chain[1]].Awake);
        world.Step(200);
        world.Simulation.Validate();
        SetAwake(world, chain[3], true);
        world.Step();
        world.Simulation.Validate();
        Assert.Equal(6, DirectNeedTests.DirectCount(world.Solver));
        Assert.InRange(DirectStructures.Gap(world, chain), 0, .01f);
    }

    /// <summary>The game takes the mode off while a structure sleeps: its joints are swept over when it wakes, and hold.</summary>
    [Theory]
    [InlineData(DirectJointsChoice.Always)]
    [InlineData(DirectJointsChoice.WhereNeeded)]
    public void What_sleeps_while_the_mode_is_taken_off_is_swept_over(DirectJointsChoice mode)
    {
        using var world = new TestWorld(needed with { DirectJoints = mode, Contacts = ContactScope.None });
        var chain = DirectStructures.AddChain(world, Vector3.Zero, 3, load: 100, downwards: true);
        var other = world.AddDynamic(new Sphere(1), 1, new RigidPose(new Vector3(50, 0, 0)));
        world.Step(30);
        SetAwake(world, chain[1], false);
        world.Solver.DirectJoints = DirectJointsMode.Off;
        world.Step(5);
        Assert.True(world.Bodies[other].Awake);
        SetAwake(world, chain[1], true);
        world.Step(60);
        Assert.Equal(0, DirectNeedTests.DirectCount(world.Solver));
        Assert.InRange(DirectStructures.Gap(world, chain), 0, .3f);
    }

    /// <summary>Saved in each phase: nothing found yet, found, on the way, let go; and restored into another world as well.</summary>
    [Fact]
    public void A_restored_world_chooses_as_the_saved_one()
    {
        using var pool = new BufferPool();
        using var snapshot = new SimulationSnapshot(pool);
        using var world = new TestWorld(needed);
        var chains = AddCrowd(world);
        for (int round = 0; round < 20; ++round)
        {
            world.Step(round % 7);
            // The loads go.
            if (round == 10)
                chains.ForEach(chain => world.Bodies.Remove(chain[^1]));
            world.Simulation.Save(snapshot);
            var expected = world.HashSteps(12);
            // Another way on: what was chosen is swept over, and numbers are given out.
            world.Solver.DirectJoints = DirectJointsMode.Off;
            world.Step(3);
            world.Solver.DirectJoints = DirectJointsMode.WhereNeeded;
            DirectStructures.AddChain(world, new Vector3(0, 50, 0), 4, load: 100);
            world.Step(12);
            world.Simulation.Restore(snapshot);
            world.Simulation.Validate();
            Assert.Equal(expected, world.HashSteps(12));
            using var other = new TestWorld(needed with { DirectJoints = DirectJointsChoice.Always }, threads: 2);
            // For its shapes.
            AddCrowd(other);
            DirectStructures.AddChain(other, new Vector3(0, 50, 0), 4, load: 100);
            other.Simulation.Restore(snapshot);
            other.Simulation.Validate();
            Assert.Equal(expected, other.HashSteps(12));
            world.Simulation.Restore(snapshot);
        }
    }

    /// <summary>Structures that are chosen break, become kinematic, lose joints for a time and grow; what is left holds together.</summary>
    [Fact]
    public void It_follows_what_becomes_of_joints_and_bodies()
    {
        using var world = new TestWorld(needed with { Contacts = ContactScope.None });
        var chain = DirectStructures.AddChain(world, Vector3.Zero, 20, load: 50);
        world.Step(150);
        Assert.Equal(20, DirectNeedTests.DirectCount(world.Solver));
        Assert.InRange(DirectStructures.Gap(world, chain), 0, 1e-3f);
        // The upper half bears nothing any more but itself.
        world.Bodies.Remove(chain[10]);
        world.Simulation.Validate();
        world.Step(60);
        Assert.InRange(DirectStructures.Gap(world, chain[..10]), 0, 2e-2f);
        world.Bodies[chain[5]].BecomeKinematic();
        world.Bodies[chain[5]].Velocity = default;
        world.Step(5);
        Assert.Equal(default, world.Bodies[chain[5]].Velocity.Linear);
        world.Bodies[chain[5]].SetLocalInertia(new Box(.8f, .2f, .3f).ComputeInertia(100));
        world.Step(30);
        world.Simulation.Validate();
        Assert.InRange(DirectStructures.Gap(world, chain[..10]), 0, 2e-2f);
        var joint = world.Bodies[chain[5]].Constraints[0].ConnectingConstraintHandle;
        world.Solver.SetEnabled(joint, false);
        world.Step(20);
        world.Simulation.Validate();
        world.Solver.SetEnabled(joint, true);
        world.Step(60);
        world.Simulation.Validate();
        Assert.InRange(DirectStructures.Gap(world, chain[..10]), 0, 5e-2f);
        world.Simulation.Clear();
        world.Simulation.Validate();
        world.Step();
        var again = DirectStructures.AddChain(world, Vector3.Zero, 20, load: 50);
        world.Step(150);
        Assert.InRange(DirectStructures.Gap(world, again), 0, 1e-3f);
    }

    /// <summary>A joint that is added to a structure that is solved at once is corrected at once, as in any mode; none of the others notices.</summary>
    [Fact]
    public void A_new_joint_is_not_a_slow_one()
    {
        using var world = new TestWorld(needed with { Contacts = ContactScope.None });
        var chain = DirectStructures.AddChain(world, Vector3.Zero, 5, load: 100, downwards: true);
        world.Step(150);
        var next = world.AddDynamic(new Box(.8f, .2f, .3f), 1, world.Bodies[chain[5]].Pose);
        world.Solver.Add(chain[5], next, new BallSocket { LocalOffsetA = new(.49f, 0, 0), LocalOffsetB = new(.5f, 0, 0) });
        world.Step(2);
        Assert.Equal(6, DirectNeedTests.DirectCount(world.Solver));
        var gap = DirectStructures.Point(world, chain[5], .49f) - DirectStructures.Point(world, next, .5f);
        Assert.InRange(gap.Length(), 0, 1e-4f);
    }

    /// <summary>Always, where needed, off, and back in mid-swing: impulses stay, so nothing jumps; only joints of the one mode are remembered.</summary>
    [Fact]
    public void The_mode_may_change_at_any_time()
    {
        using var world = new TestWorld(needed with { Contacts = ContactScope.None });
        var chain = DirectStructures.AddChain(world, Vector3.Zero, 10, load: 20);
        DirectJointsMode[] modes = [DirectJointsMode.WhereNeeded, DirectJointsMode.Always, DirectJointsMode.WhereNeeded, DirectJointsMode.Off];
        for (int i = 0; i < 12; ++i)
        {
            world.Solver.DirectJoints = modes[i % 4];
            world.Step(10);
            world.Simulation.Validate();
            // From always on nothing is let go before the load is known.
            if (i % 4 is 1 or 2)
                Assert.Equal(10, DirectNeedTests.DirectCount(world.Solver));
        }
    }

    [Fact]
    public void A_step_allocates_nothing()
    {
        using var world = new TestWorld(needed with { Contacts = ContactScope.None });
        AddCrowd(world);
        world.Step(300);
        var before = GC.GetAllocatedBytesForCurrentThread();
        world.Step(60);
        Assert.Equal(0, GC.GetAllocatedBytesForCurrentThread() - before);
        var pooled = world.Pool.GetTotalAllocatedByteCount();
        world.Step(60);
        Assert.Equal(pooled, world.Pool.GetTotalAllocatedByteCount());
    }
}
