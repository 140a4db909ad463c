using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Demos.Accuracy;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Robustness;

/// <summary>A body whose numbers go wrong is stopped and reported, and nothing else happens.</summary>
public class QuarantineTests
{
    const int StepsBefore = 4;

    // Bits of the others after each step of a world in which nothing happens, by relaxations: whatever would happen to whom, and when.
    static readonly Lazy<List<byte[]>>[] undisturbed = [new(() => Undisturbed(0)), new(() => Undisturbed(1))];

    static List<byte[]> Undisturbed(int relaxations)
    {
        using var world = new MishapWorld(new Mishap(MishapMoment.Callback, "all"), 1, relaxations);
        var bits = new List<byte[]> { world.OtherBits() };
        for (int i = 0; i < StepsBefore + 12; ++i)
        {
            world.Step();
            bits.Add(world.OtherBits());
        }
        return bits;
    }

    [Theory, MemberData(nameof(Mishap.All), MemberType = typeof(Mishap))]
    public void A_body_that_goes_wrong_is_stopped_before_others_read_it(MishapMoment moment, string harm)
    {
        for (int relaxations = 0; relaxations < 2; ++relaxations)
        {
            ulong hashOfOneThread = 0;
            var clean = undisturbed[relaxations].Value;
            for (int threads = 1; threads < 4; threads += 2)
            {
                var mishap = new Mishap(moment, harm);
                using var world = new MishapWorld(mishap, threads, relaxations);
                world.Step(StepsBefore);
                var steps = StepsBefore;
                var before = world.Simulation.Bodies[world.Culprit].Pose;
                mishap.Armed = true;
                world.Step();
                ++steps;
                mishap.Armed = false;
                if (moment == MishapMoment.StepEnds)
                {
                    // It is too late for this step to find it.
                    Assert.Equal(0, world.Simulation.Quarantine.Count);
                    world.Step();
                    ++steps;
                }
                Assert.True(mishap.Count > 0);
                Assert.Equal([world.Culprit], world.Simulation.Quarantine.Bodies.ToArray());
                world.AssertSound();
                Assert.Equal(clean[steps], world.OtherBits());
                // Two steps of what moves here, no faster than some metres per second.
                Assert.InRange(Vector3.Distance(before.Position, world.Simulation.Bodies[world.Culprit].Pose.Position), 0, .2f);

                world.Step(10);
                Assert.Equal(0, world.Simulation.Quarantine.Count);
                world.AssertSound();
                Assert.Equal(clean[steps + 10], world.OtherBits());
                if (threads == 1)
                    hashOfOneThread = world.Simulation.StateHash();
                else
                    Assert.Equal(hashOfOneThread, world.Simulation.StateHash());
            }
        }
    }

    [Fact]
    public void A_body_that_was_stopped_stays_where_it_rested()
    {
        var mishap = new Mishap(MishapMoment.BetweenSteps, "all");
        using var world = new MishapWorld(mishap, 1);
        world.Step(120);
        var before = world.Simulation.Bodies[world.Culprit].Pose;
        mishap.Armed = true;
        world.Step();
        mishap.Armed = false;
        world.Step(30);
        var after = world.Simulation.Bodies[world.Culprit].Pose;
        Assert.Equal(before.Position.Y, after.Position.Y, .002f);
        Assert.True(MathF.Abs(Quaternion.Dot(before.Orientation, after.Orientation)) > .9999f);
    }

    [Fact]
    public void A_body_that_has_never_been_stepped_goes_back_to_where_it_was_added()
    {
        using var world = new TestWorld(new AccuracySettings { Gravity = default });
        var turned = Quaternion.CreateFromAxisAngle(Vector3.UnitX, 1);
        var body = world.AddDynamic(new Box(1, 2, 3), 1, new RigidPose(new Vector3(7, 8, 9), turned));
        world.Bodies[body].Pose = new RigidPose(new Vector3(float.NaN), default);
        world.Step();
        Assert.Equal([body], world.Simulation.Quarantine.Bodies.ToArray());
        Assert.Equal(new Vector3(7, 8, 9), world.Bodies[body].Pose.Position);
        Assert.Equal(turned, world.Bodies[body].Pose.Orientation);
    }

    // Rows of bodies move when others are removed.
    [Fact]
    public void What_is_known_of_a_body_follows_it_in_memory()
    {
        using var world = new TestWorld(new AccuracySettings { Gravity = default });
        List<BodyHandle> bodies = [];
        for (int i = 0; i < 20; ++i)
            bodies.Add(world.AddDynamic(new Sphere(.5f), 1, new RigidPose(new Vector3(3 * i, 0, 0))));
        world.Step(2);
        for (int i = 0; i < 10; ++i)
            world.Bodies.Remove(bodies[i]);
        for (int i = 10; i < 20; ++i)
            world.Bodies[bodies[i]].Pose.Position = new Vector3(float.NaN);
        world.Step();
        Assert.Equal(bodies[10..], world.Simulation.Quarantine.Bodies.ToArray());
        for (int i = 10; i < 20; ++i)
            Assert.Equal(new Vector3(3 * i, 0, 0), world.Bodies[bodies[i]].Pose.Position);
    }

