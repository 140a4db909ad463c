using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using BepuUtilities.Diagnostics;
using Xunit;

namespace DemoTests.Scenes;

/// <summary>What the walk over the invariants finds when something is wrong, and what the hash of the state covers.</summary>
public class ValidationTests
{
    // Each breaks one thing and returns what puts it right again.
    static readonly Dictionary<string, Func<TestWorld, Action>> damages = new()
    {
        ["location of body"] = world => Set(ref world.Bodies.HandleToLocation[1].Index, 0, value => world.Bodies.HandleToLocation[1].Index = value),
        ["state of the id of bodies"] = world => Set(
            ref world.Bodies.HandleToLocation[Removed(world)].SetIndex, 0, value => world.Bodies.HandleToLocation[Removed(world)].SetIndex = value),
        ["twice free id of bodies"] = world => TwiceFree(world),
        ["position of body"] = world => Set(ref world.Bodies[new(1)].Pose.Position.X, float.NaN, value => world.Bodies[new(1)].Pose.Position.X = value),
        ["angular velocity of body"] = world => Set(
            ref world.Bodies[new(1)].Velocity.Angular.Y, float.PositiveInfinity, value => world.Bodies[new(1)].Velocity.Angular.Y = value),
        ["inverse mass of body"] = world => Set(
            ref world.Bodies[new(1)].LocalInertia.InverseMass, float.NaN, value => world.Bodies[new(1)].LocalInertia.InverseMass = value),
        ["collidable of the leaf of body"] = world => Set(
            ref world.Bodies[new(1)].LocalInertia, default, value => world.Bodies[new(1)].LocalInertia = value),
        ["shape of body"] = world =>
        {
            var old = world.Bodies[new(1)].Collidable.Shape;
            world.Bodies[new(1)].Collidable.Shape = new TypedIndex(2, 99);
            return () => world.Bodies[new(1)].Collidable.Shape = old;
        },
        ["leaf of body"] = world => Set(ref world.Bodies[new(1)].Collidable.BroadPhaseIndex, 99,
            value => world.Bodies[new(1)].Collidable.BroadPhaseIndex = value),
        ["rows behind the last body"] = world => Set(
            ref world.Bodies.ActiveSet.MotionStates[world.Bodies.ActiveSet.Count].Velocity.Linear.X, 1,
            value => world.Bodies.ActiveSet.MotionStates[world.Bodies.ActiveSet.Count].Velocity.Linear.X = value),
        ["body of a listed constraint"] = world => Set(ref List(world, 1), List(world, 5), value => List(world, 1) = value),
        ["end of the list"] = world => Set(ref List(world, 1).Count, 1, value => List(world, 1).Count = value),
        ["length of the list"] = world => Set(ref List(world, 1).Count, 9, value => List(world, 1).Count = value),
        ["list of constraints of body"] = world => Set(ref List(world, 1).First, 1 << 30, value => List(world, 1).First = value),
        ["index of static"] = world => Set(ref world.Statics.HandleToIndex[0], 1, value => world.Statics.HandleToIndex[0] = value),
        ["orientation of static"] = world => Set(ref world.Statics[0].Pose.Orientation.W, float.NaN, value => world.Statics[0].Pose.Orientation.W = value),
        ["collidable of the leaf of static"] = world => Set(ref world.Statics[0].BroadPhaseIndex, 1, value => world.Statics[0].BroadPhaseIndex = value),
        ["box at slot"] = world => Set(ref world.Simulation.BroadPhase.ActiveTree.Nodes[0].A.Min.X, float.NaN,
            value => world.Simulation.BroadPhase.ActiveTree.Nodes[0].A.Min.X = value),
        ["location of constraint"] = world => Set(
            ref world.Solver.HandleToConstraint[Joint(world)].TypeId, 31, value => world.Solver.HandleToConstraint[Joint(world)].TypeId = value),
        ["bodies of batch"] = world =>
        {
            world.Solver.ActiveSet.Batches[0].DynamicBodies.SetUnsafely(40);
            return () => world.Solver.ActiveSet.Batches[0].DynamicBodies.Unset(40);
        },
        ["unused lane"] = world =>
        {
            var reference = world.Solver.GetConstraintReference(new ConstraintHandle(Joint(world)));
            var index = world.Solver.Processor(ConstraintTypeIds.BallSocket);
            index.BodyReference(ref reference.TypeBatch, reference.IndexInTypeBatch + 1, 0) = 0;
            return () => index.BodyReference(ref reference.TypeBatch, reference.IndexInTypeBatch + 1, 0) = EncodedBody.Empty;
        },
        ["impulse of constraint"] = world =>
        {
            var reference = world.Solver.GetConstraintReference(new ConstraintHandle(Joint(world)));
            var processor = world.Solver.Processor(ConstraintTypeIds.BallSocket);
            var old = processor.Impulse(ref reference.TypeBatch, reference.IndexInTypeBatch, 1);
            processor.Impulse(ref reference.TypeBatch, reference.IndexInTypeBatch, 1) = float.NaN;
            return () => processor.Impulse(ref reference.TypeBatch, reference.IndexInTypeBatch, 1) = old;
        },
        ["kinematic flag of constraint"] = world => Set(
            ref world.Bodies[new(5)].LocalInertia, default, value => world.Bodies[new(5)].LocalInertia = value),
        ["constraint of pair"] = world =>
        {
            // Behind the back of the narrow phase.
            var contact = world.Bodies[new(1)].Constraints[0].ConnectingConstraintHandle;
            world.Solver.RemoveWithoutNotice(contact);
            return () => { };
        },
    };

