using System;
using System.Numerics;
using BepuPhysics;
using Xunit;

namespace DemoTests.LoadPath;

/// <summary>The law that the stage rests on: whatever the pile, it takes kinetic energy out and puts none in.</summary>
sealed class EnergyLaw
{
    int substeps, lowered;

    /// <summary>Drops 25 boxes of many sizes and of masses from .1 to 10 kg on each other.</summary>
    /// <param name="random">What they are drawn by.</param>
    /// <param name="add">Receives the place, size and mass of each.</param>
    public static void DropPile(Random random, Action<Vector3, Vector3, float> add)
    {
        for (int i = 0; i < 25; ++i)
        {
            Vector3 size = new(Next(0.3f, 1), Next(0.3f, 1), Next(0.3f, 1));
            add(new Vector3(Next(-1, 1), 0.6f + i * 0.7f, Next(-1, 1)), size, MathF.Pow(10, Next(-1, 1)));
        }

        float Next(float least, float most) => least + (most - least) * random.NextSingle();
    }

    /// <summary>Requires the law of all substeps of a world.</summary>
    /// <param name="simulation">The world.</param>
    /// <param name="seed">By what a failure names it.</param>
    /// <param name="floor">Along with whom the observer moves; nobody if that is not said.</param>
    public void Watch(Simulation simulation, int seed, BodyHandle? floor = null)
    {
        KineticEnergy before = new(simulation.Bodies, floor), after = new(simulation.Bodies, floor);
        simulation.Solver.OptionalStages.Insert(0, before);
        simulation.Solver.OptionalStages.Add(after);
        simulation.Solver.SubstepEnded += substep =>
        {
            ++substeps;
            lowered += after.Last < before.Last ? 1 : 0;
            Assert.True(after.Last <= before.Last * (1 + 1e-6) + 1e-12, $"seed {seed}, substep {substep}: {before.Last} -> {after.Last} J");
        };
    }

    /// <summary>Requires that there was something to see.</summary>
    public void AssertDidSomething() =>
        Assert.True(lowered > substeps / 20, $"The stage did something in {lowered} of {substeps} substeps.");
}
