using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using DemoTests.CollisionDetection.Children;
using DemoTests.Support;
using Xunit;

namespace DemoTests.CollisionDetection.Seams;

/// <summary>Bodies at the seams between separate statics: at rest, in corners, at lips, and what is told of them.</summary>
public class SeamRestTests
{
    static ClusterWorld CreateWithSeam(int threads = 1)
    {
        var world = new ClusterWorld(isCluster: true, threads);
        var shape = world.Simulation.Shapes.Add(new Box(4, 1, 8));
        foreach (var x in new[] { -2, 2 })
            world.Simulation.Statics.Add(new StaticDescription(new Vector3(x, -.5f, 0), shape));
        return world;
    }

    static BodyHandle AddSleeper<TShape>(ClusterWorld world, in TShape shape, Vector3 position) where TShape : unmanaged, IConvexShape =>
        world.Simulation.Bodies.Add(BodyDescription.CreateDynamic(position, shape.ComputeInertia(1), world.Simulation.Shapes.Add(shape), .01f));

    [Theory, InlineData(0f), InlineData(.1f), InlineData(.245f)]
    public void What_lies_across_a_seam_rests_and_sleeps_and_wakes_as_it_lay(float aside)
    {
        using var world = CreateWithSeam();
        var box = AddSleeper(world, new Box(.5f, .4f, .6f), new Vector3(aside, .21f, -2));
        var cylinder = AddSleeper(world, new Cylinder(.3f, .4f), new Vector3(aside, .21f, 0));
        var ball = AddSleeper(world, new Sphere(.2f), new Vector3(0, .2f, 2));
        for (int i = 0; i < 240; ++i)
            world.Step();
        foreach (var handle in new[] { box, cylinder, ball })
        {
            var body = world.Simulation.Bodies[handle];
            Assert.False(body.Awake, $"{handle} is awake");
            Assert.InRange(body.Pose.Position.Y, .1994f, .2f);
            Assert.InRange((body.Pose.Position - new Vector3(handle == ball ? 0 : aside, body.Pose.Position.Y, body.Pose.Position.Z)).Length(), 0, 1e-3f);
        }
        foreach (var handle in new[] { box, cylinder, ball })
            world.Simulation.Awakener.AwakenBody(handle);
        for (int i = 0; i < 10; ++i)
        {
            world.Step();
            foreach (var handle in new[] { box, cylinder, ball })
            {
                var velocity = world.Simulation.Bodies[handle].Velocity;
                Assert.InRange(velocity.Linear.Length() + velocity.Angular.Length(), 0, 2e-3f);
            }
        }
    }

    [Fact]
    public void A_stack_stands_on_a_seam()
    {
        using var world = CreateWithSeam();
        var stack = Enumerable.Range(0, 8).Select(i => AddSleeper(world, new Box(.5f, .5f, .5f), new Vector3(.07f, .25f + .5f * i, 0))).ToArray();
        for (int i = 0; i < 600; ++i)
            world.Step(validate: i % 20 == 0);
        for (int i = 0; i < stack.Length; ++i)
        {
            var body = world.Simulation.Bodies[stack[i]];
            Assert.False(body.Awake);
            Assert.InRange((body.Pose.Position - new Vector3(.07f, .25f + .5f * i, 0)).Length(), 0, 5e-3f);
        }
    }

    /// <summary>A floor and a wall that end in one edge, or one in the other.</summary>
    [Theory, InlineData(0f), InlineData(-1f)]
    public void A_ball_in_a_corner_touches_both(float wallBottom)
    {
        using var world = CreateWithSeam();
        // Friction of the wall would let the ball roll up.
        world.Behaviour.Friction = 0;
        var height = 2 - wallBottom;
        world.Simulation.Statics.Add(new StaticDescription(new Vector3(3, wallBottom + height / 2, 0), world.Simulation.Shapes.Add(new Box(2, height, 8))));
        var ball = world.AddBody(new Sphere(.3f), new RigidPose(new Vector3(.5f, .3f, 0)), new BodyVelocity(new Vector3(2, 0, 0)));
        var touchesBoth = 0;
        for (int i = 0; i < 120; ++i)
        {
            world.Step();
            var body = world.Simulation.Bodies[ball];
            Assert.InRange(body.Pose.Position.X, 0, 1.702f);
            Assert.InRange(body.Pose.Position.Y, .299f, .302f);
            touchesBoth += body.Pose.Position.X > 1.69f && world.Simulation.NarrowPhase.PairCount == 2 ? 1 : 0;
        }
        Assert.InRange(touchesBoth, 1, 120);
    }

