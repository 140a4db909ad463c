using System;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using Demos.Accuracy;
using DemoTests.Scenes;
using DemoTests.Support;
using Xunit;

namespace DemoTests.Constraints;

/// <summary>
/// What can be said of single constraints: that they are disabled, that they break, that their bodies do not collide; and how far they are off.
/// </summary>
public class ConstraintOptionTests
{
    const float Dt = TestWorld.Dt;
    const float Gravity = 9.81f;
    static readonly Sphere ball = new(0.25f);

    static TestWorld World(bool collides = false, int threads = 1) =>
        new(new AccuracySettings { Contacts = collides ? ContactScope.All : ContactScope.None }, threads);

    // Balls in a row from a kinematic anchor, each a metre from the one before.
    static ConstraintHandle[] AddChain(TestWorld world, int length, out BodyHandle[] bodies, float z = 0)
    {
        bodies = new BodyHandle[length + 1];
        bodies[0] = world.AddKinematic(ball, new RigidPose(new Vector3(0, 0, z)));
        var joints = new ConstraintHandle[length];
        for (int i = 0; i < length; ++i)
        {
            bodies[i + 1] = world.AddDynamic(ball, 1, new RigidPose(new Vector3(0, -i - 1, z)));
            joints[i] = world.Solver.Add(
                bodies[i], bodies[i + 1], new BallSocket { LocalOffsetA = new Vector3(0, -0.5f, 0), LocalOffsetB = new Vector3(0, 0.5f, 0) });
        }
        return joints;
    }

    [Fact]
    public void What_is_disabled_is_not_solved_and_keeps_what_was_said_of_it()
    {
        using var world = World();
        var joints = AddChain(world, 5, out var bodies);
        world.Step(60);
        var joint = joints[^1];
        world.Solver.SetEnabled(joint, false);
        world.Simulation.Validate();
        Assert.False(world.Solver.IsEnabled(joint));
        Assert.Equal(0, world.Solver.GetAccumulatedImpulseMagnitude(joint));
        Assert.Equal(5, world.Solver.CountConstraints());
        var before = world.Bodies[bodies[^1]].Velocity.Linear;
        world.Step(10);
        var fallen = world.Bodies[bodies[^1]].Velocity.Linear - before;
        Assert.True((fallen - new Vector3(0, -Gravity * 10 * Dt, 0)).Length() < 1e-3f, $"{fallen}");

        world.Solver.ApplyDescription(joint, new BallSocket { LocalOffsetA = new Vector3(0, -1, 0), LocalOffsetB = new Vector3(0, 1, 0) });
        world.Solver.GetConstraintReference(joint).Enabled = true;
        world.Simulation.Validate();
        Assert.True(world.Solver.GetConstraintReference(joint).Enabled);
        world.Solver.GetDescription<BallSocket>(joint, out var description);
        Assert.Equal(-1, description.LocalOffsetA.Y);
        world.Step(600);
        var apart = world.Bodies[bodies[^1]].Pose.Position - world.Bodies[bodies[^2]].Pose.Position;
        Assert.InRange(apart.Length(), 1.5f, 2.1f);
    }

    [Fact]
    public void Bodies_of_a_disabled_constraint_can_change_and_go()
    {
        using var world = World();
        var joints = AddChain(world, 5, out var bodies);
        foreach (var joint in joints)
            world.Solver.SetEnabled(joint, false);
        world.Simulation.Validate();
        world.Step();
        world.Bodies[bodies[^1]].BecomeKinematic();
        world.Simulation.Validate();
        Assert.False(world.Solver.IsEnabled(joints[^1]));
        world.Bodies.Remove(bodies[2]);
        world.Simulation.Validate();
        Assert.False(world.Solver.ConstraintExists(joints[1]));
        Assert.False(world.Solver.ConstraintExists(joints[2]));
        world.Solver.Remove(joints[0]);
        world.Step();
        // Kinematic bodies at both ends leave nothing to hold.
        world.Bodies[bodies[^2]].BecomeKinematic();
        world.Simulation.Validate();
        Assert.False(world.Solver.ConstraintExists(joints[4]));
        Assert.False(world.Solver.IsEnabled(joints[3]));
        Assert.Equal(1, world.Solver.CountConstraints());
    }

