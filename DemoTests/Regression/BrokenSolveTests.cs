using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuUtilities.Memory;
using Demos.Fuzz;
using DemoTests.Robustness;
using Xunit;

namespace DemoTests.Regression;

/// <summary>
/// An integrator that throws ends a substep in the middle. What constraints had made of velocities by then was not looked at any more, so that a body
/// was left with a velocity that is NaN, and nothing said so.
/// </summary>
public class BrokenSolveTests
{
    // More than one bundle of any width: a bundle is looked at before the callback of its bodies is called.
    const int BodyCount = 40;
    // More than a step makes, whatever the width: all moments are tried.
    const int MaximumCalls = 100;

    [Theory]
    [InlineData(0)]
    [InlineData(1)]
    public void WhatConstraintsHaveRuinedIsStoppedWhereverTheStepBreaksOff(int relaxations)
    {
        var broken = 0;
        var broughtDown = 0;
        for (int callsBefore = 0; callsBefore < MaximumCalls; ++callsBefore)
        {
            using var pool = new BufferPool();
            var plan = new FuzzPlan();
            using var simulation = Simulation.Create(
                pool, new FuzzNarrowPhaseCallbacks(plan), new FuzzPoseIntegratorCallbacks(plan, AngularIntegrationMode.ConserveMomentum),
                new SolveDescription(1, 4) { RelaxationIterationCount = relaxations });
            BodyHandle last = default;
            for (int i = 0; i < BodyCount; ++i)
            {
                var pose = new RigidPose(new Vector3(3 * i, 0, 0));
                last = simulation.Bodies.Add(BodyDescription.CreateDynamic(pose, new Sphere(1).ComputeInertia(1), default(TypedIndex), .01f));
            }
            simulation.Solver.Add(last, new Poison { Factor = float.NaN });

            plan.Do(callsBefore, () => throw new FuzzCallbackException());
            if (Record.Exception(() => simulation.Timestep(1 / 60f)) is not null)
                ++broken;

            simulation.Validate();
            foreach (var stopped in simulation.Quarantine.Bodies)
                Assert.Equal(last, stopped);
            broughtDown += simulation.Quarantine.Count;
        }
        Assert.InRange(broken, 1, MaximumCalls - 1);
        Assert.InRange(broughtDown, MaximumCalls - broken + 1, MaximumCalls);
    }
}
