using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Xunit;

namespace DemoTests.Characters;

/// <summary>Characters that crouch and stand up where there is room, and what is no room.</summary>
public class CharacterShapeTests
{
    const float Low = 1, High = 2 * CharacterWorld.HalfHeight;

    static readonly Capsule crouching = new(0.3f, Low - 0.6f);

    [Theory, InlineData(false), InlineData(true)]
    public void It_crouches_under_a_ceiling_and_stands_up_behind_it(bool isAsleep)
    {
        using var world = new CharacterWorld();
        world.AddFloor();
        // From 1.2 m upwards.
        world.AddBox(new(0, 1.7f, -4), new(8, 1, 4));
        var body = world.Add(default);
        var (low, high) = (world.Simulation.Shapes.Add(crouching), world.Simulation.Bodies[body].Collidable.Shape);
        world.Step(isAsleep ? 300 : 30);
        Assert.Equal(isAsleep, !world.Simulation.Bodies[body].Awake);
        Assert.True(world.Characters.TryChangeShape(body, low));
        Assert.Equal(0, Bottom(Low), 2e-3f);
        for (int i = 0; i < 30; ++i)
        {
            world.Step();
            Assert.True(world[body].Supported);
        }
        Assert.Equal(0, Bottom(Low), 2e-3f);
        world[body].TargetVelocity = new(0, 2);
        world.Step(120);
        Assert.InRange(Position().Z, -5, -3);
        var before = world.Simulation.StateHash();
        Assert.False(world.Characters.TryChangeShape(body, high));
        Assert.Equal((before, low), (world.Simulation.StateHash(), world.Simulation.Bodies[body].Collidable.Shape));
        world.Step(120);
        Assert.InRange(Position().Z, -9, -6.3f);
        Assert.True(world.Characters.TryChangeShape(body, high));
        world.Step(30);
        Assert.Equal(0, Bottom(High), 2e-3f);
        Assert.Equal(2, world.Velocity(body).Length(), 1e-2f);
        world.Simulation.Validate();

        Vector3 Position() => world.Simulation.Bodies[body].Pose.Position;

        float Bottom(float height) => Position().Y - height / 2;
    }

    // Its front looks down, and the middle of who stands is behind it.
    [Fact]
    public void A_ceiling_that_is_a_skin_is_in_the_way()
    {
        using var world = new CharacterWorld();
        world.AddFloor();
        var corners = (Vector3[])[new(-5, 0, -5), new(5, 0, -5), new(-5, 0, 5), new(5, 0, 5)];
        var skin = world.Simulation.Shapes.Add(new Mesh(corners, [0, 2, 1, 1, 2, 3], Vector3.One, world.Pool));
        var ceiling = world.Simulation.Statics.Add(new StaticDescription(new Vector3(0, 0.75f, 0), skin));
        var body = world.Add(new(20, 0, 0));
        var (ball, high) = (world.Simulation.Shapes.Add(new Sphere(0.3f)), world.Simulation.Bodies[body].Collidable.Shape);
        Assert.True(world.Characters.TryChangeShape(body, ball));
        var reference = world.Simulation.Bodies[body];
        reference.Pose.Position = new(0, 0.3f, 0);
        reference.UpdateBounds();
        world.Step(2);
        Assert.False(world.Characters.TryChangeShape(body, high));
        world.Simulation.Statics.Remove(ceiling);
        world.Simulation.Shapes.RemoveAndDispose(skin, world.Pool);
        Assert.True(world.Characters.TryChangeShape(body, high));
    }

    [Fact]
    public void A_wall_that_it_leans_on_leaves_room_and_a_crate_on_its_head_does_not()
    {
        using var world = new CharacterWorld();
        world.AddFloor();
        world.AddBox(new(0, 1, -1.5f), new(10, 2, 1));
        var body = world.Add(default);
        var (low, high) = (world.Simulation.Shapes.Add(crouching), world.Simulation.Bodies[body].Collidable.Shape);
        Assert.True(world.Characters.TryChangeShape(body, low));
        world[body].TargetVelocity = new(0, 4);
        world.Step(60);
        Assert.Equal(-0.7f, world.Simulation.Bodies[body].Pose.Position.Z, 5e-3f);
        Assert.True(world.Characters.TryChangeShape(body, high));
        Assert.True(world.Characters.TryChangeShape(body, low));
        var crate = world.Simulation.Bodies.Add(BodyDescription.CreateConvexDynamic(
            new Vector3(0, 1.6f, -0.6f), 5, world.Simulation.Shapes, new Box(1, 1, 0.7f)));
        world.Step(2);
        Assert.False(world.Characters.TryChangeShape(body, high));
        world.Simulation.Events.SetSensor(crate, true);
        Assert.True(world.Characters.TryChangeShape(body, high));
    }

    [Fact]
    public void Shapes_that_are_not_convex_are_refused()
    {
        using var world = new CharacterWorld();
        var body = world.Add(default);
        Assert.ThrowsAny<ArgumentException>(() => world.Characters.TryChangeShape(body, new TypedIndex(Sphere.TypeId, 99)));
        Assert.Throws<ArgumentException>(() => world.Characters.TryChangeShape(body, new TypedIndex(Triangle.TypeId, 0)));
        Assert.Throws<ArgumentException>(() => world.Characters.TryChangeShape(new BodyHandle(77), world.Simulation.Bodies[body].Collidable.Shape));
    }
}