    [Fact]
    public void Disabled_constraints_make_no_hub_and_come_back_as_one()
    {
        using var world = World();
        var hub = world.AddDynamic(ball, 1, new RigidPose(Vector3.Zero));
        var joints = new ConstraintHandle[10];
        for (int i = 0; i < joints.Length; ++i)
        {
            var arm = world.AddDynamic(ball, 1, new RigidPose(new Vector3(i + 1, 0, 0)));
            joints[i] = world.Solver.Add(hub, arm, new BallSocket { LocalOffsetA = new Vector3(i, 0, 0), LocalOffsetB = new Vector3(-1, 0, 0) });
        }
        foreach (var joint in joints)
        {
            world.Solver.SetEnabled(joint, false);
            world.Simulation.Validate();
        }
        world.Step();
        foreach (var joint in joints)
        {
            world.Solver.SetEnabled(joint, true);
            world.Simulation.Validate();
        }
        world.Step();
        world.Solver.SetEnabled(joints[3], false);
        world.Solver.Remove(joints[3]);
        world.Bodies.Remove(hub);
        world.Simulation.Validate();
        Assert.Equal(0, world.Solver.CountConstraints());
    }

    [Fact]
    public void Disabled_and_enabled_at_once_changes_nothing()
    {
        using var world = World();
        using var other = World();
        var joints = AddChain(world, 5, out _);
        AddChain(other, 5, out _);
        foreach (var joint in joints)
            world.Solver.SetEnabled(joint, false);
        foreach (var joint in joints)
            world.Solver.SetEnabled(joint, true);
        Assert.Equal(other.HashSteps(20), world.HashSteps(20));
    }

    /// <summary>Each weighs as much as hangs below it: m g dt per step, whatever the substeps.</summary>
    [Theory, InlineData(1), InlineData(4), InlineData(9)]
    public void A_constraint_breaks_above_its_threshold_and_not_below(int substeps)
    {
        using var world = new TestWorld(new AccuracySettings { Contacts = ContactScope.None, SubstepCount = substeps, VelocityIterationCount = 8 });
        var joints = AddChain(world, 3, out var bodies);
        world.Step(200);
        var weight = 3 * Gravity * Dt;
        world.Solver.SetBreakThreshold(joints[0], new(weight * 1.02f));
        world.Step(60);
        Assert.True(world.Solver.BrokenConstraints.IsEmpty);
        Assert.Equal(weight * 1.02f, world.Solver.GetBreakThreshold(joints[0]).Impulse);

        world.Solver.SetBreakThreshold(joints[0], new(weight * 0.98f));
        world.Step();
        Assert.Equal(1, world.Solver.BrokenConstraints.Length);
        var broken = world.Solver.BrokenConstraints[0];
        Assert.Equal(joints[0], broken.Handle);
        Assert.Equal(BallSocket.ConstraintTypeId, broken.TypeId);
        Assert.Equal((bodies[0], bodies[1], 2), (broken.GetBody(0), broken.GetBody(1), broken.BodyCount));
        Assert.Equal(weight, broken.Impulse, weight * 0.01f);
        Assert.Equal(0, broken.AngularImpulse);
        Assert.False(world.Solver.ConstraintExists(joints[0]));
        world.Simulation.Validate();
        world.Step();
        Assert.True(world.Solver.BrokenConstraints.IsEmpty);
    }

