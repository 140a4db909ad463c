using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using BepuUtilities;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Handles;

/// <summary>Handles of what was removed, of what never was, and references made with them: an exception, whatever is in the slot by now.</summary>
public class StaleHandleTests
{
    /// <summary>What may have become of the slot of a handle.</summary>
    public enum Fate { Free, TakenAgain, Cleared, ClearedAndTakenAgain, NeverGivenOut, Negative, BeyondAllBits }

    public static TheoryData<Fate> Fates => [.. Enum.GetValues<Fate>()];

    static readonly (string Name, Action<BodyReference> Use)[] bodyMembers =
    [
        ("MemoryLocation", body => _ = body.MemoryLocation.Index),
        ("Awake", body => _ = body.Awake),
        ("MotionState", body => body.MotionState = default),
        ("Pose", body => body.Pose.Position = default),
        ("Velocity", body => body.Velocity.Linear = default),
        ("LocalInertia", body => _ = body.LocalInertia.InverseMass),
        ("Dynamics", body => _ = body.Dynamics.Motion.Pose),
        ("Collidable", body => body.Collidable.MinimumSpeculativeMargin = 1),
        ("Activity", body => body.Activity.SleepThreshold = 1),
        ("Constraints", body => _ = body.Constraints.Count),
        ("CollidableReference", body => _ = body.CollidableReference),
        ("Kinematic", body => _ = body.Kinematic),
        ("HasLockedInertia", body => _ = body.HasLockedInertia),
        ("BoundingBox", body => _ = body.BoundingBox),
        ("BecomeKinematic", body => body.BecomeKinematic()),
        ("SetLocalInertia", body => body.SetLocalInertia(new Sphere(1).ComputeInertia(1))),
        ("SetShape", body => body.SetShape(default)),
        ("GetDescription", body => body.GetDescription(out _)),
        ("ApplyDescription", body => body.ApplyDescription(Description(default))),
        ("UpdateBounds", body => body.UpdateBounds()),
        ("ComputeInverseInertia", body => body.ComputeInverseInertia(out _)),
        ("GetVelocityForOffset", body => body.GetVelocityForOffset(default, out _)),
        ("ApplyImpulse", body => body.ApplyImpulse(Vector3.One, Vector3.One)),
        ("ApplyLinearImpulse", body => body.ApplyLinearImpulse(Vector3.One)),
        ("ApplyAngularImpulse", body => body.ApplyAngularImpulse(Vector3.One)),
    ];

    static readonly (string Name, Action<StaticReference> Use)[] staticMembers =
    [
        ("Index", one => _ = one.Index),
        ("Static", one => one.Static.Continuity = default),
        ("Pose", one => one.Pose.Position = default),
        ("Continuity", one => one.Continuity = default),
        ("Shape", one => _ = one.Shape),
        ("BoundingBox", one => _ = one.BoundingBox),
        ("SetShape", one => one.SetShape(new TypedIndex(0, 0))),
        ("GetDescription", one => one.GetDescription(out _)),
        ("ApplyDescription", one => one.ApplyDescription(new StaticDescription(RigidPose.Identity, new TypedIndex(0, 0)))),
        ("UpdateBounds", one => one.UpdateBounds()),
    ];

    [Theory]
    [MemberData(nameof(Fates))]
    public void A_reference_to_no_body_throws_in_every_member(Fate fate)
    {
        using var world = new TestWorld();
        var handle = HandleOf(world, fate, () => AddBody(world), world.Bodies.Remove, body => body.Value, value => new BodyHandle(value));
        var reference = new BodyReference(handle, world.Bodies);
        Refuses(world, bodyMembers.Select(member => (member.Name, (Action)(() => member.Use(reference)))));
        Assert.False(reference.Exists);
        Assert.False(world.Bodies.BodyExists(handle));
    }

    [Theory]
    [MemberData(nameof(Fates))]
    public void A_reference_to_no_static_throws_in_every_member(Fate fate)
    {
        using var world = new TestWorld();
        var handle = HandleOf(
            world, fate, () => world.AddStatic(new Sphere(1), RigidPose.Identity), world.Statics.Remove, one => one.Value, value => new StaticHandle(value));
        var reference = new StaticReference(handle, world.Statics);
        Refuses(world, staticMembers.Select(member => (member.Name, (Action)(() => member.Use(reference)))));
        Assert.False(reference.Exists);
        Assert.False(world.Statics.StaticExists(handle));
    }

