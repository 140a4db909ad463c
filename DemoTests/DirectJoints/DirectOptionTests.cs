using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using Demos.Accuracy;
using Demos.Running;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.DirectJoints;

/// <summary>Breaking, disabling and reading of joints that are solved at once: from the first step on, as they bear all of their load.</summary>
public class DirectOptionTests
{
    const float Dt = TestWorld.Dt;
    const float Gravity = 9.81f;
    static readonly Sphere ball = new(.25f);

    static TestWorld World(int substeps = 4) => new(
        new AccuracySettings { Contacts = ContactScope.None, DirectJoints = DirectJointsChoice.Always, SubstepCount = substeps });

    // Balls of 1 kg in a row from a kinematic anchor, each a metre from the one before.
    static ConstraintHandle[] AddChain(TestWorld world, int length, out BodyHandle[] bodies)
    {
        bodies = new BodyHandle[length + 1];
        bodies[0] = world.AddKinematic(ball, new RigidPose(Vector3.Zero));
        var joints = new ConstraintHandle[length];
        for (int i = 0; i < length; ++i)
        {
            bodies[i + 1] = world.AddDynamic(ball, 1, new RigidPose(new Vector3(0, -i - 1, 0)));
            joints[i] = world.Solver.Add(
                bodies[i], bodies[i + 1], new BallSocket { LocalOffsetA = new Vector3(0, -.5f, 0), LocalOffsetB = new Vector3(0, .5f, 0) });
        }
        return joints;
    }

    /// <summary>The first joint of a chain bears the weight of all links, m g dt, in the first step.</summary>
    [Theory, InlineData(1), InlineData(4), InlineData(9)]
    public void It_breaks_above_its_threshold_in_the_first_step(int substeps)
    {
        const int length = 30;
        const float weight = length * Gravity * Dt;
        using var world = World(substeps);
        var joints = AddChain(world, length, out _);
        world.Solver.SetBreakThreshold(joints[0], new(weight * 1.001f));
        world.Step(3);
        Assert.True(world.Solver.BrokenConstraints.IsEmpty);

        using var other = World(substeps);
        joints = AddChain(other, length, out var bodies);
        other.Solver.SetBreakThreshold(joints[0], new(weight * .999f));
        other.Step();
        Assert.Equal(1, other.Solver.BrokenConstraints.Length);
        var broken = other.Solver.BrokenConstraints[0];
        Assert.Equal(joints[0], broken.Handle);
        Assert.Equal(weight, broken.Impulse, weight * 1e-4f);
        Assert.Equal(0, broken.AngularImpulse);
        Assert.False(other.Solver.ConstraintExists(joints[0]));
        other.Simulation.Validate();
        var before = other.Bodies[bodies[^1]].Velocity.Linear;
        other.Step(10);
        other.Simulation.Validate();
        var fallen = other.Bodies[bodies[^1]].Velocity.Linear - before;
        Assert.True((fallen - new Vector3(0, -Gravity * 10 * Dt, 0)).Length() < 1e-3f, $"{fallen}");
    }

    /// <summary>A horizontal arm of 2 m and 1 kg bears m g times 1 m about its root, and its weight.</summary>
    [Theory, InlineData(.999f, false), InlineData(1.001f, true)]
    public void Torque_is_counted_by_itself(float part, bool holds)
    {
        using var world = World();
        var wall = world.AddKinematic(ball, new RigidPose(Vector3.Zero));
        var arm = world.AddDynamic(new Box(2, .5f, .5f), 1, new RigidPose(new Vector3(1, 0, 0)));
        var hinge = world.Solver.Add(wall, arm, new Hinge
        {
            LocalOffsetB = new Vector3(-1, 0, 0),
            LocalHingeAxisA = Vector3.UnitY,
            LocalHingeAxisB = Vector3.UnitY,
        });
        var moment = Gravity * 1 * Dt;
        world.Solver.SetBreakThreshold(hinge, new(float.PositiveInfinity, part * moment));
        world.Step();
        Assert.Equal(holds, world.Solver.ConstraintExists(hinge));
        if (holds)
            return;
        Assert.Equal(moment, world.Solver.BrokenConstraints[0].AngularImpulse, moment * 1e-4f);
        Assert.Equal(Gravity * Dt, world.Solver.BrokenConstraints[0].Impulse, moment * 1e-4f);
    }

    [Fact]
    public void What_is_disabled_is_not_solved_and_comes_back()
    {
        using var world = World();
        var joints = AddChain(world, 5, out var bodies);
        world.Step(10);
        world.Solver.SetEnabled(joints[2], false);
        world.Simulation.Validate();
        Assert.Equal(0, world.Solver.GetAccumulatedImpulseMagnitude(joints[2]));
        var before = world.Bodies[bodies[3]].Velocity.Linear;
        world.Step(10);
        world.Simulation.Validate();
        Assert.Equal(0, world.Solver.GetAccumulatedImpulseMagnitude(joints[2]));
        foreach (var body in bodies[3..])
        {
            var fallen = world.Bodies[body].Velocity.Linear - before;
            Assert.True((fallen - new Vector3(0, -Gravity * 10 * Dt, 0)).Length() < 1e-3f, $"{fallen}");
        }
        Assert.InRange(world.Bodies[bodies[2]].Velocity.Linear.Length(), 0, 1e-4f);
        world.Solver.SetEnabled(joints[2], true);
        world.Step(240);
        world.Simulation.Validate();
        Assert.All(joints, joint => Assert.InRange(world.Solver.GetSeparation(joint).Linear, 0, 1e-3f));
    }

    /// <summary>Of the present poses, as a game has set them and as a step has left them.</summary>
    [Fact]
    public void Separation_is_that_of_the_present_poses()
    {
        using var world = World();
        var joints = AddChain(world, 5, out var bodies);
        world.Step(5);
        world.Bodies[bodies[5]].Pose.Position += new Vector3(.3f, 0, .4f);
        Assert.Equal(.5, world.Solver.GetSeparation(joints[4]).Linear, 1e-4);
        Assert.InRange(world.Solver.GetSeparation(joints[3]).Linear, 0, 1e-4f);
        var greatest = 0f;
        for (int step = 0; step < 120; ++step)
        {
            world.Step();
            for (int i = 0; i < joints.Length; ++i)
            {
                var (a, b) = (world.Bodies[bodies[i]].Pose, world.Bodies[bodies[i + 1]].Pose);
                var gap = a.Position + Vector3.Transform(new Vector3(0, -.5f, 0), a.Orientation) -
                    b.Position - Vector3.Transform(new Vector3(0, .5f, 0), b.Orientation);
                Assert.Equal(gap.Length(), world.Solver.GetSeparation(joints[i]).Linear, 1e-5f);
                greatest = MathF.Max(greatest, gap.Length());
            }
        }
        Assert.True(greatest > .1f, "Closed at once: nothing was read.");
        Assert.InRange(world.Solver.GetSeparation(joints[4]).Linear, 0, 1e-3f);
    }
}