    [Theory]
    [InlineData(SeamMover.Sphere, 1e-6f, true), InlineData(SeamMover.Sphere, 1e-5f, true), InlineData(SeamMover.Sphere, 1e-4f, true)]
    [InlineData(SeamMover.Box, 1e-6f, true), InlineData(SeamMover.Box, 1e-5f, true), InlineData(SeamMover.Box, 1e-4f, true)]
    [InlineData(SeamMover.Sphere, .05f, false), InlineData(SeamMover.Box, .05f, false), InlineData(SeamMover.Box, .01f, false)]
    public void A_lip_is_hit_if_it_is_one(SeamMover mover, float lip, bool isSmooth)
    {
        using var world = new ClusterWorld(isCluster: true);
        world.Behaviour.Friction = 0;
        var body = SeamMovers.Add(world, mover, 5);
        SeparateFloors.Add(world, SeparateFloor.Boxes, LevelSeeds.Of(1003), lip);
        world.Simulation.Bodies[body].Pose.Position.Y += lip;
        var (least, most) = (5f, 0f);
        for (int i = 0; i < 120; ++i)
        {
            world.Step();
            var velocity = world.Simulation.Bodies[body].Velocity.Linear;
            (least, most) = (Math.Min(least, velocity.X), Math.Max(most, velocity.Y));
        }
        if (isSmooth)
            Assert.InRange(least, 5 * (1 - 1e-3f), 5);
        else
            Assert.True(least < 4.5f || most > .3f, $"least speed {least}, greatest upward {most}");
    }

    static ClusterWorld CreateTraffic(int threads)
    {
        var world = new ClusterWorld(isCluster: true, threads);
        SeparateFloors.Add(world, SeparateFloor.Boxes, LevelSeeds.Of(1004));
        var movers = Enum.GetValues<SeamMover>().Where(mover => mover != SeamMover.TwoBoxes && mover != SeamMover.LargeSphere).ToArray();
        for (int i = 0; i < 30; ++i)
        {
            var body = SeamMovers.Add(world, movers[i % movers.Length], 1 + i % 7);
            world.Simulation.Bodies[body].Pose.Position += new Vector3(i / 3 * 1.5f, .05f * (i % 4), i % 3 * 1.2f - 1.2f);
        }
        return world;
    }

    [Fact]
    public void Any_number_of_threads_gives_the_same_bits()
    {
        using var expected = CreateTraffic(1);
        using var actual = CreateTraffic(3);
        for (int i = 0; i < 200; ++i)
        {
            expected.Step(validate: i % 10 == 0);
            actual.Step(validate: i % 10 == 0);
            Assert.Equal(expected.State(), actual.State());
        }
    }

    /// <summary>The parts of a floor that a ball rolls over begin and end to touch once, one after the other.</summary>
    [Fact]
    public void What_is_rolled_over_is_told_of_once()
    {
        using var world = new ClusterWorld(isCluster: true);
        var shape = world.Simulation.Shapes.Add(new Box(1, 1, 4));
        for (int i = 0; i < 12; ++i)
            world.Simulation.Statics.Add(new StaticDescription(new Vector3(i, -.5f, .1f), shape));
        var ball = world.AddBody(new Sphere(.3f), new RigidPose(new Vector3(0, .2999f, 0)), new BodyVelocity(new Vector3(3, 0, 0), new Vector3(0, 0, -10)));
        world.Simulation.Events.Listen(ball, EventMask.All);
        var (began, ended) = (new List<int>(), new List<int>());
        for (int i = 0; i < 180; ++i)
        {
            world.Step();
            foreach (ref readonly var contact in world.Simulation.Events.Began)
                began.Add(contact.Pair.B.StaticHandle.Slot);
            foreach (ref readonly var contact in world.Simulation.Events.Ended)
                ended.Add(contact.Pair.B.StaticHandle.Slot);
        }
        Assert.Equal(Enumerable.Range(0, began.Count), began);
        Assert.Equal(Enumerable.Range(0, ended.Count), ended);
        Assert.InRange(began.Count, 9, 10);
        Assert.Equal(began.Count - 1, ended.Count);
    }

    /// <summary>A game sees each pair as if it were alone.</summary>
    [Fact]
    public void Callbacks_see_pairs_as_if_alone()
    {
        var seen = new List<string>[2];
        for (int i = 0; i < 2; ++i)
        {
            using var world = CreateWithSeam();
            world.JoinsStatics = i == 0;
            var list = seen[i] = [];
            world.Behaviour.Configure = manifold =>
            {
                var convex = (ConvexContactManifold)manifold;
                list.Add($"{convex.Count} {convex.Normal} {convex.Contact0.Offset} {convex.Contact0.Depth}");
                return null;
            };
            world.AddBody(new Box(.5f, .5f, .5f), new RigidPose(new Vector3(-.24f, .2499f, 0)), new BodyVelocity(new Vector3(1, 0, 0)));
            world.Step();
        }
        Assert.Equal(2, seen[0].Count);
        Assert.Equal(seen[1], seen[0]);
    }
}