    [Theory]
    [MemberData(nameof(Fates))]
    public void A_handle_of_no_body_is_refused_everywhere(Fate fate)
    {
        using var world = new TestWorld();
        using var property = new CollidableProperty<int>(world.Simulation);
        var handle = HandleOf(world, fate, () => AddBody(world), world.Bodies.Remove, body => body.Value, value => new BodyHandle(value));
        var other = AddBody(world);
        var joint = new BallSocket();
        var nobody = new Nobody();
        Refuses(world,
        [
            ("indexer", () => _ = world.Bodies[handle]),
            ("GetBodyReference", () => world.Bodies.GetBodyReference(handle)),
            ("Remove", () => world.Bodies.Remove(handle)),
            ("GetDescription", () => world.Bodies.GetDescription(handle)),
            ("ApplyDescription", () => world.Bodies.ApplyDescription(handle, Description(default))),
            ("SetShape", () => world.Bodies.SetShape(handle, default)),
            ("SetLocalInertia", () => world.Bodies.SetLocalInertia(handle, default)),
            ("UpdateBounds", () => world.Bodies.UpdateBounds(handle)),
            ("EnumerateConnectedBodies", () => world.Bodies.EnumerateConnectedBodies(handle, ref nobody)),
            ("Solver.Add", () => world.Solver.Add(handle, other, joint)),
            ("Solver.Add as second body", () => world.Solver.Add(other, handle, joint)),
        ]);
        if (fate != Fate.NeverGivenOut)
        {
            Refuses(world,
            [
                ("CollidableProperty", () => _ = property[handle]),
                ("CollidableProperty.Allocate", () => property.Allocate(handle) = 1),
                ("CollidableProperty of a collidable", () => _ = property[new CollidableReference(CollidableMobility.Dynamic, handle)]),
            ]);
        }
    }

    [Theory]
    [MemberData(nameof(Fates))]
    public void A_handle_of_no_static_is_refused_everywhere(Fate fate)
    {
        using var world = new TestWorld();
        using var property = new CollidableProperty<int>(world.Simulation);
        var handle = HandleOf(
            world, fate, () => world.AddStatic(new Sphere(1), RigidPose.Identity), world.Statics.Remove, one => one.Value, value => new StaticHandle(value));
        var shape = world.Simulation.Shapes.Add(new Sphere(1));
        Refuses(world,
        [
            ("indexer", () => _ = world.Statics[handle]),
            ("GetStaticReference", () => world.Statics.GetStaticReference(handle)),
            ("GetDirectReference", () => world.Statics.GetDirectReference(handle).Pose = default),
            ("Remove", () => world.Statics.Remove(handle)),
            ("GetDescription", () => world.Statics.GetDescription(handle)),
            ("ApplyDescription", () => world.Statics.ApplyDescription(handle, new StaticDescription(RigidPose.Identity, shape))),
            ("SetShape", () => world.Statics.SetShape(handle, shape)),
            ("UpdateBounds", () => world.Statics.UpdateBounds(handle)),
        ]);
        if (fate != Fate.NeverGivenOut)
        {
            Refuses(world,
            [
                ("CollidableProperty", () => _ = property[handle]),
                ("CollidableProperty.Allocate", () => property.Allocate(handle) = 1),
                ("CollidableProperty of a collidable", () => _ = property[new CollidableReference(handle)]),
            ]);
        }
    }

    [Theory]
    [MemberData(nameof(Fates))]
    public void A_handle_of_no_constraint_is_refused_everywhere(Fate fate)
    {
        using var world = new TestWorld();
        var handle = HandleOf(
            world, fate, () => world.Solver.Add(AddBody(world), AddBody(world), new BallSocket()), world.Solver.Remove, joint => joint.Value,
            value => new ConstraintHandle(value));
        var sum = new Sum();
        Refuses(world,
        [
            ("Remove", () => world.Solver.Remove(handle)),
            ("ApplyDescription", () => world.Solver.ApplyDescription(handle, new BallSocket())),
            ("ApplyDescriptionWithoutWaking", () => world.Solver.ApplyDescriptionWithoutWaking(handle, new BallSocket())),
            ("GetDescription", () => world.Solver.GetDescription(handle, out BallSocket _)),
            ("GetConstraintReference", () => world.Solver.GetConstraintReference(handle)),
            ("EnumerateAccumulatedImpulses", () => world.Solver.EnumerateAccumulatedImpulses(handle, ref sum)),
            ("GetAccumulatedImpulseMagnitude", () => world.Solver.GetAccumulatedImpulseMagnitude(handle)),
        ]);
        Assert.False(world.Solver.ConstraintExists(handle));
    }

    [Fact]
    public void Default_references_say_that_they_refer_to_nothing()
    {
        foreach (var (name, use) in bodyMembers)
            Assert.True(Record.Exception(() => use(default)) is InvalidOperationException, name);
        foreach (var (name, use) in staticMembers)
            Assert.True(Record.Exception(() => use(default)) is InvalidOperationException, name);
        Assert.False(default(BodyReference).Exists);
        Assert.False(default(StaticReference).Exists);
    }

