using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Quality;

/// <summary>The code of Docs/Guides/Events.md does what the page says.</summary>
public sealed class EventGuideTests
{
    [Fact]
    public void LayersEventsAndSensorsWorkAsTheGuideSays()
    {
        using var world = new TestWorld();
        var simulation = world.Simulation;
        var ground = world.AddStatic(new Box(50, 2, 50), new RigidPose(new Vector3(0, -1, 0)));
        var zone = world.AddStatic(new Box(4, 1, 4), new RigidPose(new Vector3(0, 3, 0)));
        var player = world.AddDynamic(new Box(1, 1, 1), 2, new RigidPose(new Vector3(0, 5, 0)));
        var ghost = world.AddDynamic(new Box(1, 1, 1), 2, new RigidPose(new Vector3(0, 5.2f, 0)));
        DocSamples.GiveLayers(simulation, ground, player, ghost);
        DocSamples.MakeZone(simulation, zone);
        var sounds = new List<(Vector3 Place, float Impulse)>();
        int standingOn = 0;
        int visits = 0;
        for (int i = 0; i < 120; ++i)
        {
            standingOn += DocSamples.Hear(simulation, player, (place, impulse) => sounds.Add((place, impulse)));
            foreach (ref readonly var contact in simulation.Events.Began)
                visits += contact.IsSensor ? 1 : 0;
        }
        // Both fell through the zone, and through each other, onto the ground.
        Assert.Equal(2, visits);
        Assert.InRange(simulation.Bodies[player].Pose.Position.Y, .4f, .6f);
        Assert.InRange(simulation.Bodies[ghost].Pose.Position.Y, .4f, .6f);
        // The zone is of the usual layers and no ground to stand on: its events have no normal. Landing takes 2 kg from 9.4 m/s to a little
        // over rest: what it sinks in is put right, and it hops by some centimetres.
        Assert.InRange(standingOn, 1, 3);
        Assert.InRange(sounds[0].Impulse, 18, 21.5f);
        Assert.InRange(sounds[0].Place.Y, -.2f, .2f);
    }

    [Fact]
    public void BodiesAreDrawnBetweenTheirPoses()
    {
        using var world = new TestWorld();
        var body = world.AddKinematic(new Sphere(1), RigidPose.Identity);
        world.Bodies[body].Velocity.Linear = new Vector3(60, 0, 0);
        world.Step();
        var drawn = new Dictionary<BodyHandle, RigidPose>();
        DocSamples.DrawBetween(world.Simulation, .004f, .016f, new BodyHandle[1], new RigidPose[1], drawn.Add);
        Assert.Equal(.25f, drawn[body].Position.X, 1e-6f);
    }
}
