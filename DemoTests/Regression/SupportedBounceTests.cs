using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Constraints;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.Regression;

/// <summary>
/// A body that rests on another has the velocity of a fall of one substep when bounces are made, as the solver has not yet said that it rests. What fell on it
/// was sent back slower by (1 + e) times that: from a box of a thousand tonnes on the ground to .60 m of a metre at e = .8 instead of .64.
/// </summary>
public class SupportedBounceTests
{
    const float Dt = 1 / 60f;

    [Theory]
    [InlineData(.3f, 1, false), InlineData(.8f, 1, false), InlineData(.8f, 3, false), InlineData(.8f, 1, true), InlineData(1, 2, false)]
    public void WhatRestsSendsBackAsTheGroundDoes(float restitution, int plates, bool sleeps)
    {
        for (int i = 0; i < 4; ++i)
        {
            var height = 1 + i * .0531f;
            Assert.InRange(Rebound(restitution, plates, sleeps, height) - Rebound(restitution, 0, sleeps, height), -1e-3f, 1e-3f);
        }
    }

    static float Rebound(float restitution, int plates, bool sleeps, float height)
    {
        const float Radius = .25f;
        using var pool = new BufferPool();
        using var simulation = Create(pool, restitution, .5f);
        var plate = new Box(6, 1, 6);
        var shape = simulation.Shapes.Add(plate);
        simulation.Statics.Add(new StaticDescription(new Vector3(0, -.5f - plates, 0), shape));
        for (int i = 0; i < plates; ++i)
        {
            simulation.Bodies.Add(BodyDescription.CreateDynamic(
                new Vector3(0, .5f + i - plates, 0), plate.ComputeInertia(1e6f), shape, sleeps ? .01f : -1));
        }
        for (int step = 0; step < 60; ++step)
            simulation.Timestep(Dt);
        var ball = simulation.Bodies.Add(BodyDescription.CreateConvexDynamic(
            new Vector3(.3f, Radius + height, .2f), 1, simulation.Shapes, new Sphere(Radius)));
        float previous = 0;
        for (int step = 0; step < 120 && simulation.Bodies[ball].Velocity.Linear.Y <= previous; ++step)
        {
            previous = simulation.Bodies[ball].Velocity.Linear.Y;
            simulation.Timestep(Dt);
        }
        // Where the parabola ends that it is on.
        var speed = simulation.Bodies[ball].Velocity.Linear.Y;
        return simulation.Bodies[ball].Pose.Position.Y - Radius + speed * speed / (2 * 9.81f);
    }

    // Nothing is lost where nothing is rubbed off, and nothing is gained.
    [Fact]
    public void BallsThatBounceOnLooseStonesKeepTheirEnergy()
    {
        using var pool = new BufferPool();
        using var simulation = Create(pool, 1, 0);
        var wall = simulation.Shapes.Add(new Box(20, 20, 1));
        simulation.Statics.Add(new StaticDescription(new Vector3(0, -10, 0), simulation.Shapes.Add(new Box(20, 20, 20))));
        for (int side = 0; side < 4; ++side)
        {
            var turn = Quaternion.CreateFromAxisAngle(Vector3.UnitY, side * MathF.PI / 2);
            simulation.Statics.Add(new StaticDescription(Vector3.Transform(new Vector3(0, 10, 3), turn), turn, wall));
        }
        var stone = new Box(1.6f, .5f, 4.9f);
        for (int i = 0; i < 3; ++i)
            simulation.Bodies.Add(BodyDescription.CreateConvexDynamic(new Vector3(-1.65f + i * 1.65f, .25f, 0), 1e6f, simulation.Shapes, stone));
        for (int step = 0; step < 30; ++step)
            simulation.Timestep(Dt);
        var ball = new Sphere(.25f);
        var balls = new BodyHandle[6];
        for (int i = 0; i < balls.Length; ++i)
        {
            balls[i] = simulation.Bodies.Add(BodyDescription.CreateConvexDynamic(
                new Vector3(-1.6f + i * .64f, 2 + i * .7f, (i % 3 - 1) * 1.3f), 1, simulation.Shapes, ball));
        }
        var before = Energy();

        for (int step = 0; step < 600; ++step)
        {
            simulation.Timestep(Dt);
            // A parabola in steps is that much off, at most where it turns back.
            Assert.InRange(Energy() / before, .98f, 1.01f);
        }

        float Energy()
        {
            float energy = 0;
            foreach (var body in balls)
            {
                var reference = simulation.Bodies[body];
                energy += .5f * reference.Velocity.Linear.LengthSquared() + 9.81f * (reference.Pose.Position.Y - .75f);
            }
            return energy;
        }
    }

    static Simulation Create(BufferPool pool, float restitution, float friction) => Simulation.Create(
        pool, new DefaultNarrowPhaseCallbacks(new PairMaterialProperties(friction, 2, SpringSettings.Rigid)) { Surface = new() { Restitution = restitution } },
        new DefaultPoseIntegratorCallbacks(), new SolveDescription(1, 4));
}
