using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.Scenes;

/// <summary>Adding, removing and changing things between steps, at random and by name.</summary>
public class ScrambleTests
{
    static readonly SimulationAllocationSizes tiny = new(1, 1, 0, 1, 1, 1, 1);

    [Theory]
    [InlineData(1, 1)]
    [InlineData(2, 1)]
    [InlineData(3, 2)]
    [InlineData(4, 3)]
    public void Nothing_that_is_changed_between_steps_breaks_an_invariant(int seed, int threads)
    {
        using var scramble = new Scramble(seed, threads, seed % 2 == 0 ? tiny : null);
        for (int round = 0; round < 300; ++round)
        {
            scramble.Round();
            scramble.Check();
            if (round == 200)
                scramble.Clear();
        }
    }

    [Fact]
    public void Threads_and_initial_sizes_do_not_change_a_scramble()
    {
        var expected = Hashes(threads: 1, sizes: null);
        Assert.Equal(expected, Hashes(threads: 3, sizes: null));
        Assert.Equal(expected, Hashes(threads: 1, sizes: tiny));
    }

    static List<ulong> Hashes(int threads, SimulationAllocationSizes? sizes)
    {
        using var scramble = new Scramble(seed: 5, threads, sizes);
        var hashes = new List<ulong>();
        for (int round = 0; round < 120; ++round)
        {
            scramble.Round();
            hashes.Add(scramble.Simulation.StateHash());
        }
        return hashes;
    }

    [Fact]
    public void Bodies_in_contact_can_be_removed_in_any_order()
    {
        using var world = new TestWorld();
        AddFloor(world);
        var stack = AddStack(world, 8);
        world.Step(20);
        foreach (int index in (int[])[3, 0, 7, 5, 1, 2, 6, 4])
        {
            world.Bodies.Remove(stack[index]);
            world.Simulation.Validate();
            world.Step(3);
            world.Simulation.Validate();
        }
        Assert.Equal(0, world.Solver.CountConstraints());
        Assert.Equal(0, world.Simulation.NarrowPhase.PairCount);
    }

    [Fact]
    public void Bodies_fall_when_the_static_below_is_removed_and_rest_on_what_replaces_it()
    {
        using var world = new TestWorld();
        var floor = AddFloor(world);
        var stack = AddStack(world, 3);
        world.Step(60);
        world.Statics.Remove(floor);
        world.Simulation.Validate();
        world.Step();
        world.Simulation.Validate();
        AssertFalls(world, stack);
        world.Step(5);
        // The same slot, two metres below.
        Assert.Equal(floor.Slot, world.AddStatic(new Box(20, 2, 20), new RigidPose(new Vector3(0, -3, 0))).Slot);
        world.Step(120);
        world.Simulation.Validate();
        Assert.Equal(-1.5f, world.Bodies[stack[0]].Pose.Position.Y, .02f);
    }

    [Fact]
    public void A_static_that_takes_the_slot_of_a_removed_one_elsewhere_holds_nothing_up()
    {
        using var world = new TestWorld();
        var floor = AddFloor(world);
        var stack = AddStack(world, 3);
        world.Step(60);
        world.Statics.Remove(floor);
        Assert.Equal(floor.Slot, world.AddStatic(new Box(20, 2, 20), new RigidPose(new Vector3(0, -30, 0))).Slot);
        world.Step();
        AssertFalls(world, stack);
        world.Simulation.Validate();
    }

    [Fact]
    public void A_joint_that_got_the_slot_of_a_contact_is_not_removed_with_the_contact_pair()
    {
        using var world = new TestWorld();
        AddFloor(world);
        var a = world.AddDynamic(new Sphere(.5f), 1, new RigidPose(new Vector3(0, .5f, 0)));
        var b = world.AddDynamic(new Sphere(.5f), 1, new RigidPose(new Vector3(5, 10, 0)));
        var c = world.AddDynamic(new Sphere(.5f), 1, new RigidPose(new Vector3(5, 12, 0)));
        world.Step(2);
        var contact = world.Bodies[a].Constraints[0].ConnectingConstraintHandle;
        world.Solver.Remove(contact);
        world.Simulation.Validate();
        var joint = world.Solver.Add(b, c, new BallSocket { LocalOffsetA = Vector3.UnitY, LocalOffsetB = -Vector3.UnitY });
        Assert.Equal(contact.Slot, joint.Slot);
        // The contact comes back under another handle, and goes again.
        world.Step();
        world.Simulation.Validate();
        world.Bodies[a].Pose.Position.Y = 20;
        world.Bodies[a].UpdateBounds();
        world.Step();
        world.Simulation.Validate();
        Assert.True(world.Solver.ConstraintExists(joint));
        world.Bodies.Remove(a);
        world.Simulation.Validate();
        world.Solver.GetDescription<BallSocket>(joint, out var description);
        Assert.Equal(Vector3.UnitY, description.LocalOffsetA);
        world.Solver.Remove(joint);
        world.Simulation.Validate();
    }

