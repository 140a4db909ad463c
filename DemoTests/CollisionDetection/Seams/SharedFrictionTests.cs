using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using DemoTests.CollisionDetection.Children;
using Xunit;

namespace DemoTests.CollisionDetection.Seams;

/// <summary>Friction on several statics is that of one patch on one static.</summary>
public class SharedFrictionTests
{
    const float Gravity = 10, Friction = .5f, Width = .5f;

    // Four boxes that meet at the origin.
    static ClusterWorld Create(bool isOne)
    {
        var world = new ClusterWorld(isCluster: true);
        world.Behaviour.Friction = Friction;
        if (isOne)
            world.Simulation.Statics.Add(new StaticDescription(new Vector3(0, -.5f, 0), world.Simulation.Shapes.Add(new Box(16, 1, 16))));
        for (int i = 0; i < 4 && !isOne; ++i)
        {
            var place = new Vector3(i % 2 * 8 - 4, -.5f, i / 2 * 8 - 4);
            world.Simulation.Statics.Add(new StaticDescription(place, world.Simulation.Shapes.Add(new Box(8, 1, 8))));
        }
        return world;
    }

    static BodyHandle AddBox(ClusterWorld world, Vector3 linear, float spin) =>
        world.AddBody(new Box(Width, .1f, Width), new RigidPose(new Vector3(0, .05f, 0)), new BodyVelocity(linear, new Vector3(0, spin, 0)));

    /// <summary>
    /// Each of the four corners has a static of its own, so each constraint has one contact. Friction takes mu m g r from the spin, with r the way from the
    /// middle to a corner, and the box has m w^2 / 6.
    /// </summary>
    [Fact]
    public void A_box_that_spins_on_four_statics_stops_as_friction_says()
    {
        using var world = Create(isOne: false);
        var box = AddBox(world, default, 10);
        var deceleration = Friction * Gravity * (Width / MathF.Sqrt(2)) / (Width * Width / 6);
        for (int i = 1; i <= 60; ++i)
        {
            world.Step();
            var expected = Math.Max(0, 10 - deceleration * i / 60);
            // A step of friction: the load is there when the contacts have given way.
            Assert.InRange(world.Simulation.Bodies[box].Velocity.Angular.Y, expected - .05f * deceleration / 60, expected + deceleration / 60);
        }
        Assert.InRange(world.Simulation.Bodies[box].Velocity.Angular.Y, -1e-4f, 1e-4f);
    }

    [Theory]
    [InlineData(1, 0, 0), InlineData(1, .3f, 8), InlineData(.2f, -.5f, -15), InlineData(3, 1, 30)]
    public void A_box_that_slides_and_spins_does_as_on_one_static(float x, float z, float spin)
    {
        using var several = Create(isOne: false);
        using var one = Create(isOne: true);
        var (actual, expected) = (AddBox(several, new(x, 0, z), spin), AddBox(one, new(x, 0, z), spin));
        for (int i = 0; i < 90; ++i)
        {
            several.Step();
            one.Step();
            var (a, b) = (several.Simulation.Bodies[actual], one.Simulation.Bodies[expected]);
            // A fifth of what friction takes in a step: as the box turns, other contacts are chosen at another time.
            Assert.InRange((a.Velocity.Linear - b.Velocity.Linear).Length(), 0, .2f * Friction * Gravity / 60);
            Assert.InRange(Math.Abs(a.Velocity.Angular.Y - b.Velocity.Angular.Y), 0, .02f);
        }
    }

    /// <summary>On a slope below the angle of friction a box stays where it is; above it slides as it would on one static.</summary>
    [Theory, InlineData(.98f), InlineData(1.02f)]
    public void Four_statics_hold_as_much_as_one(float part)
    {
        var angle = MathF.Atan(part * Friction);
        using var world = new ClusterWorld(isCluster: true);
        world.Behaviour.Friction = Friction;
        var turn = Quaternion.CreateFromAxisAngle(Vector3.Normalize(new Vector3(.6f, 0, .8f)), angle);
        var floor = world.Simulation.Shapes.Add(new Box(8, 1, 8));
        for (int i = 0; i < 4; ++i)
        {
            var place = Vector3.Transform(new Vector3(i % 2 * 8 - 4, -.5f, i / 2 * 8 - 4), turn);
            world.Simulation.Statics.Add(new StaticDescription(new RigidPose(place, turn), floor));
        }
        var start = Vector3.Transform(new Vector3(0, .05f, 0), turn);
        var box = world.AddBody(new Box(Width, .1f, Width), new RigidPose(start, turn));
        for (int i = 0; i < 180; ++i)
            world.Step();
        var acceleration = Gravity * (MathF.Sin(angle) - Friction * MathF.Cos(angle));
        var expected = Math.Max(0, .5f * acceleration * 9);
        Assert.InRange((world.Simulation.Bodies[box].Pose.Position - start).Length(), expected * .95f - 1e-3f, expected * 1.05f + 1e-3f);
    }
}
