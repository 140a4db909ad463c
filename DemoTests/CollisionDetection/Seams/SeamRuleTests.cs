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
    /// A lip that stands is none if it is low. One that comes along the floor is not the floor's: as its wall meets the edge of a cube, that moves on with
    /// it: at 5/8 of its speed at first, as a cube that stumbles keeps 3/8. Much faster ones turn it over.
    /// </summary>
    [Theory, InlineData(.5f), InlineData(1f)]
    public void A_low_bar_that_is_moved_along_a_floor_pushes(float speed)
    {
        using var world = Create();
        var shapes = world.Simulation.Shapes;
        world.Simulation.Statics.Add(new StaticDescription(new Vector3(0, -.5f, 0), shapes.Add(new Box(60, 1, 20))));
        // .2 mm above the floor: the tolerance of the cube is .25.
        var bar = AddKinematic(world, shapes.Add(new Box(1, 1, 2)), new Vector3(-.9f, -.4998f, 0), new Vector3(speed, 0, 0));
        var box = world.AddBody(new Box(.5f, .5f, .5f), new RigidPose(new Vector3(0, .2499f, 0)));
        var fastest = 0f;
        for (int i = 0; i < 40; ++i)
        {
            world.Step();
            fastest = Math.Max(fastest, world.Simulation.Bodies[box].Velocity.Linear.X);
        }
        var ahead = world.Simulation.Bodies[box].Pose.Position.X - world.Simulation.Bodies[bar].Pose.Position.X - .5f;
        output.WriteLine($"{speed}: fastest {fastest}, ahead {ahead}");
        Assert.InRange(fastest, .6f * speed, 1.2f * speed);
        Assert.InRange(ahead, 0, 2);
    }
}
