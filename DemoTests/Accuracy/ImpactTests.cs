using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuUtilities;
using Demos.Accuracy;
using Demos.References;
using DemoTests.Support;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Accuracy;

/// <summary>Bodies that touch several others bounce: never with more energy than before, and as spheres do one after the other.</summary>
public class ImpactTests(ITestOutputHelper output)
{
    // Per step and over the run, of the energy at the beginning: hundreds of impacts of single precision.
    const double Rounding = 2e-6;
    // What the integration makes of a body in free flight that turns by a radian in a substep, as light ones do here: 4e-5 a step.
    const double Turning = 5e-5;

    [Theory]
    [InlineData(2)]
    [InlineData(3)]
    [InlineData(4)]
    [InlineData(6)]
    [InlineData(10)]
    public void Cradle_passes_its_momentum_on(int count)
    {
        double worst = 0;
        foreach (var effort in ImpactWorld.Efforts())
            foreach (int thrown in new[] { 1, 2, 3 })
                foreach (float gap in new[] { 0, 1e-4f, 1e-3f, 1e-2f })
                    foreach (float speed in new[] { 1f, 5f })
                        if (thrown < count)
                            worst = Math.Max(worst, CradleError(effort with { Restitution = 1, Friction = 0 }, count, thrown, gap, speed));
        output.WriteLine($"{count} balls: {worst:g3} of the speed");
        Assert.InRange(worst, 0, 1e-4);
    }

    static double CradleError(AccuracySettings settings, int count, int thrown, float gap, float speed)
    {
        using var world = new ImpactWorld(settings);
        const float radius = .1f;
        for (int i = 0; i < count; ++i)
        {
            bool moves = i < thrown;
            world.Add(new Sphere(radius), 1, new RigidPose(new Vector3(i * (2 * radius + gap) - (moves ? .05f : 0), 0, 0)),
                new Vector3(moves ? speed : 0, 0, 0));
        }
        double start = world.Energy();
        for (int step = 0; step < 60; ++step)
        {
            world.World.Step(settings.Dt);
            Assert.True(world.Energy() <= start * (1 + Rounding), $"{settings} {count} {thrown} {gap} {speed}: energy {world.Energy() / start}");
        }
        double worst = 0;
        for (int i = 0; i < count; ++i)
            worst = Math.Max(worst, (world.Velocity(i) - new Double3(i >= count - thrown ? speed : 0, 0, 0)).Length / speed);
        return worst;
    }

    [Theory]
    [InlineData(1, 0)]
    [InlineData(.95f, 0)]
    [InlineData(.5f, 0)]
    [InlineData(1, .3f)]
    [InlineData(.95f, .3f)]
    [InlineData(.5f, .3f)]
    public void Billiard_break_gains_nothing(float restitution, float friction)
    {
        var random = new Random(11);
        foreach (var effort in ImpactWorld.Efforts())
        {
            using var world = new ImpactWorld(effort with { Restitution = restitution, Friction = friction });
            const float radius = .0286f;
            float distance = 2 * radius + random.Next(3) * 1e-4f;
            for (int row = 0; row < 5; ++row)
                for (int i = 0; i <= row; ++i)
                    world.Add(new Sphere(radius), .17f, new RigidPose(new Vector3(row * distance * MathF.Sqrt(.75f), 0, (i - row / 2f) * distance)));
            world.Add(new Sphere(radius), .17f, new RigidPose(new Vector3(-.3f, 0, random.NextSingle() * radius)),
                new BodyVelocity(new Vector3(2 + 8 * random.NextSingle(), 0, 0), new Vector3(0, 30 * random.NextSingle(), 0)));
            AssertKeeps(world, effort, 45);
        }
    }

    [Theory]
    [InlineData(1, 0, 1)]
    [InlineData(1, .5f, 1)]
    [InlineData(.7f, .5f, 1)]
    [InlineData(1, 0, 100)]
    [InlineData(1, .5f, 100)]
    [InlineData(.7f, 0, 100)]
    public void Boxes_thrown_on_a_block_of_boxes_gain_nothing(float restitution, float friction, float massRatio)
    {
        var random = new Random(7);
        foreach (var effort in ImpactWorld.Efforts())
        {
            using var world = new ImpactWorld(effort with { Restitution = restitution, Friction = friction });
            for (int i = 0; i < 18; ++i)
                world.Add(new Box(.5f, .5f, .5f), 1, new RigidPose(new Vector3(i % 2, i / 2 % 3, i / 6) * .51f));
            for (int i = 0; i < 3; ++i)
                world.Add(new Box(.5f, .4f, .6f), massRatio, new RigidPose(new Vector3(-1.5f - i, 0, 0) + Somewhere(random) * .5f, Turned(random)),
                    new BodyVelocity(new Vector3(5, 0, 0), Somewhere(random) * 5));
            AssertKeeps(world, effort, 45);
        }
    }

