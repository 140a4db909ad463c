using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Demos.Accuracy;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.FastBodies;

/// <summary>What is marked leaves no closed room, also where others throw it against a wall within a step, that was not on its way.</summary>
public class ClosedRoomTests
{
    static readonly bool isFull = Environment.GetEnvironmentVariable("PHYSICS_FULL_TESTS") is { Length: > 0 };
    const float Speed = 150;

    public static TheoryData<Flyer, RoomWalls, int> Cases
    {
        get
        {
            var data = new TheoryData<Flyer, RoomWalls, int>();
            foreach (var flyer in Enum.GetValues<Flyer>())
            {
                foreach (var walls in Enum.GetValues<RoomWalls>())
                {
                    foreach (int rate in (int[])[60, 240])
                        data.Add(flyer, walls, rate);
                }
            }
            return data;
        }
    }

    /// <summary>Nobody leaves, and energy is not made of collisions without restitution.</summary>
    [Theory]
    [MemberData(nameof(Cases))]
    public void NobodyLeaves(Flyer flyer, RoomWalls walls, int rate)
    {
        var (count, size, seeds) = isFull ? (500, 10f, 5) : (125, 5f, flyer == Flyer.Ball ? 3 : 1);
        for (int seed = 1; seed <= seeds; ++seed)
        {
            using var room = new ClosedRoom(flyer, walls, count, size, Speed, seed);
            var before = room.Energy;
            room.Step(isFull ? 60 : 20, 1f / rate);
            Assert.Equal(0, room.OutsideCount);
            Assert.InRange(room.Energy, 0, before);
        }
    }

    /// <summary>A ball that rests, and is foreseen to meet no wall, is shot at one by another ball within the step.</summary>
    [Theory]
    [InlineData(.3f)]
    [InlineData(1)]
    [InlineData(2)]
    public void ABallThatIsShotStopsAtTheNextWall(float distance)
    {
        const float radius = .1f;
        var ball = new Sphere(radius);
        using var world = new TestWorld(new AccuracySettings { Gravity = default, Friction = 0 });
        world.AddStatic(new Box(.02f, 10, 10), new RigidPose(new Vector3(.01f, 0, 0)));
        var struck = world.AddMarked(ball, 1, new Vector3(-radius - distance, 0, 0), default);
        var striking = world.AddMarked(ball, 1, new Vector3(-radius - distance - .5f, 0, 0), new Vector3(300, 0, 0));
        world.Step(3);
        // Without restitution both end at the wall, one behind the other, as nothing is left that comes back.
        Assert.InRange(world.Bodies[struck].Pose.Position.X, -radius - .1f * radius, -radius + .1f * radius);
        Assert.InRange(world.Bodies[striking].Pose.Position.X, -3 * radius - .2f * radius, -3 * radius + .2f * radius);
    }

    /// <summary>Two that are both thrown out of their ways meet, though neither has been foreseen where they do.</summary>
    [Fact]
    public void TwoThatAreThrownAsideMeet()
    {
        const float radius = .1f;
        var ball = new Sphere(radius);
        using var world = new TestWorld(new AccuracySettings { Gravity = default, Friction = 0 });
        // Two that rest, and two that strike them: each goes on at 300 m/s towards the other, 5 m in a step.
        var left = world.AddMarked(ball, 1, new Vector3(-1, 0, 0), default);
        var right = world.AddMarked(ball, 1, new Vector3(1, 0, 0), default);
        world.AddMarked(ball, 1, new Vector3(-1.4f, 0, 0), new Vector3(600, 0, 0));
        world.AddMarked(ball, 1, new Vector3(1.4f, 0, 0), new Vector3(-600, 0, 0));
        world.Step(2);
        var (a, b) = (world.Bodies[left].Pose.Position.X, world.Bodies[right].Pose.Position.X);
        Assert.True(a < b, $"{a} and {b} have passed each other.");
    }

    /// <summary>
    /// Two fly one behind the other, as fast, so that nobody watches them; a post stops the first one, within the bounds that it has had from the beginning.
    /// The second one passes the post by a centimetre, and meets the first.
    /// </summary>
    [Fact]
    public void WhoIsStoppedIsMetByWhoFollows()
    {
        const float radius = .1f;
        var ball = new Sphere(radius);
        using var world = new TestWorld(new AccuracySettings { Gravity = default, Friction = 0 });
        world.AddStatic(new Box(1, 1, 1), new RigidPose(new Vector3(.5f, -.49f, 0)));
        // Not at once: in the first step with fast pairs nobody knows yet who is slow.
        world.AddMarked(ball, 1, new Vector3(100, 0, 0), new Vector3(150, 0, 0));
        world.AddMarked(ball, 1, new Vector3(110, 0, 0), new Vector3(-150, 0, 0));
        var first = Follow(world, ball, new Vector3(-3.1f, 0, 0));
        var second = Follow(world, ball, new Vector3(-3.8f, .12f, 0));
        world.Step(2);
        Assert.InRange(world.Bodies[first].Pose.Position.X, -radius - .1f * radius, radius);
        // It left the line at which it would have gone on.
        Assert.True(world.Bodies[second].Pose.Position.Y > .13f, $"{world.Bodies[second].Pose.Position}");
    }

    // Nothing is foreseen of who is more than a centimetre away.
    static BodyHandle Follow(TestWorld world, in Sphere ball, Vector3 position) => world.Bodies.Add(BodyDescription.CreateDynamic(
        position, new BodyVelocity(new Vector3(150, 0, 0)), ball.ComputeInertia(1),
        new CollidableDescription(world.Simulation.Shapes.Add(ball), .01f, ContinuousDetection.Continuous()), -1));

    /// <summary>Pairs that are found within a step do not depend on threads.</summary>
    [Fact]
    public void ThreadsDoNotShow()
    {
        var expected = HashesOf(1);
        foreach (int threads in (int[])[2, 3, 5])
            Assert.Equal(expected, HashesOf(threads));
    }

    static List<ulong> HashesOf(int threads)
    {
        using var room = new ClosedRoom(Flyer.Box, RoomWalls.Boxes, 125, 5, Speed, 7, threads);
        var hashes = new List<ulong>();
        for (int i = 0; i < 8; ++i)
        {
            room.Step(1, TestWorld.Dt);
            hashes.Add(room.Simulation.StateHash());
        }
        return hashes;
    }
}
