using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Xunit;

namespace DemoTests.Characters;

/// <summary>What a character does on ground, slopes, steps and things that move, by the laws of its forces.</summary>
public class CharacterWalkTests
{
    const float Dt = CharacterWorld.Dt, Gravity = CharacterWorld.Gravity;

    [Fact]
    public void It_gathers_speed_by_its_force_and_stops_by_it()
    {
        using var world = new CharacterWorld();
        world.AddFloor();
        var body = world.Add(default);
        world.Step(30);
        world[body].TargetVelocity = new(3, 4);
        // 20 m/s2 for a tenth of a second, and 5 m/s after a quarter.
        world.Step(6);
        Assert.Equal(2, world.Velocity(body).Length(), 0.02f);
        world.Step(24);
        Assert.True((world.Velocity(body) - new Vector3(3, 0, -4)).Length() < 1e-3f, $"{world.Velocity(body)}");
        world[body].TargetVelocity = default;
        world.Step(16);
        Assert.True(world.Velocity(body).Length() < 1e-3f);
    }

    [Fact]
    public void Forwards_is_where_it_looks()
    {
        using var world = new CharacterWorld();
        world.AddFloor();
        var body = world.Add(default);
        world.Step(10);
        world[body].TargetVelocity = new(0, 2);
        world[body].ViewDirection = new(5, -3, 0);
        world.Step(30);
        Assert.True((world.Velocity(body) - new Vector3(2, 0, 0)).Length() < 1e-3f, $"{world.Velocity(body)}");
    }

    [Theory, InlineData(5), InlineData(3)]
    public void A_jump_goes_as_high_as_its_speed_takes_it(float speed)
    {
        using var world = new CharacterWorld();
        world.AddFloor();
        var body = world.Add(default);
        world.Step(30);
        world[body].JumpVelocity = speed;
        world[body].TryJump = true;
        float height = 0;
        for (int i = 0; i < 75; ++i)
        {
            world.Step();
            height = Math.Max(height, world.Feet(body).Y);
            Assert.False(world[body].TryJump);
        }
        // Four substeps a step, each of which takes gravity before it moves: half a substep of the speed is lost. The top may lie between two steps.
        var expected = speed * speed / (2 * Gravity) - speed * Dt / 8;
        Assert.InRange(height, expected - 0.5f * Gravity * Dt * Dt / 4 - 2e-3f, expected + 2e-3f);
        Assert.True(world[body].Supported);
    }

    [Fact]
    public void It_does_not_jump_off_the_air()
    {
        using var world = new CharacterWorld();
        var body = world.Add(new(0, 5, 0));
        world[body].TryJump = true;
        world.Step(5);
        Assert.Equal(-Gravity * 5 * Dt, world.Velocity(body).Y, 1e-3f);
    }

    [Theory, InlineData(20), InlineData(40), InlineData(44)]
    public void On_a_slope_it_stands_and_walks_along_it_up_and_down(float degrees)
    {
        using var world = new CharacterWorld();
        var body = AddOnSlope(world, degrees);
        world.Step(30);
        var place = world.Feet(body);
        world.Step(120);
        Assert.True((world.Feet(body) - place).Length() < 1e-3f);
        world[body].TargetVelocity = new(0, 3);
        world.Step(60);
        Assert.Equal(3, world.Velocity(body).Length(), 0.01f);
        Assert.True(world.Velocity(body).Y > 1);
        // Downhill, faster than gravity could follow, it stays on the ground.
        world[body].TargetVelocity = new(0, -6);
        for (int i = 0; i < 60; ++i)
        {
            world.Step();
            Assert.True(world[body].Supported);
        }
        Assert.Equal(6, world.Velocity(body).Length(), 0.02f);
    }

    [Theory, InlineData(46), InlineData(60)]
    public void From_a_slope_that_is_too_steep_it_slides(float degrees)
    {
        using var world = new CharacterWorld();
        var body = AddOnSlope(world, degrees);
        world[body].TargetVelocity = new(0, 3);
        world[body].MaximumStepHeight = 0.4f;
        world.Step(60);
        // A second without friction.
        Assert.Equal(Gravity * MathF.Sin(degrees * MathF.PI / 180), world.Velocity(body).Length(), 0.2f);
        Assert.True(world.Velocity(body).Y < 0);
    }

