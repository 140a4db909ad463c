using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Demos.Accuracy;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Quality;

/// <summary>What Docs/Guides/Rays.md shows works.</summary>
public sealed class RaysGuideTests : IDisposable
{
    readonly TestWorld world = new(new AccuracySettings { Contacts = ContactScope.None });

    public void Dispose() => world.Dispose();

    [Fact]
    public void Who_looks_sees_the_first_thing()
    {
        world.AddStatic(new Box(1, 1, 1), new Vector3(0, 0, 9));
        var near = world.AddStatic(new Box(1, 1, 1), new Vector3(0, 0, 5));

        var seen = DocSamples.Look(world.Simulation, world.Pool, default, Vector3.UnitZ);

        Assert.Equal(near, seen.Collidable.StaticHandle);
        Assert.Equal(new Vector3(0, 0, 4.5f), seen.Place);
    }

    [Fact]
    public void A_bullet_pushes_what_it_goes_through_until_a_wall()
    {
        var first = world.AddDynamic(new Sphere(.5f), 1, new Vector3(0, 0, 5));
        var second = world.AddDynamic(new Sphere(.5f), 1, new Vector3(0, 0, 7));
        world.AddStatic(new Box(4, 4, 1), new Vector3(0, 0, 10));
        var behind = world.AddDynamic(new Sphere(.5f), 1, new Vector3(0, 0, 15));

        var count = DocSamples.Shoot(world.Simulation, world.Pool, default, Vector3.UnitZ, 2, CollisionLayers.Everything);

        Assert.Equal(3, count);
        Assert.Equal(2, world.Bodies[first].Velocity.Linear.Z, 1e-6f);
        Assert.Equal(1, world.Bodies[second].Velocity.Linear.Z, 1e-6f);
        Assert.Equal(0, world.Bodies[behind].Velocity.Linear.Z);
    }

    [Fact]
    public void The_way_is_free_past_oneself_and_blocked_by_a_wall()
    {
        var self = new CollidableReference(CollidableMobility.Dynamic, world.AddDynamic(new Capsule(.4f, 1), 1, RigidPose.Identity));
        Assert.False(DocSamples.IsWayBlocked(world.Simulation, world.Pool, self, default, new Vector3(0, 0, 10)));

        world.AddStatic(new Box(4, 4, 1), new Vector3(0, 0, 5));

        Assert.True(DocSamples.IsWayBlocked(world.Simulation, world.Pool, self, default, new Vector3(0, 0, 10)));
        Assert.False(DocSamples.IsWayBlocked(world.Simulation, world.Pool, self, default, new Vector3(0, 0, 4)));
    }
}
