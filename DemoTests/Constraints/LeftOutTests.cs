using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using Demos.Accuracy;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Constraints;

/// <summary>Constraints that are left out of the sweeps, for a stage that solves them by their rows.</summary>
public class LeftOutTests
{
    const int ChainLength = 5;

    static TestWorld World() => new(new AccuracySettings { Contacts = ContactScope.None });

    // Balls in a row from a kinematic anchor, each a metre from the one before.
    static ConstraintHandle[] AddChain(TestWorld world, out BodyHandle anchor, out BodyHandle last)
    {
        var ball = new Sphere(0.25f);
        last = anchor = world.AddKinematic(ball, new RigidPose(Vector3.Zero));
        var joints = new ConstraintHandle[ChainLength];
        for (int i = 0; i < ChainLength; ++i)
        {
            var next = world.AddDynamic(ball, 1, new RigidPose(new Vector3(i + 1, 0, 0)));
            joints[i] = world.Solver.Add(last, next, new BallSocket { LocalOffsetA = new Vector3(0.5f, 0, 0), LocalOffsetB = new Vector3(-0.5f, 0, 0) });
            last = next;
        }
        return joints;
    }

    [Fact]
    public void What_is_left_out_is_not_solved_until_it_is_taken_in()
    {
        using var world = World();
        var joints = AddChain(world, out _, out var last);
        world.Step(10);
        world.Solver.SetSwept(joints[^1], false);
        world.Simulation.Validate();
        Assert.False(world.Solver.IsSwept(joints[^1]));
        var before = world.Bodies[last].Velocity.Linear;
        world.Step(10);
        // It falls freely.
        Assert.True((world.Bodies[last].Velocity.Linear - before - new Vector3(0, -9.81f / 6, 0)).Length() < 1e-3f);
        world.Solver.SetSwept(joints[^1], true);
        world.Simulation.Validate();
        Assert.True(world.Solver.IsSwept(joints[^1]));
        world.Solver.GetDescription<BallSocket>(joints[^1], out var description);
        Assert.Equal(new Vector3(0.5f, 0, 0), description.LocalOffsetA);
        before = world.Bodies[last].Velocity.Linear;
        world.Step(2);
        Assert.True((world.Bodies[last].Velocity.Linear - before).Length() > 0.5f);
    }

    [Fact]
    public void It_can_be_removed_and_its_bodies_can_change()
    {
        using var world = World();
        var joints = AddChain(world, out var anchor, out var last);
        foreach (var joint in joints)
            world.Solver.SetSwept(joint, false);
        world.Simulation.Validate();
        world.Step(2);
        world.Bodies[last].BecomeKinematic();
        Assert.False(world.Solver.IsSwept(joints[^1]));
        world.Simulation.Validate();
        world.Solver.Remove(joints[1]);
        world.Bodies.Remove(anchor);
        Assert.False(world.Solver.ConstraintExists(joints[0]));
        world.Simulation.Validate();
        world.Step(2);
        Assert.Equal(ChainLength - 2, world.Solver.CountConstraints());
    }

    [Fact]
    public void A_chain_that_was_out_and_in_again_is_the_same_chain()
    {
        using var world = World();
        using var other = World();
        var joints = AddChain(world, out _, out _);
        AddChain(other, out _, out _);
        foreach (var joint in joints)
            world.Solver.SetSwept(joint, false);
        foreach (var joint in joints)
            world.Solver.SetSwept(joint, true);
        Assert.Equal(other.HashSteps(20), world.HashSteps(20));
    }

    [Fact]
    public void A_stage_can_solve_it_by_its_rows()
    {
        using var world = World();
        var joints = AddChain(world, out _, out _);
        foreach (var joint in joints)
            world.Solver.SetSwept(joint, false);
        world.Solver.OptionalStages.Add(new RowStage(world, joints));
        float greatest = 0;
        for (int i = 0; i < 120; ++i)
        {
            world.Step();
            Assert.True(Gap(world, joints) < 0.02f, $"step {i}: {Gap(world, joints)} m");
            greatest = MathF.Max(greatest, world.Solver.GetAccumulatedImpulseMagnitude(joints[0]));
        }
        // Swinging through the lowest point the chain weighs more than at rest.
        Assert.True(greatest > ChainLength * 9.81f / 240, $"{greatest} N s");
    }