    static BodyHandle AddOnSlope(CharacterWorld world, float degrees)
    {
        var orientation = Quaternion.CreateFromAxisAngle(Vector3.UnitX, degrees * MathF.PI / 180);
        var normal = Vector3.Transform(Vector3.UnitY, orientation);
        world.AddBox(normal * -0.5f, new(100, 1, 100), orientation);
        return world.Add(normal * 0.3f + new Vector3(0, -0.3f, 0));
    }

    [Theory]
    [InlineData(0.2f, 0.3f, 1f)]
    [InlineData(0.2f, 0.3f, 3f)]
    [InlineData(0.3f, 0.3f, 4f)]
    [InlineData(0.39f, 0.5f, 3f)]
    public void It_goes_up_stairs_at_about_the_pace_of_walking_and_down_again(float rise, float tread, float speed)
    {
        using var world = new CharacterWorld();
        world.AddFloor();
        world.AddStairs(rise, tread, -2);
        var body = world.Add(default);
        world[body].MaximumStepHeight = 0.4f;
        world[body].TargetVelocity = new(0, speed);
        var steps = 0;
        for (; world.Feet(body).Z > -2 - 9 * tread - 1; ++steps)
        {
            world.Step();
            Assert.True(steps < 60 * 20, $"{world.Feet(body)}");
            Assert.True(world.Feet(body).Y < 10 * rise + 0.05f);
        }
        Assert.Equal(10 * rise, world.Feet(body).Y, 5e-3f);
        Assert.InRange(steps * Dt * speed, 0, 1.5f * (3 + 9 * tread));
        world[body].TargetVelocity = new(0, -speed);
        int unsupported = 0;
        steps = 0;
        for (; world.Feet(body).Z < 0; ++steps)
        {
            world.Step();
            Assert.True(steps < 60 * 20, $"{world.Feet(body)}");
            unsupported += world[body].Supported ? 0 : 1;
        }
        // Let down from step to step: a fall from each would take it off the ground for two thirds of the time and more.
        Assert.True(unsupported < 0.2f * steps, $"{unsupported} of {steps}");
        Assert.Equal(0, world.Feet(body).Y, 2e-3f);
    }

    [Theory, InlineData(0.41f, 0.4f), InlineData(0.2f, 0f)]
    public void It_does_not_go_up_what_is_higher_than_its_steps(float rise, float height)
    {
        using var world = new CharacterWorld();
        world.AddFloor();
        world.AddStairs(rise, 0.5f, -2);
        var body = world.Add(default);
        world[body].MaximumStepHeight = height;
        world[body].TargetVelocity = new(0, 3);
        world.Step(180);
        Assert.True(world.Feet(body).Y < 1e-3f, $"{world.Feet(body)}");
    }

    [Fact]
    public void It_does_not_step_up_under_a_ceiling()
    {
        using var world = new CharacterWorld();
        world.AddFloor();
        world.AddBox(new(0, 0.15f, -3), new(4, 0.3f, 2));
        world.AddBox(new(0, 2.5f, -3), new(4, 1, 2));
        var body = world.Add(default);
        world[body].MaximumStepHeight = 0.4f;
        world[body].TargetVelocity = new(0, 3);
        world.Step(120);
        // 1.7 m are left above the step, and it is 1.8 m high.
        Assert.True(world.Feet(body).Y < 0.25f && world.Feet(body).Z > -2.1f, $"{world.Feet(body)}");
    }

    // A sensor is no step, and nothing that stands inside of one has to stay there.
    [Fact]
    public void Sensors_do_not_keep_it_from_going_up_a_step()
    {
        using var world = new CharacterWorld();
        world.AddFloor();
        world.AddBox(new(0, 0.15f, -3), new(4, 0.3f, 2));
        world.Simulation.Events.SetSensor(world.AddBox(new(0, 1, -3), new(8, 4, 8)), true);
        var body = world.Add(default);
        world[body].MaximumStepHeight = 0.4f;
        world[body].TargetVelocity = new(0, 3);
        world.Step(60);
        Assert.Equal(0.3f, world.Feet(body).Y, 5e-3f);
    }

