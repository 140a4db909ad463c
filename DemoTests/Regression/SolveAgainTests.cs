using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.Regression;

/// <summary>
/// A game that calls the stages of a step by itself removed a body and solved again. Pairs that bounce were linked as they had been before: one of them
/// bounced twice, or, in larger worlds, a list of pairs led back to itself and the call never returned.
/// </summary>
public class SolveAgainTests
{
    const float Dt = 1 / 60f, Speed = 5, Radius = .5f;

    [Theory]
    [InlineData(1)]
    [InlineData(4)]
    public void WhatBouncesIsLinkedAnewWhereABodyWasRemoved(int substeps)
    {
        using var pool = new BufferPool();
        using var simulation = Bouncing(pool, substeps);
        // The first one meets the floor when half of the step is solved, the others when all of it is. Gaps are those at collision detection each time.
        var first = Add(simulation, 0, .1f * Speed * Dt);
        BodyHandle[] others = [Add(simulation, 3, .8f * Speed * Dt), Add(simulation, 6, .8f * Speed * Dt), Add(simulation, 9, .9f * Speed * Dt)];
        simulation.PredictBoundingBoxes(Dt);
        simulation.CollisionDetection(Dt);
        simulation.Solve(.5f * Dt);
        Assert.Equal(Speed, simulation.Bodies[first].Velocity.Linear.Y, 1e-4f);

        simulation.Bodies.Remove(first);
        simulation.Solve(Dt);

        foreach (var body in others)
            Assert.Equal(Speed, simulation.Bodies[body].Velocity.Linear.Y, 1e-4f);
        simulation.Validate();
    }

    /// <summary>
    /// Pairs that bounce referred to the bodies of a constraint that had fallen asleep since they were found, whose indices in the sleeping set are anybody's
    /// in the active one, or nobody's.
    /// </summary>
    [Theory]
    [InlineData(1)]
    [InlineData(4)]
    public void WhatBouncesIsForgottenWhereItIsPutToSleep(int substeps)
    {
        using var pool = new BufferPool();
        using var simulation = Bouncing(pool, substeps);
        BodyHandle[] others = [Add(simulation, 0, .8f * Speed * Dt), Add(simulation, 3, .8f * Speed * Dt)];
        var sleepers = new BodyHandle[6];
        for (int i = 0; i < sleepers.Length; ++i)
            sleepers[i] = Add(simulation, 6 + 3 * i, .1f * Speed * Dt);
        simulation.PredictBoundingBoxes(Dt);
        simulation.CollisionDetection(Dt);
        SetAwake(simulation, sleepers, false);
        simulation.Solve(Dt);

        foreach (var body in others)
            Assert.Equal(Speed, simulation.Bodies[body].Velocity.Linear.Y, 1e-4f);
        foreach (var body in sleepers)
            Assert.False(simulation.Bodies[body].Awake);
        simulation.Validate();

        // Awake again they bounce, found anew.
        SetAwake(simulation, sleepers, true);
        foreach (var body in sleepers)
            simulation.Bodies[body].Velocity = new(new Vector3(0, -Speed, 0));
        simulation.Timestep(Dt);
        foreach (var body in sleepers)
            Assert.Equal(Speed, simulation.Bodies[body].Velocity.Linear.Y, 1e-4f);
    }

    static void SetAwake(Simulation simulation, BodyHandle[] bodies, bool isAwake)
    {
        foreach (var body in bodies)
        {
            var reference = simulation.Bodies[body];
            reference.Awake = isAwake;
        }
    }

    static Simulation Bouncing(BufferPool pool, int substeps)
    {
        var simulation = Simulation.Create(
            pool, new DefaultNarrowPhaseCallbacks { Surface = new() { Restitution = 1 }, Material = new(0, 2, SpringSettings.Rigid) },
            new DefaultPoseIntegratorCallbacks(Vector3.Zero), new SolveDescription(1, substeps));
        simulation.Statics.Add(new StaticDescription(new Vector3(0, -1, 0), simulation.Shapes.Add(new Box(100, 2, 100))));
        return simulation;
    }

    static BodyHandle Add(Simulation simulation, float x, float height)
    {
        var ball = new Sphere(Radius);
        return simulation.Bodies.Add(BodyDescription.CreateDynamic(new Vector3(x, Radius + height, 0), new BodyVelocity(new Vector3(0, -Speed, 0)),
            ball.ComputeInertia(1), simulation.Shapes.Add(ball), -1));
    }
}
