using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Locking;

/// <summary>Calls on a body or static whose pose or velocity was written to be no number: done wholly, or refused with nothing changed.</summary>
public class NonFiniteBodyTests
{
    static readonly (string Name, Action<TestWorld, BodyHandle> Do, bool NeedsBounds)[] bodyCalls =
    [
        ("UpdateBounds", static (w, b) => w.Bodies.UpdateBounds(b), true),
        ("SetShape", static (w, b) => w.Bodies.SetShape(b, w.Simulation.Shapes.Add(new Box(1, 2, 3))), true),
        ("SetShape to none", static (w, b) => w.Bodies.SetShape(b, default), false),
        ("SetShape to the same", static (w, b) => w.Bodies.SetShape(b, w.Bodies[b].Collidable.Shape), false),
        ("SetLocalInertia", static (w, b) => w.Bodies.SetLocalInertia(b, new Sphere(1).ComputeInertia(3)), false),
        ("BecomeKinematic", static (w, b) => w.Bodies[b].BecomeKinematic(), false),
        ("BecomeKinematic and dynamic", static (w, b) =>
        {
            w.Bodies[b].BecomeKinematic();
            w.Bodies[b].SetLocalInertia(new Sphere(1).ComputeInertia(1));
        }, false),
        ("ApplyDescription", static (w, b) => w.Bodies.ApplyDescription(b, BodyDescription.CreateDynamic(
            new Vector3(0, 30, 0), new Sphere(1).ComputeInertia(1), w.Simulation.Shapes.Add(new Box(1, 2, 3)), -1)), false),
        ("ApplyDescription as kinematic without a shape", static (w, b) => w.Bodies.ApplyDescription(b, BodyDescription.CreateKinematic(
            new Vector3(0, 30, 0), default(TypedIndex), -1)), false),
        ("Remove", static (w, b) => w.Bodies.Remove(b), false),
    ];

    public static TheoryData<string, float, bool> Cases
    {
        get
        {
            var data = new TheoryData<string, float, bool>();
            foreach (float value in new[] { float.NaN, float.PositiveInfinity, float.NegativeInfinity })
            {
                foreach (string part in new[] { "position", "orientation", "linear velocity", "angular velocity" })
                {
                    data.Add(part, value, false);
                    data.Add(part, value, true);
                }
            }
            return data;
        }
    }

    [Theory]
    [MemberData(nameof(Cases))]
    public void A_call_on_a_body_that_went_bad_is_whole_or_refused(string part, float value, bool jointed)
    {
        foreach (var (name, act, needsBounds) in bodyCalls)
        {
            using var world = new TestWorld();
            world.AddStatic(new Box(50, 2, 50), new RigidPose(new Vector3(0, -1, 0)));
            var handles = new List<BodyHandle>();
            for (int i = 0; i < 6; ++i)
                handles.Add(world.AddDynamic(new Box(1, 1, 1), 1, new RigidPose(new Vector3(i * .99f, .5f, 0))));
            var bad = handles[2];
            if (jointed)
                world.Solver.Add(bad, handles[4], new BallSocket { LocalOffsetA = Vector3.UnitX, LocalOffsetB = -Vector3.UnitX });
            world.Step(3);
            Spoil(world.Bodies[bad], part, value);
            var before = Look(world, bad);

            var exception = Record.Exception(() => act(world, bad));

            bool isPose = part is "position" or "orientation";
            Assert.True(needsBounds && isPose ? exception is InvalidOperationException : exception is null, $"{name}: {exception}");
            if (exception is not null)
                Assert.Equal(before, Look(world, bad));
            if (world.Bodies.BodyExists(bad))
            {
                world.Bodies.ApplyDescription(bad, BodyDescription.CreateDynamic(
                    new Vector3(0, 30, 0), new Sphere(1).ComputeInertia(1), world.Bodies[handles[0]].Collidable.Shape, -1));
            }
            world.Simulation.Validate();
            world.Step(3);
            world.Simulation.Validate();
        }
    }

    [Theory]
    [InlineData(float.NaN)]
    [InlineData(float.PositiveInfinity)]
    public void A_call_on_a_static_that_went_bad_is_whole_or_refused(float value)
    {
        using var world = new TestWorld();
        var other = world.AddStatic(new Box(50, 2, 50), new RigidPose(new Vector3(0, -1, 0)));
        var bad = world.AddStatic(new Sphere(1), new RigidPose(new Vector3(5, 0, 0)));
        var good = world.Statics.GetDescription(bad);
        var bounds = world.Statics[bad].BoundingBox;
        var box = world.Simulation.Shapes.Add(new Box(1, 1, 1));
        world.Statics[bad].Pose.Position.Y = value;
        Assert.Throws<InvalidOperationException>(() => world.Statics.UpdateBounds(bad));
        Assert.Throws<InvalidOperationException>(() => world.Statics.SetShape(bad, box));
        Assert.Equal(good.Shape, world.Statics[bad].Shape);
        Assert.Equal(bounds.Min, world.Statics[bad].BoundingBox.Min);
        Assert.Equal(bounds.Max, world.Statics[bad].BoundingBox.Max);
        Assert.Equal(2, world.Simulation.BroadPhase.StaticTree.LeafCount);
        world.Statics.ApplyDescription(bad, good);
        world.Simulation.Validate();
        world.Statics[bad].Pose.Position.Y = value;
        world.Statics.Remove(bad);
        world.Simulation.Validate();
        Assert.True(world.Statics.StaticExists(other));
        world.Step(2);
    }

    static void Spoil(BodyReference body, string part, float value)
    {
        switch (part)
        {
            case "position": body.Pose.Position.Y = value; break;
            case "orientation": body.Pose.Orientation.Y = value; break;
            case "linear velocity": body.Velocity.Linear.Y = value; break;
            default: body.Velocity.Angular.Y = value; break;
        }
    }

    static (TypedIndex, Vector3, Vector3, int, int, bool, int) Look(TestWorld world, BodyHandle handle)
    {
        var body = world.Bodies[handle];
        var bounds = body.BoundingBox;
        return (body.Collidable.Shape, bounds.Min, bounds.Max, world.Simulation.BroadPhase.ActiveTree.LeafCount, body.Constraints.Count, body.Kinematic,
            body.Collidable.BroadPhaseIndex);
    }
}
