using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Demos.Accuracy;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Quality;

/// <summary>The examples of Docs/Guides/Nearby.md do what the page says.</summary>
public sealed class NearbyGuideTests : IDisposable
{
    readonly TestWorld world = new(new AccuracySettings());

    public void Dispose() => world.Dispose();

    [Theory]
    [InlineData(1.9f, false)]
    [InlineData(2.1f, true)]
    public void There_is_room_to_stand_up_under_a_ceiling_that_is_higher_than_the_capsule(float ceiling, bool expected)
    {
        world.AddStatic(new Box(10, 1, 10), new Vector3(0, ceiling + .5f, 0));
        world.AddStatic(new Box(10, 1, 10), new Vector3(0, -.5f, 0));

        // A capsule of 1.8 m, .1 m over the floor.
        Assert.Equal(expected, DocSamples.CanStand(world.Simulation, world.Pool, new(0, .5f, 0), new RigidPose(new(0, 1.1f - .05f, 0))));
    }

    [Fact]
    public void An_explosion_pushes_what_is_near_away_and_wakes_it()
    {
        var near = world.AddDynamic(new Sphere(.5f), 1, new RigidPose(new(2, 0, 0)));
        var far = world.AddDynamic(new Sphere(.5f), 1, new RigidPose(new(0, 7, 0)));
        var sleeper = world.Bodies[near];
        sleeper.Awake = false;

        DocSamples.Explode(world.Simulation, world.Pool, Vector3.Zero, 6, 40);

        Assert.True(world.Bodies[near].Awake);
        Assert.Equal(40 * (1 - 1.5f / 6), world.Bodies[near].Velocity.Linear.X, 1e-4f);
        Assert.Equal(Vector3.Zero, world.Bodies[far].Velocity.Linear);
    }

    [Fact]
    public void What_is_stuck_in_a_corner_gets_out()
    {
        world.AddStatic(new Box(10, 1, 10), new Vector3(0, -.5f, 0));
        world.AddStatic(new Box(1, 10, 10), new Vector3(-.5f, 5, 0));

        var place = DocSamples.GetOut(world.Simulation, world.Pool, new RigidPose(new(.3f, .8f, 0)));

        Assert.InRange(Vector3.Distance(new(.4f, .9f, 0), place), 0, 1e-5f);
    }
}