    [Fact]
    public void A_body_that_turns_kinematic_and_back_in_contact_keeps_its_neighbours()
    {
        using var world = new TestWorld();
        AddFloor(world);
        var stack = AddStack(world, 4);
        world.Step(30);
        var inertia = world.Bodies[stack[1]].LocalInertia;
        for (int i = 0; i < 4; ++i)
        {
            world.Bodies[stack[1]].BecomeKinematic();
            world.Simulation.Validate();
            world.Bodies[stack[2]].BecomeKinematic();
            world.Simulation.Validate();
            world.Step(2);
            world.Simulation.Validate();
            world.Bodies[stack[2]].SetLocalInertia(inertia);
            world.Bodies[stack[1]].SetLocalInertia(inertia);
            world.Simulation.Validate();
            world.Step(2);
            world.Simulation.Validate();
        }
        world.Step(60);
        for (int i = 0; i < stack.Count; ++i)
            Assert.Equal(i + .5f, world.Bodies[stack[i]].Pose.Position.Y, .02f);
    }

    [Fact]
    public void A_cleared_simulation_does_what_a_new_one_does()
    {
        using var world = new TestWorld(threads: 2);
        List<ulong>? expected = null;
        for (int round = 0; round < 3; ++round)
        {
            AddFloor(world);
            AddStack(world, 6);
            var hashes = world.HashSteps(20);
            expected ??= hashes;
            Assert.Equal(expected, hashes);
            world.Simulation.Clear();
            world.Simulation.Validate();
            Assert.Equal(0, world.Bodies.CountBodies() + world.Statics.Count + world.Solver.CountConstraints());
            world.Step();
        }
    }

    [Fact]
    public void Simulations_share_shapes_and_neither_takes_them_along()
    {
        var pool = new BufferPool();
        var shapes = new Shapes(pool, 4);
        var shape = shapes.Add(new Sphere(.5f));
        using (var staying = new TestWorld(shapes: shapes))
        {
            staying.AddStatic(new Box(20, 2, 20), new RigidPose(new Vector3(0, -1, 0)));
            var kept = staying.AddDynamic(new Box(1, 1, 1), 1, new RigidPose(new Vector3(3, .5f, 0)));
            using (var leaving = new TestWorld(shapes: shapes))
            {
                leaving.AddDynamic(new Capsule(.2f, 1), 1, RigidPose.Identity);
                leaving.Step(2);
                leaving.Simulation.Clear();
                Assert.True(shapes.Exists(shape));
                leaving.AddDynamic(new Sphere(1), 1, RigidPose.Identity);
                leaving.Step(2);
            }
            Assert.True(shapes.Exists(shape));
            staying.Step(30);
            staying.Simulation.Validate();
            Assert.Equal(.5f, staying.Bodies[kept].Pose.Position.Y, .01f);
        }
        Assert.Equal(.5f, shapes.GetShape<Sphere>(shape.Index).Radius);
        shapes.Dispose();
        pool.AssertEmpty();
        pool.Clear();
    }

    [Fact]
    public void Everything_grows_from_the_smallest_sizes()
    {
        using var small = new TestWorld(sizes: tiny);
        using var large = new TestWorld();
        foreach (var world in new[] { small, large })
        {
            for (int i = 0; i < 40; ++i)
                world.AddStatic(new Box(4, 2, 4), new RigidPose(new Vector3(4 * i, -1, 0)));
            for (int i = 0; i < 200; ++i)
                world.AddDynamic(new Sphere(.5f), 1, new RigidPose(new Vector3(i % 40 * 1.05f, .5f + i / 40 * 1.05f, 0)));
            world.Simulation.Validate();
        }
        Assert.Equal(large.HashSteps(30), small.HashSteps(30));
        small.Simulation.Validate();
        Assert.InRange(small.Solver.CountConstraints(), 190, int.MaxValue);
    }

    // Boxes that were pressed together part a little, so it is their mean that falls freely.
    static void AssertFalls(TestWorld world, List<BodyHandle> stack) =>
        Assert.Equal(-9.81f * TestWorld.Dt, stack.Average(body => world.Bodies[body].Velocity.Linear.Y), .002f);

    static StaticHandle AddFloor(TestWorld world) => world.AddStatic(new Box(20, 2, 20), new RigidPose(new Vector3(0, -1, 0)));

    static List<BodyHandle> AddStack(TestWorld world, int height) =>
        [.. Enumerable.Range(0, height).Select(i => world.AddDynamic(new Box(1, 1, 1), 1, new RigidPose(new Vector3(0, i + .5f, 0))))];
}