    /// <summary>A horizontal arm of 2 m bears m g times 1 m about its root, and its weight along the vertical.</summary>
    [Fact]
    public void Torque_is_counted_by_itself()
    {
        using var world = new TestWorld(new AccuracySettings { Contacts = ContactScope.None, VelocityIterationCount = 8 });
        var wall = world.AddKinematic(ball, new RigidPose(Vector3.Zero));
        var arm = world.AddDynamic(new Box(2, 0.5f, 0.5f), 1, new RigidPose(new Vector3(1, 0, 0)));
        // About the vertical axis it turns freely; the moment of the load, about z, is borne by one of the rows about axes.
        var hinge = world.Solver.Add(wall, arm, new Hinge
        {
            LocalOffsetA = Vector3.Zero,
            LocalOffsetB = new Vector3(-1, 0, 0),
            LocalHingeAxisA = Vector3.UnitY,
            LocalHingeAxisB = Vector3.UnitY,
        });
        world.Step(200);
        var moment = Gravity * 1 * Dt;
        world.Solver.SetBreakThreshold(hinge, new(float.PositiveInfinity, moment * 1.05f));
        world.Step(10);
        Assert.True(world.Solver.ConstraintExists(hinge));
        world.Solver.SetBreakThreshold(hinge, new(float.PositiveInfinity, moment * 0.95f));
        world.Step();
        Assert.False(world.Solver.ConstraintExists(hinge));
        Assert.Equal(moment, world.Solver.BrokenConstraints[0].AngularImpulse, moment * 0.05f);
        Assert.Equal(moment, world.Solver.BrokenConstraints[0].Impulse, moment * 0.05f);
    }

    [Theory, InlineData(0), InlineData(1)]
    public void What_breaks_does_not_depend_on_threads(int relaxations)
    {
        var one = Break(1, relaxations);
        Assert.True(one.Count(step => step.Length > 0) > 3, "Too little breaks to tell.");
        Assert.Contains(one, step => step.Length > 1);
        Assert.All(one, step => Assert.Equal(step.OrderBy(broken => broken.Slot), step));
        Assert.Equal(one, Break(3, relaxations));
    }

    static (int Slot, float Impulse)[][] Break(int threads, int relaxations)
    {
        using var world = new TestWorld(
            new AccuracySettings { Contacts = ContactScope.None, RelaxationCount = relaxations }, threads);
        const int chainCount = 60;
        var chains = new ConstraintHandle[chainCount][];
        for (int chain = 0; chain < chainCount; ++chain)
            chains[chain] = AddChain(world, 10, out _, chain);
        var steps = new (int, float)[40][];
        for (int step = 0; step < steps.Length; ++step)
        {
            for (int chain = step; chain < chainCount && step < 20; chain += 20)
            {
                // From the last to the first, so that the order of the list is not that of the slots.
                for (int i = 9; i >= 0; --i)
                    world.Solver.SetBreakThreshold(chains[chain][i], new((10 - i) * Gravity * Dt * (0.5f + 0.08f * ((chain * 7 + i * 3) % 11))));
            }
            world.Step();
            steps[step] = [.. world.Solver.BrokenConstraints.ToArray().Select(broken => (broken.Handle.Slot, broken.Impulse))];
        }
        world.Simulation.Validate();
        return steps;
    }

    [Fact]
    public void A_removed_constraint_breaks_no_more_and_its_slot_starts_anew()
    {
        using var world = World();
        var joints = AddChain(world, 3, out var bodies);
        foreach (var joint in joints)
            world.Solver.SetBreakThreshold(joint, new(1e-6f));
        world.Solver.SetCollideConnected(joints[0], false);
        world.Solver.Remove(joints[0]);
        world.Simulation.Validate();
        var again = world.Solver.Add(bodies[0], bodies[1], new BallSocket());
        Assert.Equal(joints[0].Slot, again.Slot);
        Assert.Equal(float.PositiveInfinity, world.Solver.GetBreakThreshold(again).Impulse);
        Assert.True(world.Solver.GetCollideConnected(again));
        world.Solver.SetBreakThreshold(joints[1], BreakThreshold.Unbreakable);
        world.Solver.SetEnabled(joints[2], false);
        world.Step();
        Assert.True(world.Solver.BrokenConstraints.IsEmpty);
        world.Simulation.Clear();
        world.Simulation.Validate();
        Assert.True(world.Solver.BrokenConstraints.IsEmpty);
    }

