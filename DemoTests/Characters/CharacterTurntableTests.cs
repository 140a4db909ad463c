using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Xunit;

namespace DemoTests.Characters;

/// <summary>Characters on what turns: the velocity of the ground is another at each place.</summary>
public class CharacterTurntableTests
{
    // They took the tangent for the length of a step, and went outwards with w^2 r dt / 2: at 2 rad/s from 3 m to 5 within ten seconds.
    [Theory]
    [InlineData(.2f), InlineData(1), InlineData(2)]
    public void Who_stands_on_a_turntable_keeps_the_place(float turn)
    {
        using var world = new CharacterWorld();
        AddTurntable(world, turn);
        var body = world.Add(new Vector3(3, 0, 0));
        world.Simulation.Bodies[body].Velocity.Linear = new Vector3(0, 0, -3 * turn);

        for (int second = 1; second <= 20; ++second)
        {
            world.Step(60);
            var feet = world.Feet(body);
            Assert.InRange(MathF.Sqrt(feet.X * feet.X + feet.Z * feet.Z), 2.997f, 3.003f);
        }
    }

    // v = w x r + u, u at rest in the world, is a turn about c with w x c = -u.
    [Theory]
    [InlineData(.5f, 1, 0), InlineData(1, -.5f, 1.5f), InlineData(-1.5f, 0, 2)]
    public void Who_walks_on_a_turntable_goes_in_a_circle(float turn, float right, float forwards)
    {
        using var world = new CharacterWorld();
        AddTurntable(world, turn);
        var start = new Vector3(2, 0, -1);
        var body = world.Add(start);
        var walk = new Vector3(right, 0, -forwards);
        world.Simulation.Bodies[body].Velocity.Linear = Vector3.Cross(new Vector3(0, turn, 0), start) + walk;
        world[body].ViewDirection = new Vector3(0, 0, -1);
        world[body].TargetVelocity = new Vector2(right, forwards);
        var center = new Vector3(walk.Z, 0, -walk.X) / turn;

        for (int step = 1; step <= 300; ++step)
        {
            world.Step();
            var expected = center + Vector3.Transform(start - center, Quaternion.CreateFromAxisAngle(Vector3.UnitY, turn * step * CharacterWorld.Dt));
            // The speed is right from the second step on.
            Assert.InRange((world.Feet(body) - expected).Length(), 0, .01f);
        }
    }

    // A disc on an axle that a character walks round: what the one gains the other loses.
    [Fact]
    public void A_disc_turns_back_under_who_walks_on_it()
    {
        using var world = new CharacterWorld();
        var disc = new Cylinder(4, .5f);
        var table = world.Simulation.Bodies.Add(BodyDescription.CreateDynamic(
            new Vector3(0, -.25f, 0), disc.ComputeInertia(300), world.Simulation.Shapes.Add(disc), -1));
        var axle = world.Simulation.Bodies.Add(BodyDescription.CreateKinematic(new Vector3(0, -.25f, 0), new CollidableDescription(default), -1));
        world.Simulation.Solver.Add(axle, table, new BepuPhysics.Constraints.Hinge { LocalHingeAxisA = Vector3.UnitY, LocalHingeAxisB = Vector3.UnitY });
        var body = world.Add(new Vector3(2.5f, 0, 0));
        world[body].ViewDirection = new Vector3(0, 0, -1);
        world[body].TargetVelocity = new Vector2(0, 2);

        for (int step = 0; step < 60; ++step)
        {
            world.Step();
            var (place, velocity) = (world.Feet(body), world.Velocity(body));
            var walked = 70 * (place.Z * velocity.X - place.X * velocity.Z);
            var turned = .5f * 300 * 16 * world.Simulation.Bodies[table].Velocity.Angular.Y;
            Assert.InRange(walked + turned, -.5f, .5f);
        }
        Assert.True(world.Simulation.Bodies[table].Velocity.Angular.Y < -.08f);
    }

    static void AddTurntable(CharacterWorld world, float turn) => world.Simulation.Bodies.Add(BodyDescription.CreateKinematic(
        new Vector3(0, -.25f, 0), new BodyVelocity(default, new Vector3(0, turn, 0)), world.Simulation.Shapes.Add(new Cylinder(12, .5f)), -1));
}
