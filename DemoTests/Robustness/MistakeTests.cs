using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Robustness;

/// <summary>What Docs/Guides/Mistakes.md says of mistakes that are easily made.</summary>
public class MistakeTests
{
    [Theory]
    [InlineData(1000 / 60f)]
    [InlineData(1000 / 144f)]
    [InlineData(1000 / 500f)]
    [InlineData(1.01f)]
    public void A_time_in_milliseconds_is_refused_and_named(float dt)
    {
        using var world = new TestWorld();
        world.AddDynamic(new Sphere(1), 1, RigidPose.Identity);
        var before = world.Simulation.StateHash();
        foreach (var step in new Action[]
        {
            () => world.Simulation.Timestep(dt), () => world.Simulation.PredictBoundingBoxes(dt),
            () => world.Simulation.CollisionDetection(dt), () => world.Simulation.Solve(dt),
        })
        {
            var error = Assert.Throws<ArgumentOutOfRangeException>(step);
            Assert.Contains("milliseconds", error.Message, StringComparison.Ordinal);
            Assert.Equal(dt, error.ActualValue);
        }
        Assert.Equal(before, world.Simulation.StateHash());
        world.Step(1f);
    }

    [Fact]
    public void An_orientation_that_is_nearly_of_unit_length_is_normalised_before_it_turns_a_normal()
    {
        using var world = new TestWorld();
        var turned = Quaternion.Normalize(new Quaternion(.3f, -.2f, .1f, .9f)) * 1.004f;
        var floor = world.AddStatic(new Box(5, 2, 5), new RigidPose(default, turned));
        var box = world.AddDynamic(new Box(1, 1, 1), 1, new RigidPose(Vector3.Transform(new Vector3(0, 1.5f, 0), Quaternion.Normalize(turned)), turned));
        // Checks that normals are of unit length.
        world.Step();
        world.Simulation.Validate();
        Assert.Equal(1, world.Simulation.NarrowPhase.PairCount);
        AssertIsUnit(world.Simulation.Bodies.GetDescription(box).Pose.Orientation);
        world.Statics.GetDescription(floor, out var ground);
        AssertIsUnit(ground.Pose.Orientation);
        ground.Pose.Orientation = turned;
        world.Statics.ApplyDescription(floor, ground);
        var description = world.Bodies.GetDescription(box);
        description.Pose.Orientation = turned;
        world.Bodies.ApplyDescription(box, description);
        AssertIsUnit(world.Bodies[box].Pose.Orientation);
        world.Step();
        world.Simulation.Validate();
        // The same, where only memory is written.
        world.Bodies[box].Pose.Orientation = turned * .95f;
        world.Step();
        world.Simulation.Validate();
        Assert.True(world.Simulation.Quarantine.Bodies.IsEmpty);

        static void AssertIsUnit(Quaternion q) => Assert.Equal(1, q.Length(), 1e-6f);
    }

    [Fact]
    public void Default_instead_of_new_callbacks_are_refused()
    {
        using var pool = new BufferPool();
        var error = Assert.Throws<InvalidOperationException>(() => Simulation.Create(
            pool, default(DefaultNarrowPhaseCallbacks), new DefaultPoseIntegratorCallbacks(), new SolveDescription(1, 4)));
        Assert.Contains("new DefaultNarrowPhaseCallbacks()", error.Message, StringComparison.Ordinal);
        pool.AssertEmpty();
        error = Assert.Throws<InvalidOperationException>(() => Simulation.Create(
            pool, new DefaultNarrowPhaseCallbacks(), default(DefaultPoseIntegratorCallbacks), new SolveDescription(1, 4)));
        Assert.Contains("new DefaultPoseIntegratorCallbacks()", error.Message, StringComparison.Ordinal);
        pool.AssertEmpty();
    }

