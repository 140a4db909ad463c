using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Constraints;
using DemoTests.CollisionDetection.Children;
using DemoTests.Support;
using Xunit;

namespace DemoTests.CollisionDetection.Seams;

/// <summary>The contacts of children are patches, each an ordinary contact constraint.</summary>
public class PatchTests
{
    static ClusterWorld Create(int threads, IEnumerable<(Vector3 Size, Vector3 Center)> boxes, bool reverses = false)
    {
        var world = new ClusterWorld(isCluster: true, threads);
        List<ClusterChild> children = [];
        foreach (var (size, center) in reverses ? boxes.Reverse() : boxes)
            children.Add(new(world.Simulation.Shapes.Add(new Box(size.X, size.Y, size.Z)), new RigidPose(center)));
        world.Simulation.Statics.Add(new StaticDescription(RigidPose.Identity, world.AddCluster(children)));
        return world;
    }

    static (int Contacts, int Patches) Count(ClusterWorld world, BodyHandle body)
    {
        var (contacts, patches) = (0, 0);
        foreach (var constraint in world.Simulation.Bodies[body].Constraints)
        {
            contacts += ConstraintTypeIds.ContactCount(world.Simulation.Solver.Locations[constraint.ConnectingConstraintHandle.Slot].TypeId);
            ++patches;
        }
        return (contacts, patches);
    }

    static readonly (Vector3, Vector3)[] One = [(new(4, 1, 4), new(0, -.5f, 0))];
    static readonly (Vector3, Vector3)[] Two = [(new(2, 1, 4), new(-1, -.5f, 0)), (new(2, 1, 4), new(1, -.5f, 0))];

    static readonly (Vector3, Vector3)[] Corner =
        [(new(4, 1, 4), new(0, -.5f, 0)), (new(1, 4, 4), new(-1.5f, 2, 0)), (new(4, 4, 1), new(0, 2, -1.5f))];

    /// <summary>A box on the seam of two flush boxes has four contacts at its corners, as on one, and holds a column as that does.</summary>
    [Fact]
    public void A_box_on_two_flush_boxes_rests_as_on_one()
    {
        using var one = Create(1, One);
        using var two = Create(1, Two);
        BodyHandle[] bodies = new BodyHandle[6];
        foreach (var world in new[] { one, two })
        {
            for (int i = 0; i < bodies.Length; ++i)
                bodies[i] = world.AddBody(new Box(.5f, .5f, .5f), new RigidPose(new Vector3(.1f, .25f + .5f * i, .2f)));
        }
        for (int i = 0; i < 180; ++i)
        {
            one.Step();
            two.Step();
        }
        Assert.Equal((4, 2), (Count(two, bodies[5]).Contacts, Count(two, bodies[0]).Patches));
        foreach (var body in bodies)
        {
            var (a, b) = (one.Simulation.Bodies[body].Pose, two.Simulation.Bodies[body].Pose);
            Assert.InRange((a.Position - b.Position).Length(), 0, 2e-5f);
            Assert.InRange((a.Orientation - b.Orientation).Length(), 0, 2e-5f);
        }
        Assert.Equal(Count(one, bodies[0]), Count(two, bodies[0]));
    }

    [Fact]
    public void A_ball_bounces_on_a_seam_as_beside_it()
    {
        using var one = Create(1, One);
        using var two = Create(1, Two);
        var heights = new[] { one, two }.Select(world =>
        {
            world.Behaviour.Restitution = .6f;
            var body = world.AddBody(new Sphere(.2f), new RigidPose(new Vector3(1e-4f, 1, 0)));
            var highest = 0f;
            for (int i = 0; i < 60; ++i)
            {
                world.Step();
                var bounced = i > 25;
                highest = Math.Max(highest, bounced ? world.Simulation.Bodies[body].Pose.Position.Y : 0);
            }
            return highest;
        }).ToArray();
        Assert.InRange(heights[0], .4f, .8f);
        Assert.Equal(heights[0], heights[1], 1e-4f);
    }