    [Theory]
    [InlineData(1, 0)]
    [InlineData(1, .4f)]
    [InlineData(.8f, 0)]
    [InlineData(.8f, .4f)]
    public void Cloud_of_shapes_and_masses_gains_nothing(float restitution, float friction)
    {
        var random = new Random(3);
        foreach (var effort in ImpactWorld.Efforts())
        {
            using var world = new ImpactWorld(effort with { Restitution = restitution, Friction = friction });
            for (int i = 0; i < 27; ++i)
            {
                var place = new Vector3(i % 3, i / 3 % 3, i / 9) * 1.2f;
                var pose = new RigidPose(place, Turned(random));
                var velocity = new BodyVelocity(Somewhere(random) * 6 - place, Somewhere(random) * 4);
                float mass = MathF.Pow(10, 2 * random.NextSingle());
                if (i % 3 == 0)
                    world.Add(new Sphere(.4f), mass, pose, velocity);
                else if (i % 3 == 1)
                    world.Add(new Capsule(.2f, .6f), mass, pose, velocity);
                else
                    world.Add(new Box(.8f, .5f, .6f), mass, pose, velocity);
            }
            AssertKeeps(world, effort, 60, Turning);
        }
    }

    [Theory]
    [InlineData(1, 0)]
    [InlineData(1, .5f)]
    [InlineData(.6f, .5f)]
    public void Pile_on_a_floor_gains_nothing(float restitution, float friction)
    {
        var random = new Random(5);
        foreach (var effort in ImpactWorld.Efforts())
        {
            using var world = new ImpactWorld(
                effort with { Restitution = restitution, Friction = friction, Gravity = new Vector3(0, -9.81f, 0) });
            world.World.AddGround();
            for (int i = 0; i < 12; ++i)
                world.Add(new Box(.5f, .4f, .6f), 1 + 9 * (i & 1), new RigidPose(new Vector3(i % 2 * .3f, 1 + i, i % 3 * .2f), Turned(random)),
                    new BodyVelocity(default, Somewhere(random) * 3));
            double start = world.Energy(), most = 0;
            for (int step = 0; step < 240; ++step)
            {
                world.World.Step(effort.Dt);
                most = Math.Max(most, world.Energy() / start - 1);
            }
            output.WriteLine($"{effort}: {most:g3}");
            // The work of gravity within the substep of an impact is known to first order.
            Assert.InRange(most, 0, .02 / effort.SubstepCount);
        }
    }

    void AssertKeeps(ImpactWorld world, AccuracySettings effort, int steps, double tolerance = Rounding)
    {
        double start = world.Energy(), before = start;
        var momentum = world.Momentum();
        for (int step = 0; step < steps; ++step)
        {
            world.World.Step(effort.Dt);
            double energy = world.Energy();
            Assert.True(energy <= before + start * tolerance, $"{effort}, step {step}: {energy / start} of the energy after {before / start}");
            before = energy;
        }
        double drift = (world.Momentum() - momentum).Length / momentum.Length;
        output.WriteLine($"{effort}: energy {before / start - 1:g3}, momentum {drift:g3}");
        Assert.InRange(drift, 0, 1e-5);
    }

