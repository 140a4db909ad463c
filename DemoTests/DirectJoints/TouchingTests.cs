using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using Demos.Accuracy;
using Demos.Running;
using DemoTests.Scenes;
using DemoTests.Support;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.DirectJoints;

/// <summary>Structures that are solved at once and touch something: contacts are swept over before the joints are solved.</summary>
public class TouchingTests(ITestOutputHelper output)
{
    const double Gravity = 9.81;

    /// <summary>
    /// Light links and a heavy end that fall on a floor, all at once or one after the other, some of them thrown. Contacts that saw the velocities of joints by
    /// the impulses of the substep before let some gain 1e21 times what there was.
    /// </summary>
    [Theory]
    [InlineData(1, 4, 0)]
    [InlineData(1, 4, 1)]
    [InlineData(3, 2, 1)]
    public void A_chain_that_comes_to_lie_on_a_floor_gains_nothing(int iterations, int substeps, int relaxations)
    {
        const int chains = 40;
        var gains = Enumerable.Range(0, chains).Select(seed => GainOnFloor(seed, iterations, substeps, relaxations)).ToArray();
        output.WriteLine($"{gains.Count(gain => gain > .01)} gain, at most {gains.Max()}");
        Assert.InRange(gains.Max(), double.MinValue, .02);
    }

    static double GainOnFloor(int seed, int iterations, int substeps, int relaxations)
    {
        var random = new Random(7919 * seed + 5);
        float Uniform(float from, float to) => from + random.NextSingle() * (to - from);
        using var world = new TestWorld(new AccuracySettings
        {
            VelocityIterationCount = iterations,
            SubstepCount = substeps,
            RelaxationCount = relaxations,
            DirectJoints = DirectJointsChoice.Always,
        });
        world.AddStatic(new Box(1000, 10, 1000), new RigidPose(new Vector3(0, -5, 0)));
        var size = Uniform(.2f, .6f);
        var count = random.Next(5, 41);
        var load = MathF.Pow(10, Uniform(.5f, 3.5f));
        var box = new Box(.8f * size, size * Uniform(.05f, .3f), size * Uniform(.05f, .3f));
        var half = new Vector3(size / 2, 0, 0);
        var height = .3f * size;
        var kick = seed % 2 == 0 ? default : new Vector3(Uniform(-10, 10), Uniform(0, 6), Uniform(-10, 10));
        var bodies = new List<BodyHandle> { world.AddKinematic(new Sphere(.01f), new RigidPose(new Vector3(0, height, 0))) };
        for (int i = 1; i <= count; ++i)
        {
            var pose = new RigidPose(new Vector3(i * size, height, 0));
            bodies.Add(world.AddDynamic(box, i < count ? 1 : load, pose, new BodyVelocity(i < count ? default : kick)));
            if (seed % 3 == 0)
                world.Solver.Add(bodies[i - 1], bodies[i], new BallSocket { LocalOffsetA = half, LocalOffsetB = -half });
            else
            {
                world.Solver.Add(bodies[i - 1], bodies[i], new Hinge
                {
                    LocalOffsetA = half,
                    LocalOffsetB = -half,
                    LocalHingeAxisA = Vector3.UnitZ,
                    LocalHingeAxisB = Vector3.UnitZ,
                });
            }
        }
        double Energy() => bodies.Skip(1).Sum(handle => BodyEnergy.Of(world.Bodies[handle], Gravity));
        var start = Energy();
        // What there is: a fall of all by the height of a man, and the throw.
        var scale = (count - 1 + load) * Gravity * (1 + size) + .5 * load * kick.LengthSquared();
        double most = 0;
        for (int step = 0; step < 120; ++step)
        {
            world.Step();
            var energy = Energy();
            Assert.True(double.IsFinite(energy), $"chain {seed}, step {step}");
            most = Math.Max(most, (energy - start) / scale);
        }
        return most;
    }
}
