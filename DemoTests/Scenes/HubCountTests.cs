using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using Demos.Accuracy;
using Xunit;

namespace DemoTests.Scenes;

/// <summary>
/// Which bodies count as hubs depends on the joints that there are now, on none that were there before, and concerns nobody but them.
/// </summary>
public class HubCountTests
{
    static readonly AccuracySettings relaxed = new() { RelaxationCount = 1, Contacts = ContactScope.None };

    /// <summary>Joints that come and go on a chain's links leave it with every bit that it would have had.</summary>
    [Theory]
    [InlineData(2)]
    [InlineData(9)]
    public void Joints_that_are_gone_leave_no_trace(int extraJoints)
    {
        Assert.Equal(Run(0, false), Run(extraJoints, false));
        Assert.Equal(Run(0, false), Run(extraJoints, true));

        static List<(Vector3, Quaternion, Vector3, Vector3)> Run(int extraJoints, bool removesBodies)
        {
            using var world = new TestWorld(relaxed);
            var chain = Chain(world);
            var arms = new List<BodyHandle>();
            var joints = new List<ConstraintHandle>();
            for (int i = 0; i < extraJoints; ++i)
            {
                arms.Add(world.AddDynamic(new Sphere(.1f), 1, new RigidPose(new Vector3(i, 1, 5))));
                joints.Add(world.Solver.Add(chain[1], arms[i], new BallSocket()));
            }
            world.Simulation.Validate();
            foreach (var joint in removesBodies ? [] : joints)
                world.Solver.Remove(joint);
            foreach (var arm in arms)
                world.Bodies.Remove(arm);
            world.Simulation.Validate();
            world.Step(60);
            return States(world, chain);
        }
    }

    /// <summary>A body that nothing moves couples none of its joints: as many chains may hang on it as there are.</summary>
    [Fact]
    public void Kinematic_bodies_are_no_hubs()
    {
        Assert.Equal(Stretch(1), Stretch(6));

        static float Stretch(int chainCount)
        {
            using var world = new TestWorld(relaxed);
            var anchor = world.AddKinematic(new Sphere(.1f), new RigidPose(Vector3.Zero));
            var weight = default(BodyHandle);
            for (int i = 0; i < chainCount; ++i)
            {
                weight = world.AddDynamic(new Sphere(.1f), 1, new RigidPose(new Vector3(0, -1, 0)));
                world.Solver.Add(anchor, weight, new BallSocket { LocalOffsetB = new Vector3(0, 1, 0) });
            }
            world.Step(120);
            return world.Bodies[weight].Pose.Position.Y;
        }
    }

    [Fact]
    public void A_body_that_changes_its_kind_is_counted_anew()
    {
        using var world = new TestWorld(relaxed);
        var random = new Random(3);
        var bodies = new List<BodyHandle>();
        for (int i = 0; i < 12; ++i)
            bodies.Add(world.AddDynamic(new Sphere(.1f), 1, new RigidPose(new Vector3(i, 0, 0))));
        var inertia = world.Bodies[bodies[0]].LocalInertia;
        for (int i = 0; i < 400; ++i)
        {
            var (a, b) = (bodies[random.Next(12)], bodies[random.Next(12)]);
            if (random.Next(4) == 0)
                world.Bodies.SetLocalInertia(a, random.Next(2) == 0 ? default : inertia);
            else if (a != b && !(world.Bodies[a].Kinematic && world.Bodies[b].Kinematic))
                world.Solver.Add(a, b, new BallSocket());
            if (i % 20 == 0)
                world.Simulation.Validate();
        }
        world.Step(1);
        world.Simulation.Validate();
    }

    /// <summary>A heap that touches no joint keeps every bit, whatever hub there is elsewhere, of few joints or of so many that some fall back.</summary>
    [Theory]
    [InlineData(5)]
    [InlineData(12)]
    [InlineData(80)]
    public void A_hub_elsewhere_changes_no_bit_of_a_heap(int armCount)
    {
        Assert.Equal(Run(0), Run(armCount));

        static List<(Vector3, Quaternion, Vector3, Vector3)> Run(int armCount)
        {
            using var world = new TestWorld(relaxed with { Contacts = ContactScope.All });
            world.AddStatic(new Box(40, 2, 40), new RigidPose(new Vector3(0, -1, 0)));
            var heap = new List<BodyHandle>();
            for (int row = 0; row < 6; ++row)
                for (int i = 0; i < 6 - row; ++i)
                    heap.Add(world.AddDynamic(new Box(1, 1, 1), 1, new RigidPose(new Vector3(i + row * .5f, row + .6f, 0))));
            var hub = armCount > 0 ? world.AddDynamic(new Sphere(.1f), 2, new RigidPose(new Vector3(0, 500, 100))) : default;
            for (int i = 0; i < armCount; ++i)
            {
                var offset = new Vector3(i, 0, 1);
                var arm = world.AddDynamic(new Sphere(.1f), 1, new RigidPose(new Vector3(0, 500, 100) + offset));
                world.Solver.Add(hub, arm, new BallSocket { LocalOffsetA = offset });
            }
            world.Step(90);
            return States(world, heap);
        }
    }

    static List<BodyHandle> Chain(TestWorld world)
    {
        var chain = new List<BodyHandle> { world.AddKinematic(new Sphere(.1f), new RigidPose(Vector3.Zero)) };
        for (int i = 1; i < 5; ++i)
        {
            chain.Add(world.AddDynamic(new Sphere(.1f), i, new RigidPose(new Vector3(i, 0, 0))));
            world.Solver.Add(chain[i - 1], chain[i], new BallSocket { LocalOffsetB = new Vector3(-1, 0, 0) });
        }
        return chain;
    }

    static List<(Vector3, Quaternion, Vector3, Vector3)> States(TestWorld world, List<BodyHandle> bodies) => bodies.ConvertAll(handle =>
    {
        var body = world.Bodies[handle];
        return (body.Pose.Position, body.Pose.Orientation, body.Velocity.Linear, body.Velocity.Angular);
    });
}
