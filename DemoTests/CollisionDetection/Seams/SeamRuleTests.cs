using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using DemoTests.CollisionDetection.Children;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.CollisionDetection.Seams;

/// <summary>What agrees with what: only contacts with what moves alike.</summary>
public class SeamRuleTests(ITestOutputHelper output)
{
    static ClusterWorld Create()
    {
        var world = new ClusterWorld(isCluster: true);
        world.Behaviour.Friction = 0;
        return world;
    }

    static BodyHandle AddKinematic(ClusterWorld world, TypedIndex shape, Vector3 place, Vector3 velocity) =>
        world.Simulation.Bodies.Add(BodyDescription.CreateKinematic(place, new BodyVelocity(velocity), shape, -1f));

    /// <summary>
    /// Half on a floor and half on the plates of a belt beside it, which moves the other way: without friction it goes on as it was. The belt is lower by less
    /// than the tolerance, so that what comes first is the floor, whose normal the walls of the plates may not take.
    /// </summary>
    [Theory, InlineData(1f), InlineData(5f)]
    public void The_seams_of_a_belt_beside_a_floor_are_not_felt(float speed)
    {
        using var world = Create();
        var shapes = world.Simulation.Shapes;
        var plate = shapes.Add(new Box(1, 1, 4));
        world.Simulation.Statics.Add(new StaticDescription(new Vector3(0, -.5f, -10), shapes.Add(new Box(60, 1, 20))));
        for (int i = 0; i < 24; ++i)
            AddKinematic(world, plate, new Vector3(i - 6, -.50002f, 2), new Vector3(-2, 0, 0));
        var box = world.AddBody(new Box(.5f, .5f, .5f), new RigidPose(new Vector3(.1f, .2499f, .05f)), new BodyVelocity(new Vector3(speed, 0, 0)));
        for (int i = 0; i < 60; ++i)
        {
            world.Step();
            var velocity = world.Simulation.Bodies[box].Velocity;
            Assert.InRange((velocity.Linear - new Vector3(speed, 0, 0)).Length(), 0, 1e-2f);
            Assert.InRange(velocity.Angular.Length(), 0, 1e-2f);
        }
    }

    /// <summary>
    /// A lip that stands is none if it is low. One that comes along the floor is not the floor's: a cube stumbles over it as over a wall. As the bar sees it,
    /// the cube comes at its speed, keeps 3/8 of that, turning about the edge that it was hit at, and falls back with as much: it is pushed to 5/8 of
    /// the speed of the bar, and leaves it at 11/8. What a step of gravity takes is missing.
    /// </summary>
    [Theory]
    [InlineData(1f, 2e-4f), InlineData(1f, 1e-3f), InlineData(1f, 5e-3f), InlineData(1f, .02f)]
    [InlineData(2f, 2e-4f), InlineData(2f, 1e-3f), InlineData(2f, 5e-3f), InlineData(2f, .02f)]
    public void A_bar_that_is_moved_along_a_floor_pushes_as_a_wall_is_hit(float speed, float lip)
    {
        const float Half = .25f;
        // Of the lip, .2 mm is less than the tolerance of the cube.
        var (pushed, fastest, _) = Push(speed, lip);
        var height = Half - lip;
        var kept = height * height / (4 * Half * Half / 6 + Half * Half + height * height);
        Assert.InRange(pushed / speed, .98f * (1 - kept), 1.02f * (1 - kept));
        Assert.InRange(fastest / speed, .97f * (1 + kept), 1 + kept);
    }

    /// <summary>Slower than that it does not stumble, but is pushed all the same.</summary>
    [Fact]
    public void A_low_bar_that_is_moved_slowly_pushes()
    {
        var (_, fastest, ahead) = Push(.5f, 2e-4f);
        Assert.InRange(fastest, .6f * .5f, 1.2f * .5f);
        Assert.InRange(ahead, 0, 2);
    }

    // Speeds of the cube a step after it was hit, and at most; how far it is before the bar.
    (float Pushed, float Fastest, float Ahead) Push(float speed, float lip)
    {
        using var world = Create();
        var shapes = world.Simulation.Shapes;
        world.Simulation.Statics.Add(new StaticDescription(new Vector3(0, -.5f, 0), shapes.Add(new Box(60, 1, 20))));
        var bar = AddKinematic(world, shapes.Add(new Box(1, 1, 2)), new Vector3(-.9f, lip - .5f, 0), new Vector3(speed, 0, 0));
        var box = world.AddBody(new Box(.5f, .5f, .5f), new RigidPose(new Vector3(0, .2499f, 0)));
        var (pushed, fastest, wasHit) = (0f, 0f, false);
        for (int i = 0; i < 60; ++i)
        {
            world.Step();
            var along = world.Simulation.Bodies[box].Velocity.Linear.X;
            pushed = wasHit && pushed == 0 ? along : pushed;
            wasHit |= along > .05f * speed;
            fastest = Math.Max(fastest, along);
        }
        var ahead = world.Simulation.Bodies[box].Pose.Position.X - world.Simulation.Bodies[bar].Pose.Position.X - .5f;
        output.WriteLine($"{speed} m/s, lip {lip}: pushed {pushed}, fastest {fastest}, ahead {ahead}");
        return (pushed, fastest, ahead);
    }
}