    [Fact]
    public void A_box_in_a_corner_of_three_planes_rests()
    {
        using var world = Create(1, Corner);
        var body = world.AddBody(new Box(.5f, .5f, .5f), new RigidPose(new Vector3(-.745f, .26f, -.745f), Quaternion.CreateFromAxisAngle(Vector3.UnitY, .02f)),
            new BodyVelocity(new Vector3(-1, 0, -1)));
        var most = 0;
        for (int i = 0; i < 180; ++i)
        {
            world.Step();
            var (contacts, patches) = Count(world, body);
            most = Math.Max(most, patches);
            Assert.InRange(contacts, 0, 8);
            Assert.InRange(patches, 0, 4);
        }
        Assert.Equal(3, most);
        var velocity = world.Simulation.Bodies[body].Velocity;
        // The box weighs one kilogram.
        var energy = .5f * velocity.Linear.LengthSquared() + .5f * .5f * .5f / 6 * velocity.Angular.LengthSquared();
        Assert.InRange(energy, 0, 1e-6f);
    }

    [Fact]
    public void The_order_of_children_changes_no_contacts()
    {
        using var rising = Create(1, Corner);
        using var falling = Create(1, Corner, reverses: true);
        var pose = new RigidPose(new Vector3(-.751f, .2485f, -.752f), Quaternion.Identity);
        var contacts = new[] { rising, falling }.Select(world =>
        {
            List<(Vector3, Vector3, float)> seen = [];
            world.AddBody(new Box(.5f, .5f, .5f), pose);
            world.Behaviour.Configure = manifold =>
            {
                var nonconvex = (NonconvexContactManifold)manifold;
                for (int i = 0; i < nonconvex.Count; ++i)
                    seen.Add((nonconvex.GetOffset(i), nonconvex.GetNormal(i), nonconvex.GetDepth(i)));
                return null;
            };
            world.Step();
            return seen.ToHashSet();
        }).ToArray();
        Assert.Equal(8, contacts[0].Count);
        Assert.Equal(contacts[0], contacts[1]);
    }

    /// <summary>The tangent of the slope is a little less than the coefficient of friction, or a little more.</summary>
    [Theory, InlineData(.98f, true), InlineData(1.02f, false)]
    public void Friction_holds_on_a_split_slope_as_on_one(float part, bool holds)
    {
        using var world = Create(1, Two);
        var angle = MathF.Atan(.5f * part);
        // The slope is the direction of gravity: the floor stays as it is.
        var turn = Quaternion.CreateFromAxisAngle(Vector3.UnitZ, angle);
        world.Simulation.Statics.Remove(new StaticHandle(0));
        var half = world.Simulation.Shapes.Add(new Box(2, 1, 4));
        world.Simulation.Statics.Add(new StaticDescription(new RigidPose(default, turn), world.AddCluster(
            [new(half, new RigidPose(new Vector3(-1, -.5f, 0))), new(half, new RigidPose(new Vector3(1, -.5f, 0)))])));
        var body = world.AddBody(new Box(.5f, .2f, .5f), new RigidPose(Vector3.Transform(new Vector3(0, .1f, 0), turn), turn));
        for (int i = 0; i < 120; ++i)
            world.Step();
        var speed = world.Simulation.Bodies[body].Velocity.Linear.Length();
        // What is left of gravity after two seconds on the steeper slope.
        var slides = 2 * 10 * MathF.Cos(angle) * .5f * .02f;
        if (holds)
            Assert.InRange(speed, 0, .01f * slides);
        else
            Assert.InRange(speed, .9f * slides, 1.1f * slides);
    }

