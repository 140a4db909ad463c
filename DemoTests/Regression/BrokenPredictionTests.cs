using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuUtilities.Memory;
using Demos.Fuzz;
using Xunit;

namespace DemoTests.Regression;

/// <summary>
/// An integrator that throws while bounds are predicted leaves some of them written. The tree did not contain them, so that it was not valid and queries
/// missed bodies until the next step.
/// </summary>
public class BrokenPredictionTests
{
    [Theory]
    [InlineData(1)]
    [InlineData(2)]
    [InlineData(3)]
    [InlineData(5)]
    public void TheTreeContainsTheBoundsThatWereWritten(int callsBefore)
    {
        using var pool = new BufferPool();
        var plan = new FuzzPlan();
        using var simulation = Simulation.Create(pool, new FuzzNarrowPhaseCallbacks(plan),
            new FuzzPoseIntegratorCallbacks(plan, AngularIntegrationMode.ConserveMomentum), new SolveDescription(1, 2));
        var sphere = new Sphere(0.5f);
        var shape = simulation.Shapes.Add(sphere);
        for (int i = 0; i < 100; ++i)
        {
            simulation.Bodies.Add(BodyDescription.CreateDynamic(new Vector3(3 * i, i % 7, i % 5),
                new BodyVelocity(new Vector3(-20, 30, 40)), sphere.ComputeInertia(1), shape, new(0.01f)));
        }
        simulation.Timestep(1 / 60f);
        var hash = simulation.StateHash();

        plan.Do(callsBefore, () => throw new FuzzCallbackException());
        Assert.ThrowsAny<FuzzCallbackException>(() => simulation.Timestep(0.1f));

        Assert.Equal(hash, simulation.StateHash());
        simulation.Validate();
        plan.Reset();
        simulation.Timestep(1 / 60f);
        simulation.Validate();
    }
}
