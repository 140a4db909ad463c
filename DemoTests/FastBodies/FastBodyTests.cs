using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Constraints;
using Demos.Accuracy;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.FastBodies;

/// <summary>What is marked as continuous hits what it should, goes on as it should, and is turned aside by nothing else.</summary>
public class FastBodyTests
{
    const float Dt = TestWorld.Dt;

    static AccuracySettings Weightless => new() { Gravity = default, Friction = 0 };

    /// <summary>The speed along the wall stays, that against it is turned by the coefficient, and no time is lost, wherever in a step the hit is.</summary>
    [Theory]
    [InlineData(0)]
    [InlineData(.5f)]
    [InlineData(1)]
    public void ABallBouncesWithoutLossOfTime(float restitution)
    {
        const float radius = .1f;
        for (int phase = 0; phase < 10; ++phase)
        {
            using var world = new TestWorld(Weightless, restitution: restitution);
            world.AddStatic(new Box(2000, .01f, 2000), new RigidPose(new Vector3(0, -.005f, 0)));
            var height = 20 + phase * .83f;
            var velocity = new Vector3(300, -400, 0);
            var ball = world.AddMarked(new Sphere(radius), 1, new RigidPose(new Vector3(0, height, 0)), new BodyVelocity(velocity));
            world.Step(60);
            var body = world.Bodies[ball];
            var hit = (height - radius) / 400;
            Assert.InRange(body.Velocity.Linear.Y, restitution * 400 - 4, restitution * 400 + 4);
            Assert.InRange(body.Velocity.Linear.X, 297, 303);
            Assert.InRange(body.Pose.Position.X, 297, 303);
            var expected = radius + restitution * 400 * (60 * Dt - hit);
            Assert.InRange(body.Pose.Position.Y, expected * .99f - .001f, expected * 1.01f + .001f);
        }
    }

    /// <summary>
    /// A ball that overlaps the first of two plates is hit before the substep begins, which moves it back by nothing; what that hit has changed is no part of
    /// that of the next substep, at the other plate.
    /// </summary>
    [Fact]
    public void ABallBetweenPlatesIsWhereItsBouncesTakeIt()
    {
        const float radius = .02f, overlap = 1e-3f, speed = 60;
        for (int phase = 0; phase < 10; ++phase)
        {
            using var world = new TestWorld(Weightless, restitution: 1);
            var way = speed * Dt / 4 * (1.1f + .08f * phase);
            world.AddStatic(new Box(1, 4, 4), new RigidPose(new Vector3(-.5f - radius, 0, 0)));
            world.AddStatic(new Box(1, 4, 4), new RigidPose(new Vector3(way + .5f + radius, 0, 0)));
            var ball = world.AddMarked(new Sphere(radius), 1, new Vector3(-overlap, 0, 0), new Vector3(-speed, 0, 0));
            world.Step();
            // There and back again, as often as it takes: a path that is folded at both plates.
            var folded = speed * Dt % (2 * way);
            var expected = folded < way ? folded : 2 * way - folded;
            // What is swept is thinner by a part of the radius.
            Assert.InRange(world.Bodies[ball].Pose.Position.X, expected - radius, expected + radius);
        }
    }

    /// <summary>What is passed by, at whatever distance, turns nothing aside.</summary>
    [Theory]
    [InlineData(.001f)]
    [InlineData(.01f)]
    [InlineData(.1f)]
    [InlineData(1)]
    public void ABallPassesCornersAndPosts(float distance)
    {
        const float radius = .1f;
        for (int phase = 0; phase < 10; ++phase)
        {
            using var world = new TestWorld(Weightless);
            // A table below its way, whose edge it flies over, a corner beside it, and two posts.
            world.AddStatic(new Box(4, 1, 4), new RigidPose(new Vector3(6, -.5f - radius - distance, 0)));
            world.AddStatic(new Box(2, 2, 2), new RigidPose(new Vector3(14, 0, 1 + radius + distance), Quaternion.Identity));
            world.AddStatic(new Cylinder(.05f, 3), new RigidPose(new Vector3(20, 0, .05f + radius + distance)));
            world.AddStatic(new Cylinder(.05f, 3), new RigidPose(new Vector3(20, 0, -.05f - radius - distance)));
            var ball = world.AddMarked(new Sphere(radius), 1, new RigidPose(new Vector3(-phase * .33f, 0, 0)), new BodyVelocity(new Vector3(200, 0, 0)));
            world.Step(12);
            var velocity = world.Bodies[ball].Velocity.Linear;
            Assert.InRange(velocity.X, 200 * (1 - 1e-6f), 200 * (1 + 1e-6f));
            Assert.InRange(velocity.Y, -2e-4f, 2e-4f);
            Assert.InRange(velocity.Z, -2e-4f, 2e-4f);
        }
    }

    // By how much the axis of b is ahead of that of a, along z, where one sees them cross; far ahead where they do not cross any more.
    static float AheadWhereTheyCross(in RigidPose a, in RigidPose b)
    {
        var (alongA, alongB) = (Vector3.Transform(Vector3.UnitX, a.Orientation), Vector3.Transform(Vector3.UnitX, b.Orientation));
        var between = b.Position - a.Position;
        // a + alongA s and b + alongB t are at one place of the x-y plane.
        var determinant = alongA.Y * alongB.X - alongA.X * alongB.Y;
        var s = (between.Y * alongB.X - between.X * alongB.Y) / determinant;
        var t = (between.Y * alongA.X - between.X * alongA.Y) / determinant;
        return MathF.Abs(s) < .5f && MathF.Abs(t) < .5f ? between.Z + alongB.Z * t - alongA.Z * s : 1;
    }