    static ClusterWorld CreateHeap(int threads, ClusterOrder order)
    {
        var world = Create(threads, Corner.Concat(Two.Select(box => (box.Item1, box.Item2 + new Vector3(2.5f, -.2f, 0)))));
        world.Rules.Order = order;
        for (int i = 0; i < 30; ++i)
        {
            var pose = new RigidPose(new Vector3(-.6f + i % 5 * .5f, .4f + i / 5 * .5f, -.5f + i % 3 * .4f), Quaternion.CreateFromAxisAngle(Vector3.UnitX, i));
            if (i % 3 == 0)
                world.AddBody(new Box(.4f, .3f, .5f), pose);
            else if (i % 3 == 1)
                world.AddBody(new Sphere(.2f), pose);
            else
                world.AddBody(new Cylinder(.2f, .3f), pose);
        }
        return world;
    }

    [Fact]
    public void Threads_and_order_change_nothing()
    {
        using var first = CreateHeap(1, ClusterOrder.Rising);
        using var second = CreateHeap(3, ClusterOrder.Falling);
        using var third = CreateHeap(2, ClusterOrder.Shuffled);
        for (int i = 0; i < 200; ++i)
        {
            first.Step();
            second.Step();
            third.Step();
            Assert.Equal(first.State(), second.State());
            Assert.Equal(first.State(), third.State());
        }
    }

    [Fact]
    public void Steps_make_no_garbage()
    {
        using var world = CreateHeap(1, ClusterOrder.Rising);
        for (int i = 0; i < 200; ++i)
            world.Step(validate: false);
        Assert.Equal(0, Garbage.Of(() =>
        {
            for (int i = 0; i < 60; ++i)
                world.Step(validate: false);
        }));
    }

    /// <summary>
    /// What is pinched between a floor and a sheet, and is thinner than it is deep in the floor, is still pushed down by the sheet: the way up leads through.
    /// </summary>
    [Fact]
    public void Nobody_yields_to_what_points_the_other_way()
    {
        using var world = Create(1, [(new(4, 1, 4), new(0, -.5f, 0)), (new(4, 5e-4f, 4), new(0, -1.35e-3f, 0))]);
        // From 2.5 to 1.5 mm below the floor, of which .1 mm is in the sheet.
        world.AddBody(new Box(.5f, 1e-3f, .5f), new RigidPose(new Vector3(0, -2e-3f, 0)));
        var normals = NormalsOfStep(world);
        Assert.Contains(normals, normal => normal.Y > .999f);
        Assert.Contains(normals, normal => normal.Y < -.999f);
    }

    /// <summary>
    /// A leg that is 5 mm deep in the floor says nothing of a wall of 4 mm that the other leg is at: that is hit, as it would be in a moment when the body
    /// has tilted back.
    /// </summary>
    [Fact]
    public void A_leg_does_not_yield_to_what_another_stands_on()
    {
        using var world = Create(1, [(new(1, 1, 1), new(-1, -.5f, 0)), (new(.4f, 1, 1), new(1.299f, -.501f, 0))]);
        var leg = world.Simulation.Shapes.Add(new Box(.2f, .2f, .2f));
        var legs = world.AddCluster([new(leg, new RigidPose(new Vector3(-1, .095f, 0))), new(leg, new RigidPose(new Vector3(1, .095f, 0)))]);
        world.Simulation.Bodies.Add(BodyDescription.CreateDynamic(new Vector3(0), new Box(2, .2f, .2f).ComputeInertia(1), legs, -1f));
        var normals = NormalsOfStep(world);
        Assert.Contains(normals, normal => normal.Y > .999f);
        Assert.Contains(normals, normal => normal.X < -.999f);
    }

    // Of the patches of a pair that has several.
    static List<Vector3> NormalsOfStep(ClusterWorld world)
    {
        List<Vector3> normals = [];
        world.Behaviour.Configure = manifold =>
        {
            if (manifold is NonconvexContactManifold several)
            {
                for (int i = 0; i < several.Count; ++i)
                    normals.Add(several.GetNormal(i));
            }
            return null;
        };
        world.Step();
        return normals;
    }
}