    [Fact]
    public void Separation_is_that_of_the_present_poses()
    {
        using var world = World();
        var a = world.AddKinematic(ball, new RigidPose(new Vector3(1, 2, 3)));
        var turn = Quaternion.CreateFromAxisAngle(Vector3.UnitX, 0.2f);
        var b = world.AddDynamic(ball, 1, new RigidPose(new Vector3(1.3f, 2, 3.4f), turn));
        var weld = world.Solver.Add(a, b, new Weld { LocalOrientation = Quaternion.Identity });
        var limit = world.Solver.Add(a, b, new DistanceLimit(default, default, 0.1f, 0.2f, default));
        var slack = world.Solver.Add(a, b, new DistanceLimit(default, default, 0.1f, 2, default));
        var angular = world.Solver.Add(a, b, new AngularHinge { LocalHingeAxisA = Vector3.UnitY, LocalHingeAxisB = Vector3.UnitY });
        var motor = world.Solver.Add(a, b, new AngularMotor { Settings = new(1, 0) });
        Check(weld, 0.5, 0.2);
        Check(limit, 0.3, 0);
        Check(slack, 0, 0);
        Check(angular, 0, 0.2);
        Check(motor, 0, 0);
        world.Bodies[b].Pose.Position = new Vector3(1, 2, 3);
        Check(weld, 0, 0.2);
        Check(limit, 0.1, 0);
        world.Solver.SetEnabled(weld, false);
        Check(weld, 0, 0.2);

        void Check(ConstraintHandle handle, double linear, double angle)
        {
            var separation = world.Solver.GetSeparation(handle);
            Assert.Equal(linear, separation.Linear, 1e-5);
            Assert.Equal(angle, separation.Angular, 1e-5);
        }
    }

    /// <summary>A row is about an axis if and only if no body's velocity along a direction changes it.</summary>
    [Fact]
    public void Types_know_which_of_their_rows_are_linear()
    {
        var samples = new JointSamples(5);
        foreach (var type in JointTypes.All)
        {
            using var bench = RowBench.New(type.Id, samples);
            var rows = bench.Rows(new Substep(0, Dt));
            for (int i = 0; i < rows.Length; ++i)
            {
                var isLinear = rows[i].A.Linear.Length() + rows[i].B.Linear.Length() > 1e-6f;
                Assert.True(isLinear == bench.Processor.IsLinear(i), $"{type.Name}, row {i}");
            }
        }
    }

    [Fact]
    public void Connected_bodies_collide_unless_they_are_told_not_to()
    {
        using var world = World(collides: true);
        // Two balls inside of each other, held at their centres by a rope that is long enough.
        var a = world.AddDynamic(ball, 1, new RigidPose(Vector3.Zero));
        var b = world.AddDynamic(ball, 1, new RigidPose(new Vector3(0.4f, 0, 0)));
        var c = world.AddDynamic(ball, 1, new RigidPose(new Vector3(-0.4f, 0, 0)));
        var joint = world.Solver.Add(a, b, new CenterDistanceLimit(0, 1, default));
        world.Solver.Add(a, b, new CenterDistanceLimit(0, 2, default));
        world.Step();
        Assert.Equal(2, world.Simulation.NarrowPhase.PairCount);
        world.Solver.SetCollideConnected(joint, false);
        Assert.False(world.Solver.GetCollideConnected(joint));
        world.Bodies[b].Pose.Position = world.Bodies[a].Pose.Position + new Vector3(0.4f, 0, 0);
        world.Bodies[c].Pose.Position = world.Bodies[a].Pose.Position - new Vector3(0.4f, 0, 0);
        world.Step();
        // What touched has parted, and what is not connected still touches.
        Assert.Equal(1, world.Simulation.NarrowPhase.PairCount);
        world.Simulation.Validate();
        world.Solver.SetEnabled(joint, false);
        world.Step();
        Assert.Equal(1, world.Simulation.NarrowPhase.PairCount);
        world.Solver.SetCollideConnected(joint, true);
        world.Bodies[b].Pose.Position = world.Bodies[a].Pose.Position + new Vector3(0.4f, 0, 0);
        world.Step();
        Assert.Equal(2, world.Simulation.NarrowPhase.PairCount);
        world.Solver.SetCollideConnected(joint, false);
        world.Solver.Remove(joint);
        world.Bodies[b].Pose.Position = world.Bodies[a].Pose.Position + new Vector3(0.4f, 0, 0);
        world.Step();
        Assert.Equal(2, world.Simulation.NarrowPhase.PairCount);
        world.Simulation.Validate();
    }