    [Theory, InlineData(1), InlineData(3)]
    public void An_inertia_that_is_none_makes_a_body_kinematic(int threads)
    {
        using var world = new MishapWorld(new Mishap(MishapMoment.Callback, "all"), threads);
        var clean = undisturbed[0].Value;
        world.Step(StepsBefore);
        world.Simulation.Bodies[world.Culprit].LocalInertia.InverseInertiaTensor.YX = float.NaN;
        world.Step();
        Assert.Equal([world.Culprit], world.Simulation.Quarantine.Bodies.ToArray());
        Assert.True(world.Simulation.Bodies[world.Culprit].Kinematic);
        world.Step(5);
        Assert.Equal(0, world.Simulation.Quarantine.Count);
        world.AssertSound();
        Assert.Equal(clean[StepsBefore + 6], world.OtherBits());
    }

    // A constraint harms all of its bodies at once, and they others in the same sweep: all of those are stopped, and the rest goes on.
    [Theory]
    [InlineData(1, 0)]
    [InlineData(3, 0)]
    [InlineData(1, 1)]
    public void What_a_constraint_ruins_is_stopped_when_the_substep_ends(int threads, int relaxations)
    {
        using var world = new MishapWorld(new Mishap(MishapMoment.Callback, "all"), threads, relaxations);
        var clean = undisturbed[relaxations].Value;
        world.Step(StepsBefore);
        var poison = world.Simulation.Solver.Add(world.Culprit, new Poison { Factor = float.NaN });
        world.Step();
        Assert.Contains(world.Culprit, world.Simulation.Quarantine.Bodies.ToArray());
        foreach (var handle in world.Simulation.Quarantine.Bodies)
            Assert.True(handle == world.Culprit || handle == world.Neighbours.Above || handle == world.Neighbours.Joined, $"{handle}");
        world.Simulation.Solver.Remove(poison);
        world.AssertSound();
        Assert.Equal(clean[StepsBefore + 1], world.OtherBits());
        world.Step(10);
        Assert.Equal(0, world.Simulation.Quarantine.Count);
        world.AssertSound();
        Assert.Equal(clean[StepsBefore + 11], world.OtherBits());
    }

    // Great numbers that are accepted: nothing in the trees may overflow, whatever becomes of the bodies.
    [Theory]
    [InlineData(1 / 60f)]
    [InlineData(1)]
    public void Bodies_at_the_limits_have_bounds(float dt)
    {
        using var world = new TestWorld();
        var random = new Random(5);
        for (int i = 0; i < 100; ++i)
        {
            var body = world.AddDynamic(
                new Box(1, 2, 3), 1, new RigidPose(TestWorld.Scatter(random, i % 2 == 0 ? 1.9e9f : 5), TestWorld.Turn(random)),
                new BodyVelocity(TestWorld.Scatter(random, i % 3 == 0 ? 1.9e7f : 5), TestWorld.Scatter(random, i % 5 == 0 ? 1.9e7f : 5)));
            // What a game may write, but not describe.
            if (i % 7 == 0)
                world.Bodies[body].Velocity.Linear *= 1e12f;
            if (i % 11 == 0)
                world.Bodies[body].Pose.Position *= 1e20f;
        }
        for (int step = 0; step < 10; ++step)
        {
            world.Step(dt);
            world.Simulation.Validate();
            for (int i = 0; i < 100; ++i)
            {
                var bounds = world.Bodies[new(i)].BoundingBox;
                Assert.True(float.IsFinite((bounds.Max - bounds.Min).Length()));
            }
        }
    }

    [Fact]
    public void Stopping_bodies_allocates_nothing()
    {
        var mishap = new Mishap(MishapMoment.LaterSubstepStarts, "angular NaN");
        using var world = new MishapWorld(mishap, 1);
        mishap.Armed = true;
        // The first steps may, as anything that grows; later ones must not.
        int calm = 0;
        for (int steps = 0; steps < 200 && calm < 20; ++steps)
        {
            var before = GC.GetAllocatedBytesForCurrentThread();
            world.Step();
            calm = GC.GetAllocatedBytesForCurrentThread() == before ? calm + 1 : 0;
            Assert.Equal(1, world.Simulation.Quarantine.Count);
        }
        Assert.Equal(20, calm);
    }
}
