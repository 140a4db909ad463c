using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuUtilities.Memory;
using DemoTests.Support;
using Xunit;

namespace DemoTests.Robustness;

/// <summary>The ends of all scales at once, at the default setting: nothing that is not finite, and no energy from nowhere.</summary>
public class ExtremeTests
{
    // Greatest speed at which an overlap is taken out: what that may give a body is no gain.
    const float RecoverySpeed = 2;

    /// <summary>Bodies of 1 mm to 1 km and 1e-6 to 1e6 kg, at up to 1 km/s, near and far from the origin, in steps of 1/1000 to 1/15 s by lot.</summary>
    [Theory]
    [InlineData(1, 0)]
    [InlineData(2, 0)]
    [InlineData(3, 9.81f)]
    [InlineData(4, 9.81f)]
    [InlineData(5, 1000)]
    // Of 300 worlds at this gravity 61 gain more than a hundredth in a step (55 before what rests was moved out by its pose); this is one.
    [InlineData(6, 1000, .05)]
    // Of 1,200 worlds those in which what spun gained most while it began its substeps with the impulses of those before, up to 560,000 times.
    [InlineData(251, 0)]
    [InlineData(579, 0)]
    // What is crushed between masses of 1 and 1e10 is thrown out by 10,000 km/s, with more of the energy that pressed on it or less.
    [InlineData(233, 9.81f, .05)]
    [InlineData(251, 9.81f)]
    [InlineData(423, 9.81f)]
    [InlineData(579, 9.81f)]
    [InlineData(425, 100)]
    [InlineData(494, 100)]
    [InlineData(545, 100)]
    [InlineData(597, 100)]
    [InlineData(135, 1000)]
    // A column that sways, on whose top body another leaned: the load path read beyond its memory.
    [InlineData(237, 1000)]
    public void Sizes_masses_speeds_and_steps_of_all_scales(int seed, float gravity, double mostGained = .01)
    {
        using var pool = new BufferPool();
        using (var simulation = Simulation.Create(
            pool, new DefaultNarrowPhaseCallbacks(), new DefaultPoseIntegratorCallbacks(new Vector3(0, -gravity, 0)), SolveDescription.Default))
        {
            var random = new Random(seed);
            simulation.Statics.Add(new StaticDescription(new Vector3(0, -500, 0), simulation.Shapes.Add(new Box(20_000, 1_000, 20_000))));
            var bodies = new List<(BodyHandle Body, float Mass)>();
            for (int i = 0; i < 80; ++i)
                bodies.Add(Add(simulation, random, i));
            double greatest = Energy(simulation, bodies, gravity);
            for (int step = 0; step < 400; ++step)
            {
                float dt = MathF.Exp(Between(random, MathF.Log(1 / 1000f), MathF.Log(1 / 15f)));
                simulation.Timestep(dt);
                Assert.Equal(0, simulation.Quarantine.Count);
                double energy = Energy(simulation, bodies, gravity);
                Assert.True(double.IsFinite(energy));
                double allowed = 0;
                foreach (var (_, mass) in bodies)
                    allowed += mass * (RecoverySpeed * RecoverySpeed / 2 + gravity * 1e-3);
                Assert.True(energy <= greatest * (1 + mostGained) + allowed, $"step {step}: {greatest} J -> {energy} J, {allowed} J by recovery");
                greatest = Math.Min(greatest, energy);
            }
            simulation.Validate();
        }
        pool.AssertEmpty();
    }

    /// <summary>Boxes of 1 to 1,000 kg that fall on each other and spin, up to 400 rad in a substep: none of 20 heaps gains energy.</summary>
    [Theory]
    [InlineData(1000)]
    [InlineData(100_000)]
    public void Heaps_of_what_spins(float spin)
    {
        const float gravity = 9.81f, size = 0.05f;
        for (int seed = 0; seed < 20; ++seed)
        {
            using var pool = new BufferPool();
            using (var simulation = Simulation.Create(
                pool, new DefaultNarrowPhaseCallbacks(), new DefaultPoseIntegratorCallbacks(new Vector3(0, -gravity, 0)), SolveDescription.Default))
            {
                var random = new Random(seed);
                simulation.Statics.Add(new StaticDescription(new Vector3(0, -0.5f, 0), simulation.Shapes.Add(new Box(2000, 1, 2000))));
                var bodies = new List<(BodyHandle Body, float Mass)>();
                double allowed = 0;
                for (int i = 0; i < 8; ++i)
                {
                    var mass = MathF.Pow(10, Between(random, 0, 3));
                    var direction = Vector3.Normalize(new Vector3(Between(random, -1, 1), Between(random, -1, 1), Between(random, -1, 1)));
                    bodies.Add(Add(simulation, new Box(size, size * 0.7f, size), new Vector3((i & 1) * 0.3f * size, size * (1 + i * 1.3f), 0),
                        new BodyVelocity(default, direction * spin), mass));
                    allowed += mass * (RecoverySpeed * RecoverySpeed / 2 + gravity * 1e-3);
                }
                double least = Energy(simulation, bodies, gravity);
                for (int step = 0; step < 300; ++step)
                {
                    simulation.Timestep(1 / 60f);
                    double energy = Energy(simulation, bodies, gravity);
                    Assert.True(energy <= least * 1.01 + allowed, $"seed {seed}, step {step}: {least} J -> {energy} J, {allowed} J by recovery");
                    least = Math.Min(least, energy);
                }
            }
            pool.AssertEmpty();
        }
    }

    static (BodyHandle, float) Add(Simulation simulation, Random random, int index)
    {
        float size = MathF.Pow(10, Between(random, -3, 3)), mass = MathF.Pow(10, Between(random, -6, 6));
        // A lattice wide enough that nothing overlaps to begin with.
        var position = new Vector3(index % 9 * 1500 - 6000, 1000 + index / 9 * 1500, index * 37 % 9 * 1500 - 6000);
        if (index % 4 == 0)
            position.Y = size;
        var direction = Vector3.Normalize(new Vector3(Between(random, -1, 1), Between(random, -1, 0), Between(random, -1, 1)));
        var velocity = new BodyVelocity(direction * MathF.Pow(10, Between(random, -2, 3)), direction * Between(random, 0, 10));
        return (index % 3) switch
        {
            0 => Add(simulation, new Box(size, size * .7f, size), position, velocity, mass),
            1 => Add(simulation, new Sphere(size / 2), position, velocity, mass),
            _ => Add(simulation, new Capsule(size / 3, size / 3), position, velocity, mass),
        };
    }

    static (BodyHandle, float) Add<TShape>(Simulation simulation, TShape shape, Vector3 position, BodyVelocity velocity, float mass)
        where TShape : unmanaged, IConvexShape =>
        (simulation.Bodies.Add(BodyDescription.CreateDynamic(position, velocity, shape.ComputeInertia(mass), simulation.Shapes.Add(shape), -1)), mass);

    static float Between(Random random, float least, float most) => least + (most - least) * random.NextSingle();

    static double Energy(Simulation simulation, List<(BodyHandle Body, float Mass)> bodies, double gravity)
    {
        double sum = 0;
        foreach (var (body, _) in bodies)
            sum += BodyEnergy.Of(simulation.Bodies[body], gravity);
        return sum;
    }
}