    // Nothing is refused of what somebody has said.
    [Fact]
    public void Callbacks_without_gravity_or_friction_may_be_asked_for()
    {
        using var pool = new BufferPool();
        var slippery = new PairMaterialProperties(0, 0, default);
        Simulation.Create(
            pool, new DefaultNarrowPhaseCallbacks(slippery), new DefaultPoseIntegratorCallbacks(Vector3.Zero), new SolveDescription(1, 4)).Dispose();
        var contacts = default(DefaultNarrowPhaseCallbacks);
        contacts.Material = new PairMaterialProperties(1, 2, default);
        var gravity = default(DefaultPoseIntegratorCallbacks);
        gravity.Gravity = new Vector3(0, -1, 0);
        Simulation.Create(pool, contacts, gravity, new SolveDescription(1, 4)).Dispose();
        pool.AssertEmpty();
    }

    [Fact]
    public void An_impulse_does_nothing_to_a_kinematic()
    {
        using var world = new TestWorld();
        var handle = world.AddKinematic(new Box(1, 2, 3), RigidPose.Identity);
        var body = world.Bodies[handle];
        body.Velocity = new BodyVelocity(new Vector3(1, 2, 3), new Vector3(.4f, .5f, .6f));
        body.ApplyImpulse(new Vector3(1e9f), new Vector3(1, 2, 3));
        body.ApplyLinearImpulse(new Vector3(1e9f));
        body.ApplyAngularImpulse(new Vector3(1e9f));
        Assert.Equal(new Vector3(1, 2, 3), body.Velocity.Linear);
        Assert.Equal(new Vector3(.4f, .5f, .6f), body.Velocity.Angular);
    }

    // Both platforms are in the same places at the same times; only the one with a velocity takes its load along.
    [Fact]
    public void A_kinematic_that_is_moved_by_its_pose_slips_away_under_what_lies_on_it()
    {
        const float speed = .5f;
        const int steps = 120;
        foreach (var byPose in new[] { true, false })
        {
            using var world = new TestWorld();
            var platform = world.AddKinematic(new Box(10, 1, 2), new RigidPose(new Vector3(0, -.5f, 0)));
            var box = world.AddDynamic(new Box(1, 1, 1), 1, new RigidPose(new Vector3(0, .5f, 0)));
            world.Step(10);
            if (!byPose)
                world.Bodies[platform].Velocity.Linear.X = speed;
            for (int i = 0; i < steps; ++i)
            {
                if (byPose)
                    world.Bodies[platform].Pose.Position.X += speed * TestWorld.Dt;
                world.Step();
            }
            var way = speed * steps * TestWorld.Dt;
            Assert.Equal(way, world.Bodies[platform].Pose.Position.X, .001f);
            // Friction of .5 brings the box to the speed of the platform within v / (mu g) = .1 s, in which it falls back by 2.5 cm.
            Assert.Equal(byPose ? 0 : way, world.Bodies[box].Pose.Position.X, byPose ? .01f : .04f);
        }
    }

    // The wall has moved by 4.2 m in a step. The box is not hit at 252 m/s, but pushed out at 2 m/s, and by what its four contacts in turn
    // leave of rotation.
    [Fact]
    public void A_kinematic_that_is_put_into_a_body_pushes_it_out_slowly()
    {
        using var world = new TestWorld(new Demos.Accuracy.AccuracySettings { Gravity = default }, material: new PairMaterialProperties(.5f, 2, default));
        var wall = world.AddKinematic(new Box(1, 4, 4), new RigidPose(new Vector3(-5, 0, 0)));
        var box = world.AddDynamic(new Box(1, 1, 1), 1, RigidPose.Identity);
        world.Step();
        world.Bodies[wall].Pose.Position.X = -.8f;
        float fastest = 0;
        for (int i = 0; i < 60; ++i)
        {
            world.Step();
            fastest = MathF.Max(fastest, world.Bodies[box].Velocity.Linear.X);
        }
        Assert.InRange(fastest, .5f, 2.5f);
        Assert.True(world.Bodies[box].Pose.Position.X > .19f);
    }
}