    [Fact]
    public void Crowds_that_do_not_collide_are_the_same_on_three_threads()
    {
        Assert.Equal(Hashes(1), Hashes(3));

        static ulong[] Hashes(int threads)
        {
            using var world = World(collides: true, threads);
            for (int chain = 0; chain < 40; ++chain)
            {
                var last = world.AddKinematic(ball, new RigidPose(new Vector3(0, 0, chain * 0.3f)));
                for (int i = 0; i < 10; ++i)
                {
                    var next = world.AddDynamic(ball, 1, new RigidPose(new Vector3(i * 0.35f + 0.35f, 0, chain * 0.3f)));
                    var joint = world.Solver.Add(last, next, new BallSocket { LocalOffsetA = new(0.175f, 0, 0), LocalOffsetB = new(-0.175f, 0, 0) });
                    world.Solver.SetCollideConnected(joint, false);
                    world.Solver.SetEnabled(joint, (i + chain) % 7 != 0);
                    last = next;
                }
            }
            return [.. world.HashSteps(30)];
        }
    }

    [Fact]
    public void Nothing_is_allocated()
    {
        using var world = World(collides: true);
        var joints = AddChain(world, 20, out _);
        foreach (var joint in joints)
            world.Solver.SetBreakThreshold(joint, new(1e6f));
        world.Solver.SetCollideConnected(joints[0], false);
        Use();
        world.Step(30);
        var bytes = world.Pool.GetTotalAllocatedByteCount();
        Assert.Equal(0, Garbage.Of(Use));
        Assert.Equal(bytes, world.Pool.GetTotalAllocatedByteCount());

        void Use()
        {
            foreach (var joint in joints)
            {
                world.Solver.SetEnabled(joint, false);
                world.Solver.SetCollideConnected(joint, false);
                world.Solver.SetBreakThreshold(joint, new(1e6f, 1e6f));
                world.Solver.GetSeparation(joint);
            }
            world.Step();
            foreach (var joint in joints)
            {
                world.Solver.SetEnabled(joint, true);
                world.Solver.SetCollideConnected(joint, true);
                world.Solver.SetBreakThreshold(joint, new(1e5f));
            }
            world.Step();
        }
    }

    [Fact]
    public void Contacts_are_refused()
    {
        using var world = World(collides: true);
        var a = world.AddDynamic(ball, 1, new RigidPose(Vector3.Zero));
        world.AddDynamic(ball, 1, new RigidPose(new Vector3(0.4f, 0, 0)));
        world.Step();
        var contact = world.Bodies[a].Constraints[0].ConnectingConstraintHandle;
        Assert.True(world.Solver.IsEnabled(contact));
        Assert.Throws<ArgumentException>(() => world.Solver.SetEnabled(contact, false));
        Assert.Throws<ArgumentException>(() => world.Solver.SetCollideConnected(contact, false));
        Assert.Throws<ArgumentException>(() => world.Solver.SetBreakThreshold(contact, new(1)));
        Assert.Throws<ArgumentException>(() => world.Solver.GetSeparation(contact));
        Assert.Equal(float.PositiveInfinity, world.Solver.GetBreakThreshold(contact).Impulse);
        Assert.True(world.Solver.GetCollideConnected(contact));
        world.Simulation.Validate();
    }
}