    public static TheoryData<string> Damages => new(damages.Keys);

    [Theory]
    [MemberData(nameof(Damages))]
    public void Damage_is_found_and_named(string damage)
    {
        using var world = Healthy();
        world.Simulation.Validate();

        var repair = damages[damage](world);

        var error = Assert.Throws<PhysicsInvariantException>(world.Simulation.Validate);
        Assert.Contains(damage, error.Message, StringComparison.Ordinal);
        repair();
        if (damage != "constraint of pair")
            world.Simulation.Validate();
    }

    [Fact]
    public void A_disposed_simulation_is_refused()
    {
        var world = Healthy();
        world.Dispose();

        Assert.Throws<ObjectDisposedException>(world.Simulation.Validate);
        Assert.Throws<ObjectDisposedException>(() => world.Simulation.StateHash());
    }

    [Fact]
    public void The_hash_covers_every_number_of_every_body_and_nothing_of_the_memory()
    {
        using var one = Healthy();
        using var other = Healthy();
        Assert.Equal(one.Simulation.StateHash(), other.Simulation.StateHash());
        var body = other.Bodies[new(3)];
        var before = body.MotionState;
        var hashes = new HashSet<ulong> { one.Simulation.StateHash() };
        for (int i = 0; i < 13; ++i)
        {
            switch (i)
            {
                case < 3: body.Pose.Position[i] += 1; break;
                case < 6: body.Velocity.Linear[i - 3] += 1; break;
                case < 9: body.Velocity.Angular[i - 6] += 1; break;
                default: body.Pose.Orientation[i - 9] += 1; break;
            }
            Assert.True(hashes.Add(other.Simulation.StateHash()), $"number {i} is not part of the hash");
            body.MotionState = before;
        }
        Assert.Equal(one.Simulation.StateHash(), other.Simulation.StateHash());
    }

    [Fact]
    public void The_hash_follows_handles_and_not_places_in_memory()
    {
        using var one = new TestWorld();
        using var other = new TestWorld();
        // The second world has its bodies in another order in memory: a removed one was replaced.
        foreach (var world in new[] { one, other })
        {
            for (int i = 0; i < 4; ++i)
                world.AddDynamic(new Sphere(1), 1, new RigidPose(new Vector3(10 * i, 0, 0)));
        }
        other.Bodies.Remove(new(0));
        other.AddDynamic(new Sphere(1), 1, new RigidPose(new Vector3(0, 0, 0)));

        Assert.NotEqual(one.Bodies.HandleToLocation[0].Index, other.Bodies.HandleToLocation[0].Index);
        Assert.Equal(one.Simulation.StateHash(), other.Simulation.StateHash());
        Assert.Equal(one.HashSteps(5), other.HashSteps(5));
    }

    // A stack on a floor, a joint beside it, a free handle.
    static TestWorld Healthy()
    {
        var world = new TestWorld();
        world.AddStatic(new Box(20, 2, 20), new RigidPose(new Vector3(0, -1, 0)));
        world.AddStatic(new Box(2, 2, 2), new RigidPose(new Vector3(0, -10, 0)));
        for (int i = 0; i < 4; ++i)
            world.AddDynamic(new Box(1, 1, 1), 1, new RigidPose(new Vector3(0, .5f + i, 0)));
        var a = world.AddDynamic(new Sphere(.5f), 1, new RigidPose(new Vector3(5, 5, 0)));
        var b = world.Bodies.Add(BodyDescription.CreateDynamic(
            new Vector3(5, 7, 0), new Sphere(.5f).ComputeInertia(1), default(CollidableDescription), new BodyActivityDescription(-1)));
        world.Solver.Add(a, b, new BallSocket { LocalOffsetA = Vector3.UnitY, LocalOffsetB = -Vector3.UnitY });
        var removed = world.AddDynamic(new Sphere(.5f), 1, new RigidPose(new Vector3(50, 5, 0)));
        world.Step(5);
        world.Bodies.Remove(removed);
        Assert.Equal(Removed(world), removed.Value);
        return world;
    }

    static int Removed(TestWorld world) => world.Bodies.HandlePool.HighestPossiblyClaimedId;

    static ref ConstraintList List(TestWorld world, int body) =>
        ref world.Bodies.ActiveSet.Constraints[world.Bodies[new(body)].MemoryLocation.Index];

    static int Joint(TestWorld world) => world.Bodies[new(5)].Constraints[0].ConnectingConstraintHandle.Value;

    static Action Set<T>(ref T target, T value, Action<T> restore)
    {
        var old = target;
        target = value;
        return () => restore(old);
    }

    static Action TwiceFree(TestWorld world)
    {
        world.Bodies.HandlePool.ReturnUnsafely(Removed(world));
        return () => world.Bodies.HandlePool.Take();
    }
}
