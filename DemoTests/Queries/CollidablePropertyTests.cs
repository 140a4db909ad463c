using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuUtilities.Memory;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Queries;

/// <summary>Values of a game's own, by handle.</summary>
public class CollidablePropertyTests
{
    [Fact]
    public void Each_body_and_static_has_a_value_of_its_own()
    {
        using var world = new TestWorld();
        var early = world.AddDynamic(new Sphere(1), 1, RigidPose.Identity);
        using var property = new CollidableProperty<int>(world.Simulation);
        property[early] = -1;
        for (int i = 0; i < 100; ++i)
        {
            property.Allocate(world.AddDynamic(new Sphere(1), 1, RigidPose.Identity)) = i;
            property.Allocate(world.AddStatic(new Sphere(1), RigidPose.Identity)) = 1000 + i;
        }

        Assert.Equal(-1, property[early]);
        for (int i = 0; i < 100; ++i)
        {
            Assert.Equal(i, property[new BodyHandle(i + 1)]);
            Assert.Equal(1000 + i, property[new StaticHandle(i)]);
            Assert.Equal(i, property[new CollidableReference(CollidableMobility.Dynamic, new BodyHandle(i + 1))]);
            Assert.Equal(1000 + i, property[new CollidableReference(new StaticHandle(i))]);
        }
    }

    [Fact]
    public void New_room_and_values_allocated_anew_hold_defaults()
    {
        using var world = new TestWorld();
        using var property = new CollidableProperty<Vector3>(world.Simulation);
        property.EnsureBodyCapacity(1000);
        Assert.Equal(Vector3.Zero, property[new BodyHandle(999)]);
        property[new BodyHandle(3)] = Vector3.One;
        Assert.Equal(Vector3.Zero, property.Allocate(new BodyHandle(3)));
        property.Allocate(new CollidableReference(new StaticHandle(5000))) = Vector3.One;
        Assert.Equal(Vector3.Zero, property[new StaticHandle(4999)]);
        property.CompactBodies();
        property.CompactStatics();
        Assert.Throws<ArgumentOutOfRangeException>(() => property[new StaticHandle(5000)]);
    }

    [Fact]
    public void There_is_room_for_what_the_simulation_has_room_for()
    {
        // As contact events that games copied from the Demos have it: made before there are bodies, written to without an allocation.
        using var world = new TestWorld();
        using var property = new CollidableProperty<int>(world.Simulation);
        for (int i = 0; i < 100; ++i)
        {
            property[world.AddDynamic(new Sphere(1), 1, RigidPose.Identity)] += i;
            property[world.AddStatic(new Sphere(1), RigidPose.Identity)] += 1000 + i;
        }
        Assert.Equal(99, property[new BodyHandle(99)]);
        Assert.Equal(1099, property[new StaticHandle(99)]);

        // As cars of games have it: the value of the body is kept at hand while those of its wheels are allocated.
        ref var body = ref property.Allocate(world.AddDynamic(new Sphere(1), 1, RigidPose.Identity));
        for (int i = 0; i < 4; ++i)
            property.Allocate(world.AddDynamic(new Sphere(1), 1, RigidPose.Identity)) = i;
        body = 7;
        Assert.Equal(7, property[new BodyHandle(100)]);

        using var wide = new TestWorld(sizes: new SimulationAllocationSizes { Bodies = 20_000, Statics = 3000 });
        using var many = new CollidableProperty<int>(wide.Simulation);
        Assert.Equal(0, many[new BodyHandle(19_999)]);
        Assert.Equal(0, many[new StaticHandle(2999)]);
    }

    [Fact]
    public void Handles_without_room_are_refused()
    {
        using var world = new TestWorld();
        using var property = new CollidableProperty<int>(world.Simulation);
        Assert.Throws<ArgumentOutOfRangeException>(() => property[new BodyHandle(100_000)]);
        Assert.Throws<ArgumentOutOfRangeException>(() => property[new BodyHandle(-1)]);
        Assert.Throws<ArgumentOutOfRangeException>(() => property[new StaticHandle(-1)]);
        Assert.Throws<ArgumentOutOfRangeException>(() => property.Allocate(new BodyHandle(-1)));
        Assert.Throws<ArgumentOutOfRangeException>(() => property.EnsureBodyCapacity(-1));
        Assert.Throws<InvalidOperationException>(() => property.Initialize(world.Simulation));
        Assert.Throws<InvalidOperationException>(() => new CollidableProperty<int>().Allocate(new BodyHandle(1)));
    }

    [Fact]
    public void Memory_comes_from_the_pool_that_was_named_and_goes_back_to_it()
    {
        using var world = new TestWorld();
        var pool = new BufferPool();
        var property = new CollidableProperty<long>(pool);
        property.Initialize(world.Simulation);
        property.Allocate(new BodyHandle(10)) = 3;
        Assert.Throws<InvalidOperationException>(pool.AssertEmpty);
        property.Dispose();
        property.Dispose();
        pool.AssertEmpty();
        pool.Clear();
    }
}
