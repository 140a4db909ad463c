using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.Regression;

/// <summary>
/// The default threshold of sleep grew with the square of a shape's size, for turning too: a wheel of 20 m radius stood still that turned by a radian a
/// second, a box of 10 m that drifted at .6 m/s, and a load of that size hung where it turned back.
/// </summary>
public sealed class LargeSleeperTests : IDisposable
{
    readonly BufferPool pool = new();

    public void Dispose() => pool.Dispose();

    Simulation Create(Vector3 gravity) =>
        Simulation.Create(pool, new DefaultNarrowPhaseCallbacks(), new DefaultPoseIntegratorCallbacks(gravity), new SolveDescription(1, 4));

    [Theory]
    [InlineData(1, .2f), InlineData(5, .2f), InlineData(20, .2f), InlineData(20, 1), InlineData(100, .5f)]
    public void ALargeWheelGoesOnTurning(float radius, float speed)
    {
        using var simulation = Create(Vector3.Zero);
        var wheel = simulation.Bodies.Add(BodyDescription.CreateConvexDynamic(
            Vector3.Zero, new BodyVelocity(default, new Vector3(0, speed, 0)), 1000, simulation.Shapes, new Cylinder(radius, radius / 4)));

        for (int i = 0; i < 120; ++i)
            simulation.Timestep(1 / 60f);

        Assert.True(simulation.Bodies[wheel].Awake);
        Assert.InRange(simulation.Bodies[wheel].Velocity.Angular.Y, speed * .999f, speed * 1.001f);
    }

    [Theory]
    [InlineData(1, .15f), InlineData(10, .15f), InlineData(10, .6f), InlineData(50, 2)]
    public void ALargeBoxDriftsOn(float size, float speed)
    {
        using var simulation = Create(Vector3.Zero);
        var box = simulation.Bodies.Add(BodyDescription.CreateConvexDynamic(
            Vector3.Zero, new BodyVelocity(new Vector3(speed, 0, 0)), 1000, simulation.Shapes, new Box(size, size, size)));

        for (int i = 0; i < 120; ++i)
            simulation.Timestep(1 / 60f);

        Assert.InRange(simulation.Bodies[box].Pose.Position.X, speed * 1.999f, speed * 2.001f);
    }

    [Theory]
    [InlineData(1), InlineData(4), InlineData(10)]
    public void ALoadSwingsBack(float size)
    {
        const float angle = .1f;
        using var simulation = Create(new Vector3(0, -9.81f, 0));
        var hook = simulation.Bodies.Add(BodyDescription.CreateKinematic(default(Vector3), new CollidableDescription(default), -1));
        var length = 3 * size;
        var box = new Box(size, size, size);
        var load = simulation.Bodies.Add(BodyDescription.CreateConvexDynamic(
            new Vector3(length * MathF.Sin(angle), -length * MathF.Cos(angle), 0), 100, simulation.Shapes, box));
        simulation.Solver.Add(hook, load, new CenterDistanceConstraint(length, SpringSettings.Rigid));

        // Half of its period: to the other side.
        var half = (int)(MathF.PI * MathF.Sqrt(length / 9.81f) * 60);
        for (int i = 0; i < half; ++i)
            simulation.Timestep(1 / 60f);

        Assert.InRange(simulation.Bodies[load].Pose.Position.X, -1.02f * length * angle, -.95f * length * angle);
    }

    [Fact]
    public void WhatIsLargeAndRestsFallsAsleep()
    {
        using var simulation = Create(new Vector3(0, -9.81f, 0));
        simulation.Statics.Add(new StaticDescription(new Vector3(0, -5, 0), simulation.Shapes.Add(new Box(1000, 10, 1000))));
        var boxes = new BodyHandle[4];
        for (int i = 0; i < boxes.Length; ++i)
        {
            boxes[i] = simulation.Bodies.Add(BodyDescription.CreateConvexDynamic(
                new Vector3(0, 10.5f + 21 * i, 0), 1000, simulation.Shapes, new Box(20, 20, 20)));
        }

        for (int i = 0; i < 600; ++i)
            simulation.Timestep(1 / 60f);

        Assert.All(boxes, box => Assert.False(simulation.Bodies[box].Awake));
    }
}