    /// <summary>Rods that cross near their middles do not pass each other.</summary>
    [Fact]
    public void CrossingRodsDoNotPass()
    {
        for (int phase = 0; phase < 20; ++phase)
        {
            using var world = new TestWorld(Weightless);
            var rod = new Box(1, .01f, .01f);
            var start = .3f + phase * .11f;
            var a = world.AddMarked(rod, 1, new RigidPose(new Vector3(.002f * phase - .02f, 0, -start)), new BodyVelocity(new Vector3(0, 0, 100)));
            var b = world.AddMarked(rod, 1, new RigidPose(new Vector3(0, .01f, start), Quaternion.CreateFromAxisAngle(Vector3.UnitZ, MathF.PI / 2)),
                new BodyVelocity(new Vector3(0, 0, -100)));
            for (int step = 0; step < 4; ++step)
            {
                world.Step();
                Assert.InRange(AheadWhereTheyCross(world.Bodies[a].Pose, world.Bodies[b].Pose), .005f, 10);
            }
            // What is left is little of what they had.
            Assert.InRange(world.Bodies[a].Velocity.Linear.Z, -10, 10);
        }
    }

    /// <summary>A chain that is thrown at a fence stays before it, and whole.</summary>
    [Fact]
    public void AChainThrownAtAFenceStaysBeforeIt()
    {
        using var world = new TestWorld();
        world.AddStatic(new Box(40, 2, 40), new RigidPose(new Vector3(0, -1, 0)));
        for (int i = -10; i <= 10; ++i)
            world.AddStatic(new Box(.02f, 4, .02f), new RigidPose(new Vector3(2, 2, i * .1f)));
        var links = new List<BodyHandle>();
        for (int i = 0; i < 4; ++i)
        {
            links.Add(world.AddMarked(new Capsule(.08f, .3f), 2, new RigidPose(new Vector3(0, .7f + i * .5f, 0)), new BodyVelocity(new Vector3(50, 0, 0))));
            if (i > 0)
            {
                world.Solver.Add(links[i - 1], links[i], new BallSocket
                {
                    LocalOffsetA = new Vector3(0, .25f, 0),
                    LocalOffsetB = new Vector3(0, -.25f, 0),
                    SpringSettings = SpringSettings.Rigid,
                });
            }
        }
        var greatest = 0f;
        for (int step = 0; step < 60; ++step)
        {
            world.Step();
            for (int i = 0; i < links.Count; ++i)
            {
                var pose = world.Bodies[links[i]].Pose;
                Assert.True(pose.Position.X < 2, $"link {i} is at {pose.Position} in step {step}");
                if (i == 0)
                    continue;
                var before = world.Bodies[links[i - 1]].Pose;
                greatest = MathF.Max(greatest, Vector3.Distance(
                    before.Position + Vector3.Transform(new Vector3(0, .25f, 0), before.Orientation),
                    pose.Position + Vector3.Transform(new Vector3(0, -.25f, 0), pose.Orientation)));
            }
        }
        // A quarter of a link's thickness.
        Assert.InRange(greatest, 0, .04f);
    }

    /// <summary>A hit is told in the step in which it is, and wakes what sleeps.</summary>
    [Fact]
    public void AHitIsToldAndWakes()
    {
        using var world = new TestWorld(Weightless);
        var box = new Box(1, 1, 1);
        var target = world.Bodies.Add(BodyDescription.CreateDynamic(
            new Vector3(10, 0, 0), box.ComputeInertia(10), world.Simulation.Shapes.Add(box), new BodyActivityDescription(.01f)));
        world.Step(60);
        Assert.False(world.Bodies[target].Awake);
        var ball = world.AddMarked(new Sphere(.05f), 1, new RigidPose(Vector3.Zero), new BodyVelocity(new Vector3(400, 0, 0)));
        world.Simulation.Events.Listen(ball, EventMask.All);
        // 9.45 m at 400 m/s: in the second step.
        world.Step();
        Assert.Equal(0, world.Simulation.Events.Began.Length);
        world.Step();
        Assert.Equal(1, world.Simulation.Events.Began.Length);
        Assert.True(world.Bodies[target].Awake);
        // Inelastic: both have the common velocity.
        Assert.InRange(world.Bodies[target].Velocity.Linear.X, 400f / 11 * .99f, 400f / 11 * 1.01f);
    }

    /// <summary>What a game removes between detection and solver is not swept: there is no such body any more.</summary>
    [Fact]
    public void AWallMayBeRemovedBeforeItIsHit()
    {
        using var world = new TestWorld(Weightless);
        var wall = world.AddStatic(new Box(.01f, 4, 4), new RigidPose(new Vector3(3, 0, 0)));
        var velocity = new BodyVelocity(new Vector3(400, 0, 0), new Vector3(9, 40, 0));
        var other = world.AddMarked(new Box(1, .01f, .01f), 1, new RigidPose(new Vector3(0, 3, 0)), velocity);
        var rod = world.AddMarked(new Box(1, .01f, .01f), 1, default(Vector3), velocity);
        ((DefaultTimestepper)world.Simulation.Timestepper).CollisionsDetected += (_, _) =>
        {
            if (world.Statics.StaticExists(wall))
                world.Statics.Remove(wall);
            if (world.Bodies.BodyExists(other))
                world.Bodies.Remove(other);
        };
        world.Step(3);
        Assert.False(world.Bodies.BodyExists(other));
        // Its contact may hold it in that step, or not.
        Assert.InRange(world.Bodies[rod].Pose.Position.X, 2, 20.1f);
        Assert.InRange(world.Bodies[rod].Velocity.Linear.Length(), 0, 400.1f);
    }
}