    [Fact]
    public void In_the_air_it_is_steered_by_its_force_up_to_its_goal_and_never_braked()
    {
        using var world = new CharacterWorld();
        var body = world.Add(default);
        world[body].TargetVelocity = new(1, 0);
        world.Step(30);
        Assert.Equal(0, world.Velocity(body).X);
        // 1 m/s2 for half a second.
        world[body].MaximumAirForce = 70;
        world.Step(30);
        Assert.Equal(0.5f, world.Velocity(body).X, 1e-4f);
        world.Step(60);
        Assert.Equal(1, world.Velocity(body).X, 1e-5f);
        world[body].TargetVelocity = new(0.2f, 0);
        world.Step(10);
        Assert.Equal(1, world.Velocity(body).X, 1e-5f);
        world[body].TargetVelocity = default;
        world.Step(10);
        Assert.Equal(1, world.Velocity(body).X, 1e-5f);
        Assert.Equal(-Gravity * 140 * Dt, world.Velocity(body).Y, 1e-2f);
    }

    [Fact]
    public void It_goes_round_with_a_turning_platform()
    {
        using var world = new CharacterWorld();
        const float Speed = 0.5f;
        var platform = world.Simulation.Bodies.Add(BodyDescription.CreateKinematic(
            new RigidPose(new Vector3(0, -0.5f, 0)), new BodyVelocity(new Vector3(0.3f, 0.2f, 0), new Vector3(0, Speed, 0)),
            world.Simulation.Shapes.Add(new Box(20, 1, 20)), -1));
        var body = world.Add(new(3, 0, 0));
        world.Step(60);
        var from = Relative();
        world.Step(120);
        var to = Relative();
        var angle = MathF.Atan2(-to.Z, to.X) - MathF.Atan2(-from.Z, from.X);
        Assert.Equal(Speed * 2, angle, 0.01f);
        Assert.Equal(from.Length(), to.Length(), 0.05f);

        Vector3 Relative()
        {
            var offset = world.Feet(body) - world.Simulation.Bodies[platform].Pose.Position;
            return offset with { Y = 0 };
        }
    }

    [Fact]
    public void What_it_stands_on_is_pushed_back()
    {
        using var world = new CharacterWorld(friction: 0);
        world.AddFloor();
        var plank = new Box(6, 0.2f, 2);
        var raft = world.Simulation.Bodies.Add(BodyDescription.CreateDynamic(
            new Vector3(0, 0.1f, 0), new BodyInertia { InverseMass = 1 / 140f }, world.Simulation.Shapes.Add(plank), -1));
        var body = world.Add(new(0, 0.2f, 0));
        world.Step(30);
        world[body].TargetVelocity = new(1.5f, 0);
        world.Step(40);
        // Relative to each other 1.5 m/s, and no momentum in all.
        Assert.Equal(1.5f, world.Velocity(body).X - world.Velocity(raft).X, 0.02f);
        Assert.True(MathF.Abs(70 * world.Velocity(body).X + 140 * world.Velocity(raft).X) < 0.5f, $"{world.Velocity(body)} {world.Velocity(raft)}");
    }

    [Fact]
    public void It_pushes_with_its_force()
    {
        using var world = new CharacterWorld(friction: 0);
        world.AddFloor();
        var crate = new Box(1, 1, 1);
        var heavy = world.Simulation.Bodies.Add(BodyDescription.CreateDynamic(
            new Vector3(0, 0.5f, -0.81f), new BodyInertia { InverseMass = 1 / 630f }, world.Simulation.Shapes.Add(crate), -1));
        var body = world.Add(default);
        world.Step(30);
        world[body].TargetVelocity = new(0, 10);
        world.Step(60);
        // 1400 N on 700 kg for a second, less what the way to it took.
        Assert.InRange(-world.Velocity(heavy).Z, 1.8f, 2.05f);
    }

    [Fact]
    public void It_falls_asleep_and_wakes_when_it_is_to_do_something()
    {
        using var world = new CharacterWorld();
        world.AddFloor();
        var body = world.Add(default);
        world.Step(300);
        Assert.False(world.Simulation.Bodies[body].Awake);
        Assert.True(world[body].Supported);
        world[body].TargetVelocity = new(1, 0);
        world.Step(30);
        Assert.Equal(1, world.Velocity(body).X, 1e-3f);
        world[body].TargetVelocity = default;
        world.Step(300);
        Assert.False(world.Simulation.Bodies[body].Awake);
        world[body].TryJump = true;
        world.Step();
        Assert.True(world.Velocity(body).Y > 4.5f);
    }
}
