using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Handles;

/// <summary>What the values of handles are, and that results depend on slots alone.</summary>
public class HandleGenerationTests
{
    [Fact]
    public void In_a_fresh_world_values_count_from_zero_and_are_slots()
    {
        using var world = new TestWorld();
        for (int i = 0; i < 100; ++i)
        {
            var body = Add(world, i);
            Assert.Equal((i, i), (body.Value, body.Slot));
            var one = world.AddStatic(new Sphere(1), RigidPose.Identity);
            Assert.Equal((i, i), (one.Value, one.Slot));
            var joint = world.Solver.Add(body, new OneBodyLinearServo { ServoSettings = ServoSettings.Default });
            Assert.Equal((i, i), (joint.Value, joint.Slot));
        }
    }

    [Fact]
    public void Plain_handles_are_slots_whoever_had_them_before()
    {
        using var world = new TestWorld();
        Assert.False(world.Simulation.PlainHandles);
        // One that was given up before counts from its slot too.
        world.Bodies.Remove(Add(world, 0));
        world.Simulation.PlainHandles = true;
        for (int i = 0; i < 300; ++i)
        {
            var body = Add(world, 0);
            var one = world.AddStatic(new Sphere(1), RigidPose.Identity);
            Assert.Equal((0, 0), (body.Value, one.Value));
            Assert.Equal(0, world.Bodies[body].CollidableReference.RawHandleValue);
            world.Bodies.Remove(body);
            Assert.False(world.Bodies.BodyExists(body));
            Assert.Throws<ArgumentException>(() => world.Bodies[body].Pose);
            world.Statics.Remove(one);
        }
        world.Simulation.Clear();
        Assert.Equal(0, Add(world, 0).Value);
    }

    // What is remembered of a pair is not that of the one which has its handle now.
    [Fact]
    public void Bodies_that_take_plain_handles_over_begin_anew()
    {
        using var plain = new TestWorld();
        using var counted = new TestWorld();
        plain.Simulation.PlainHandles = true;
        foreach (var world in new[] { plain, counted })
        {
            Floor(world);
            for (int i = 0; i < 40; ++i)
                Add(world, i);
            var random = new Random(5);
            for (int step = 0; step < 120; ++step)
            {
                for (int i = 0; i < 2; ++i)
                {
                    Assert.True(world.Bodies.TryGetHandle(random.Next(40), out var gone));
                    world.Bodies.Remove(gone);
                    Assert.Equal(gone.Slot, Add(world, random.Next(40)).Slot);
                }
                world.Step();
                world.Simulation.Validate();
            }
        }
        Assert.Equal(counted.HashSteps(20), plain.HashSteps(20));
    }

    [Fact]
    public void A_slot_is_given_out_again_under_another_value_and_is_found_by_it()
    {
        using var world = new TestWorld();
        var first = Add(world, 0);
        Add(world, 1);
        var seen = new HashSet<int> { first.Value };
        var last = first;
        // As often as documented: the 256th heir has the first one's name.
        for (int i = 0; i < 255; ++i)
        {
            world.Bodies.Remove(last);
            last = Add(world, 0);
            Assert.Equal(first.Slot, last.Slot);
            Assert.True(seen.Add(last.Value), $"value {last.Value} occurs twice");
            Assert.True(last.Value > 0);
            Assert.False(world.Bodies.BodyExists(first));
            Assert.True(world.Bodies.TryGetHandle(first.Slot, out var found));
            Assert.Equal(last, found);
            Assert.Equal(last, new CollidableReference(CollidableMobility.Kinematic, last).BodyHandle);
            Assert.Equal(first.Slot, world.Bodies[last].CollidableReference.Slot);
        }
        world.Bodies.Remove(last);
        Assert.False(world.Bodies.TryGetHandle(first.Slot, out _));
        Assert.Equal(first, Add(world, 0));
        Assert.False(world.Bodies.TryGetHandle(-1, out _));
        Assert.False(world.Bodies.TryGetHandle(int.MaxValue, out _));
    }

    [Fact]
    public void Clear_begins_with_slot_zero_again_and_with_other_names()
    {
        using var world = new TestWorld();
        var seen = new HashSet<int>();
        for (int round = 0; round < 10; ++round)
        {
            for (int i = 0; i < 5; ++i)
            {
                var handle = Add(world, i);
                Assert.Equal(i, handle.Slot);
                Assert.True(seen.Add(handle.Value));
                Assert.Equal(i, world.AddStatic(new Sphere(1), RigidPose.Identity).Slot);
            }
            world.Step(2);
            world.Simulation.Clear();
            world.Simulation.Validate();
        }
    }

    [Fact]
    public void Messages_tell_what_was_removed_from_what_never_was()
    {
        using var world = new TestWorld();
        var handle = Add(world, 0);
        world.Bodies.Remove(handle);
        Assert.Contains("removed", Assert.Throws<ArgumentException>(() => world.Bodies[handle]).Message);
        var heir = Add(world, 0);
        Assert.Contains("removed", Assert.Throws<ArgumentException>(() => world.Bodies[handle]).Message);
        Assert.DoesNotContain("removed", Assert.Throws<ArgumentException>(() => world.Bodies[new(700)]).Message);
        Assert.Equal("body 0", handle.ToString());
        Assert.Equal("body 0 (number 2 of its slot)", heir.ToString());
        Assert.Equal("Dynamic body 0 (number 2 of its slot)", world.Bodies[heir].CollidableReference.ToString());
    }