    static float Gap(TestWorld world, ConstraintHandle[] joints)
    {
        var rows = new ConstraintRow[3];
        float greatest = 0;
        foreach (var joint in joints)
        {
            RowStage.Read(world, joint, new Substep(1, 1 / 240f), rows);
            greatest = MathF.Max(greatest, new Vector3(rows[0].PositionError, rows[1].PositionError, rows[2].PositionError).Length());
        }
        return greatest;
    }

    /// <summary>Solves ball sockets row by row, a few times over: no good solver, but one that knows nothing of their type.</summary>
    sealed unsafe class RowStage(TestWorld world, ConstraintHandle[] joints) : ISolverStage
    {
        const int Sweeps = 30;

        public int GetBlockCount(SolverPoint point) => point == SolverPoint.AfterWarmStart ? 1 : 0;

        public void Execute(SolverPoint point, in Substep substep, int block)
        {
            var rows = new ConstraintRow[3];
            var impulses = new float[3];
            for (int sweep = 0; sweep < Sweeps; ++sweep)
            {
                foreach (var joint in joints)
                {
                    Read(world, joint, substep, rows);
                    for (int i = 0; i < rows.Length; ++i)
                        impulses[i] = (sweep == 0 ? 0 : rows[i].Impulse) + SolveRow(joint, rows[i]);
                    var (processor, index) = Place(world, joint);
                    processor.WriteImpulses(ref BatchOf(world, joint), index, impulses);
                }
            }
        }

        // Changes the velocities of both bodies so that the row sees its target.
        float SolveRow(ConstraintHandle joint, in ConstraintRow row)
        {
            var (processor, index) = Place(world, joint);
            ref var set = ref world.Bodies.ActiveSet;
            RowJacobian[] parts = [row.A, row.B];
            float missing = row.TargetVelocity, inverseMass = 0;
            for (int slot = 0; slot < 2; ++slot)
            {
                var body = processor.BodyReference(ref BatchOf(world, joint), index, slot) & EncodedBody.IndexMask;
                ref var velocity = ref set.MotionStates[body].Velocity;
                missing -= Vector3.Dot(parts[slot].Linear, velocity.Linear) + Vector3.Dot(parts[slot].Angular, velocity.Angular);
                inverseMass += parts[slot].Linear.LengthSquared() * set.WorldInertias[body].InverseMass +
                    Vector3.Dot(parts[slot].Angular, set.WorldInertias[body].InverseInertiaTensor * parts[slot].Angular);
            }
            var impulse = missing / inverseMass;
            for (int slot = 0; slot < 2; ++slot)
            {
                var body = processor.BodyReference(ref BatchOf(world, joint), index, slot) & EncodedBody.IndexMask;
                ref var velocity = ref set.MotionStates[body].Velocity;
                velocity.Linear += parts[slot].Linear * (impulse * set.WorldInertias[body].InverseMass);
                velocity.Angular += set.WorldInertias[body].InverseInertiaTensor * (parts[slot].Angular * impulse);
            }
            return impulse;
        }

        public static void Read(TestWorld world, ConstraintHandle joint, in Substep substep, ConstraintRow[] rows)
        {
            ref var set = ref world.Bodies.ActiveSet;
            var bodies = new SolverBodies(set);
            var (processor, index) = Place(world, joint);
            processor.ReadRows(ref BatchOf(world, joint), bodies, substep, index, rows);
        }

        static (TypeProcessor Processor, int Index) Place(TestWorld world, ConstraintHandle joint)
        {
            var location = world.Solver.Locations[joint.Slot];
            return (world.Solver.Processor(location.TypeId), location.IndexInTypeBatch);
        }

        static ref TypeBatch BatchOf(TestWorld world, ConstraintHandle joint) => ref world.Solver.TypeBatchAt(world.Solver.Locations[joint.Slot]);
    }
}