    [Fact]
    public void Tables_and_indices_out_of_range_are_refused()
    {
        using var world = new TestWorld();
        AddBody(world);
        world.AddStatic(new Sphere(1), RigidPose.Identity);
        foreach (int value in new[] { -1, 100_000, BodyHandle.SlotMask, int.MaxValue, int.MinValue + 50_000 })
        {
            Assert.Throws<ArgumentOutOfRangeException>(() => world.Bodies.HandleToLocation[value].Index);
            Assert.Throws<ArgumentOutOfRangeException>(() => world.Statics.HandleToIndex[value]);
            Assert.Throws<ArgumentOutOfRangeException>(() => world.Solver.HandleToConstraint[value].TypeId);
        }
        foreach (int index in new[] { -1, 1, int.MaxValue, int.MinValue })
        {
            Assert.Throws<ArgumentOutOfRangeException>(() => world.Statics[index].Pose);
            Assert.Throws<ArgumentOutOfRangeException>(() => world.Statics.RemoveAt(index));
            Assert.Throws<ArgumentOutOfRangeException>(() => world.Bodies.RemoveAt(index));
        }
        foreach (int value in new[] { -1, 1 << 30, int.MinValue })
        {
            Assert.Throws<ArgumentOutOfRangeException>(() => new CollidableReference(CollidableMobility.Dynamic, new BodyHandle(value)));
            Assert.Throws<ArgumentOutOfRangeException>(() => new CollidableReference(new StaticHandle(value)));
        }
    }

    [Fact]
    public void A_body_without_a_shape_has_no_bounds_and_says_so()
    {
        using var world = new TestWorld();
        AddBody(world);
        var handle = world.Bodies.Add(Description(default));
        Assert.Throws<InvalidOperationException>(() => world.Bodies[handle].BoundingBox);
        world.Bodies.UpdateBounds(handle);
    }

    [Fact]
    public unsafe void Nothing_was_written_where_a_reference_was_refused()
    {
        using var world = new TestWorld();
        var stale = AddBody(world);
        var reference = world.Bodies[stale];
        world.Bodies.Remove(stale);
        var heir = AddBody(world);
        Assert.Equal(stale.Slot, heir.Slot);
        var before = world.Simulation.StateHash();
        foreach (var (_, use) in bodyMembers)
            Record.Exception(() => use(reference));
        Assert.Equal(before, world.Simulation.StateHash());
        Assert.False(world.Bodies[heir].Kinematic);
        Assert.Equal(0, world.Bodies[heir].Collidable.MinimumSpeculativeMargin);
    }

    static THandle HandleOf<THandle>(
        TestWorld world, Fate fate, Func<THandle> add, Action<THandle> remove, Func<THandle, int> valueOf, Func<int, THandle> withValue)
    {
        var handle = add();
        switch (fate)
        {
            case Fate.Free:
                remove(handle);
                return handle;
            case Fate.TakenAgain:
                remove(handle);
                add();
                return handle;
            case Fate.Cleared:
                world.Simulation.Clear();
                return handle;
            case Fate.ClearedAndTakenAgain:
                world.Simulation.Clear();
                add();
                return handle;
            case Fate.NeverGivenOut:
                return withValue(valueOf(handle) + 5);
            case Fate.Negative:
                return withValue(-1);
            default:
                return withValue(valueOf(handle) | 1 << 30);
        }
    }

    static void Refuses(TestWorld world, IEnumerable<(string Name, Action Use)> uses)
    {
        var accepted = new List<string>();
        foreach (var (name, use) in uses)
        {
            var exception = Record.Exception(use);
            if (exception is not ArgumentException || exception.Message.Length == 0)
                accepted.Add($"{name}: {exception?.GetType().Name ?? "nothing"}");
        }
        Assert.Empty(accepted);
        world.Simulation.Validate();
        world.Step(2);
    }

    static BodyHandle AddBody(TestWorld world) => world.AddDynamic(new Sphere(.5f), 1, new RigidPose(new Vector3(0, 3 * world.Bodies.CountBodies(), 0)));

    static BodyDescription Description(TypedIndex shape) => BodyDescription.CreateDynamic(
        RigidPose.Identity, new Sphere(1).ComputeInertia(1), new CollidableDescription(shape), new BodyActivityDescription(-1));

    struct Nobody : IForEach<BodyHandle>
    {
        public readonly void LoopBody(BodyHandle i) => Assert.Fail("There is nobody to visit.");
    }

    struct Sum : IForEach<float>
    {
        public readonly void LoopBody(float i) => Assert.Fail("There is nothing to add.");
    }
}