    // Everything in the way is looked for from the beginning, so that impacts come in the order of the reference.
    [Theory]
    [InlineData(1)]
    [InlineData(.8f)]
    public void Line_of_unequal_spheres_bounces_as_the_reference(float restitution)
    {
        var random = new Random(17);
        double worst = 0;
        int impacts = 0;
        foreach (var effort in ImpactWorld.Efforts())
        {
            for (int round = 0; round < 8; ++round)
            {
                using var world = new ImpactWorld(effort with { Restitution = restitution, Friction = .5f });
                var reference = new SphereImpactOracle(restitution);
                double x = 0;
                for (int i = 0; i < 6; ++i)
                {
                    float radius = .05f + .1f * random.NextSingle();
                    float mass = MathF.Pow(10, 2 * random.NextSingle());
                    float speed = 4 * random.NextSingle() - 2;
                    x += radius + .01f + .1f * random.NextSingle();
                    var place = new Vector3((float)x, 0, 0);
                    world.Add(new Sphere(radius), mass, new RigidPose(place), new Vector3(speed, 0, 0), margin: .25f);
                    reference.Add(radius, mass, place, new Double3(speed, 0, 0));
                    x += radius;
                }
                world.World.Run(1);
                reference.Run(1);
                impacts += reference.ImpactCount;
                for (int i = 0; i < 6; ++i)
                    worst = Math.Max(worst, (world.Velocity(i) - reference.Velocity(i)).Length);
            }
        }
        output.WriteLine($"e = {restitution}: {impacts} impacts, {worst:g3} m/s");
        Assert.InRange(worst, 0, 2e-3);
    }

    // The normal of a contact is that of the beginning of the step: so short steps.
    [Fact]
    public void Sparse_balls_bounce_as_the_reference()
    {
        var random = new Random(23);
        double worst = 0, sum = 0;
        int impacts = 0, compared = 0;
        for (int round = 0; round < 40; ++round)
        {
            var settings = new AccuracySettings { Dt = 1 / 960f, SubstepCount = 2, Restitution = .95f, Friction = 0, Gravity = default };
            using var world = new ImpactWorld(settings);
            var reference = new SphereImpactOracle(settings.Restitution);
            for (int i = 0; i < 7; ++i)
            {
                var place = new Vector3(i == 0 ? -1 : i % 3 * .7f, 0, i == 0 ? 0 : (i / 3 - 1) * .6f) + Somewhere(random) * new Vector3(.2f, 0, .2f);
                var velocity = i == 0 ? new Vector3(2, 0, 0) + Somewhere(random) * new Vector3(0, 0, .8f) : default;
                world.Add(new Sphere(.1f), 1, new RigidPose(place), velocity, margin: .01f);
                reference.Add(.1f, 1, place, velocity);
            }
            world.World.Run(.9f);
            reference.Run(.9f);
            // After more impacts, errors of direction have grown by the ratio of distance to radius a time.
            if (reference.ImpactCount is 0 or > 2)
                continue;
            impacts += reference.ImpactCount;
            for (int i = 0; i < 7; ++i)
            {
                double error = (world.Velocity(i) - reference.Velocity(i)).Length / 2;
                worst = Math.Max(worst, error);
                sum += error;
                ++compared;
            }
        }
        output.WriteLine($"{impacts} impacts, {sum / compared:g3} of the speed, worst {worst:g3}");
        Assert.True(impacts >= 20);
        Assert.InRange(sum / compared, 0, .005);
        Assert.InRange(worst, 0, .05);
    }

    [Fact]
    public void Threads_do_not_change_a_bit_and_nothing_is_allocated()
    {
        var expected = RunPile(null);
        foreach (int threads in new[] { 2, 3, 8 })
        {
            using var dispatcher = new ThreadDispatcher(threads);
            Assert.Equal(expected, RunPile(dispatcher));
        }
    }

    static List<Vector3> RunPile(IThreadDispatcher? dispatcher)
    {
        var random = new Random(29);
        using var world = new ImpactWorld(new() { Restitution = .7f, Friction = .4f });
        world.World.AddGround();
        // More pairs than one block has.
        for (int i = 0; i < 216; ++i)
            world.Add(new Box(.5f, .4f, .6f), 1 + (i & 1), new RigidPose(new Vector3(i % 6, 1 + i / 36, i / 6 % 6) * .8f, Turned(random)));
        for (int step = 0; step < 60; ++step)
            world.World.Simulation.Timestep(1 / 60f, dispatcher);
        long before = GC.GetAllocatedBytesForCurrentThread();
        for (int step = 0; step < 60; ++step)
            world.World.Simulation.Timestep(1 / 60f, dispatcher);
        Assert.Equal(0, GC.GetAllocatedBytesForCurrentThread() - before);
        return [.. world.Velocities()];
    }

    static Vector3 Somewhere(Random random) => new Vector3(random.NextSingle(), random.NextSingle(), random.NextSingle()) * 2 - Vector3.One;

    static Quaternion Turned(Random random) =>
        Quaternion.CreateFromYawPitchRoll(6 * random.NextSingle(), 6 * random.NextSingle(), 6 * random.NextSingle());
}