    /// <summary>A pile of bodies, each of which had a different number of predecessors, falls as one without any.</summary>
    [Theory]
    [InlineData(1, 1)]
    [InlineData(2, 3)]
    [InlineData(3, 2)]
    public void Predecessors_do_not_change_results(int seed, int threads)
    {
        const int count = 60;
        const int stepCount = 80;
        using var fresh = new TestWorld(threads: threads);
        using var used = new TestWorld(threads: threads);
        var random = new Random(seed);
        Floor(fresh);
        Floor(used);
        for (int i = 0; i < count; ++i)
        {
            Add(fresh, i);
            Add(used, i);
        }
        var handles = new Stack<BodyHandle>(count);
        for (int i = 0; i < count; ++i)
            handles.Push(new BodyHandle(i));
        for (int round = 0; round < 300; ++round)
        {
            int kept = random.Next(count);
            while (handles.Count > kept)
                used.Bodies.Remove(handles.Pop());
            for (int i = kept; i < count; ++i)
                handles.Push(Add(used, i));
        }
        var generations = new HashSet<int>();
        foreach (var handle in handles)
            generations.Add(handle.Value >> 22);
        Assert.True(generations.Count > count / 2);
        Assert.Equal(fresh.HashSteps(stepCount), used.HashSteps(stepCount));
        Assert.True(fresh.Simulation.NarrowPhase.PairCount > count / 2, "the bodies are to touch each other");
        used.Simulation.Validate();
    }

    [Fact]
    public void More_bodies_than_there_are_slots_are_refused()
    {
        using var world = new TestWorld();
        Add(world, 0);
        while (world.Bodies.HandlePool.HighestPossiblyClaimedId < BepuPhysics.Bodies.MaximumCount - 1)
            world.Bodies.HandlePool.Take();
        var shape = world.Bodies[new(0)].Collidable.Shape;
        var description = BodyDescription.CreateKinematic(RigidPose.Identity, shape, new BodyActivityDescription(-1));
        Assert.Contains("4194304", Assert.Throws<InvalidOperationException>(() => world.Bodies.Add(description)).Message);
        Assert.Equal(1, world.Bodies.CountBodies());
        Assert.Equal(1, world.Simulation.BroadPhase.ActiveTree.LeafCount);
        world.Step(2);

        while (world.Statics.HandlePool.HighestPossiblyClaimedId < BepuPhysics.Statics.MaximumCount - 1)
            world.Statics.HandlePool.Take();
        Assert.Throws<InvalidOperationException>(() => world.Statics.Add(new StaticDescription(RigidPose.Identity, shape)));
        Assert.Equal(0, world.Statics.Count);

        while (world.Solver.HandlePool.HighestPossiblyClaimedId < Solver.MaximumCount - 1)
            world.Solver.HandlePool.Take();
        Assert.Throws<InvalidOperationException>(
            () => world.Solver.Add(new BodyHandle(0), new OneBodyLinearServo { ServoSettings = ServoSettings.Default }));
        Assert.Equal(0, world.Solver.CountConstraints());
        Assert.Equal(0, world.Bodies[new(0)].Constraints.Count);
    }

    [Fact]
    public void Impossible_capacities_are_refused_and_change_nothing()
    {
        using var world = new TestWorld();
        var before = world.Pool.GetTotalAllocatedByteCount();
        foreach (int capacity in new[] { -1, int.MinValue, BepuPhysics.Bodies.MaximumCount + 1, int.MaxValue })
        {
            Assert.Throws<ArgumentOutOfRangeException>(() => world.Bodies.EnsureCapacity(capacity));
            Assert.Throws<ArgumentOutOfRangeException>(() => world.Statics.EnsureCapacity(capacity));
        }
        foreach (int capacity in new[] { -1, int.MinValue, int.MaxValue })
        {
            Assert.Throws<ArgumentOutOfRangeException>(() => world.Bodies.MinimumConstraintCapacityPerBody = capacity);
            Assert.Throws<ArgumentOutOfRangeException>(() => world.Simulation.EnsureCapacity(new(capacity, 1, 1, 1, 1, 1, 1)));
            Assert.Throws<ArgumentOutOfRangeException>(() => world.Simulation.EnsureCapacity(new(1, capacity, 1, 1, 1, 1, 1)));
            Assert.Throws<ArgumentOutOfRangeException>(() => world.Simulation.EnsureCapacity(new(1, 1, 1, 1, capacity, 1, 1)));
        }
        Assert.Equal(before, world.Pool.GetTotalAllocatedByteCount());
        world.Bodies.MinimumConstraintCapacityPerBody = 0;
        Add(world, 0);
        world.Step(2);
    }

    static void Floor(TestWorld world) => world.AddStatic(new Box(40, 2, 40), new RigidPose(new Vector3(0, -1, 0)));

    static BodyHandle Add(TestWorld world, int i)
    {
        var pose = new RigidPose(new Vector3(i % 3 * .9f + i * .01f, 1 + i / 9 * 1.1f, i / 3 % 3 * .9f));
        return i % 2 == 0 ? world.AddDynamic(new Box(1, 1, 1), 1, pose) : world.AddDynamic(new Sphere(.5f), 1, pose);
    }
}
