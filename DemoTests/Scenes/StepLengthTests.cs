using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using Demos.Accuracy;
using DemoTests.Accuracy;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Scenes;

/// <summary>How many substeps a step has, and that a change of its length adds no energy.</summary>
public class StepLengthTests(ITestOutputHelper output)
{
    const float Usual = 1 / 60f;
    const double Duration = 60;

    /// <summary>Steps of one length have exactly the substeps that were asked for, from the first one on, and all of one length.</summary>
    [Theory]
    [InlineData(1)]
    [InlineData(3)]
    [InlineData(4)]
    [InlineData(7)]
    [InlineData(60)]
    [InlineData(1000)]
    public void Steps_of_one_length_have_what_was_asked_for(int asked)
    {
        using var world = Falling(asked);
        foreach (float dt in (ReadOnlySpan<float>)[1 / 60f, 1 / 30f, .0123f, 1e-6f, 1])
        {
            for (int i = 0; i < 5; ++i)
            {
                Assert.Equal(dt / asked, world.Solver.ForeseeSubstepDt(dt));
                world.Step(dt);
                Assert.Equal(asked, world.Solver.LastSubstepCount);
            }
            world.Simulation.Clear();
            Assert.Equal(0, world.Solver.LastSubstepCount);
            world.AddDynamic(new Sphere(.5f), 1, RigidPose.Identity);
        }
    }

    [Theory]
    [InlineData(1, 4)]
    [InlineData(1.1, 4)]
    [InlineData(.9, 4)]
    [InlineData(2, 8)]
    [InlineData(3, 12)]
    [InlineData(10, 16)]
    [InlineData(.5, 2)]
    [InlineData(.25, 1)]
    [InlineData(.01, 1)]
    public void The_number_of_substeps_follows_the_length(float length, int expected)
    {
        using var world = Falling(4);
        world.Step(500);
        var begun = new List<int>();
        var ended = new List<int>();
        var scheduled = new List<int>();
        world.Solver.SubstepStarted += begun.Add;
        world.Solver.SubstepEnded += ended.Add;
        world.Solver.VelocityIterationScheduler = substep =>
        {
            scheduled.Add(substep);
            return 1;
        };
        // As part of the step: that is what decides how far ahead of its beginning substeps are in the mean.
        Assert.InRange(world.Solver.ForeseeSubstepDt(length * Usual) / (length * Usual) - 1.0 / expected, -.04, .04);
        world.Step(length * Usual);

        Assert.Equal(expected, world.Solver.LastSubstepCount);
        Assert.Equal(4, world.Solver.SubstepCount);
        Assert.Equal(expected, begun.Count);
        for (int i = 0; i < expected; ++i)
            Assert.Equal((i, i), (begun[i], ended[i]));
        // A schedule is for the substeps that were asked for, and keeps its place in the step.
        Assert.All(scheduled, substep => Assert.InRange(substep, 0, 3));
        Assert.True(scheduled[^1] == (int)((expected - 1) * 4L / expected), string.Join(", ", scheduled));
    }

    [Fact]
    public void What_is_asked_for_holds_at_once_and_a_new_rate_in_the_end()
    {
        using var world = Falling(4);
        world.Step(500);
        world.Solver.SubstepCount = 6;
        world.Step();
        Assert.Equal(6, world.Solver.LastSubstepCount);
        world.Step(2 * Usual);
        Assert.Equal(12, world.Solver.LastSubstepCount);
        for (int i = 0; i < 1000; ++i)
            world.Step(2 * Usual);
        Assert.Equal(6, world.Solver.LastSubstepCount);
    }

    [Theory]
    [InlineData(true)]
    [InlineData(false)]
    public void A_fixed_number_stays(bool fromDescription)
    {
        using var world = new TestWorld();
        using var described = Simulation.Create(
            world.Pool, new WorldContacts(default, ContactScope.None), new WorldGravity(new AccuracySettings()),
            new SolveDescription(1, 4) { HasFixedSubstepCount = true });
        world.Solver.HasFixedSubstepCount = true;
        var simulation = fromDescription ? described : world.Simulation;
        simulation.Bodies.Add(BodyDescription.CreateConvexDynamic(Vector3.Zero, 1, simulation.Shapes, new Sphere(1)));
        Assert.True(simulation.Solver.HasFixedSubstepCount);
        foreach (float dt in (ReadOnlySpan<float>)[Usual, Usual * 5, Usual / 5])
        {
            simulation.Timestep(dt);
            Assert.Equal(4, simulation.Solver.LastSubstepCount);
        }
    }

    /// <summary>One odd step at the beginning, as of a game that loads, is soon forgotten.</summary>
    [Theory]
    [InlineData(.1f)]
    [InlineData(1e-4f)]
    public void An_odd_first_step_is_forgotten(float first)
    {
        using var world = Falling(4);
        world.Step(first);
        world.Step(20);
        Assert.InRange(world.Solver.LastSubstepCount, 3, 5);
        world.Step(40);
        Assert.Equal(4, world.Solver.LastSubstepCount);
    }

    public static TheoryData<string, int, int> Sequences()
    {
        var cases = new TheoryData<string, int, int>();
        foreach (int relaxations in (ReadOnlySpan<int>)[0, 1])
        {
            foreach (string sequence in (ReadOnlySpan<string>)["a step of 1/30 a second", "a step of 1/20 a second", "60 and 30 Hz in turn", "missed frames"])
                cases.Add(sequence, relaxations, 1);
            for (int seed = 1; seed <= 3; ++seed)
                cases.Add("any rate", relaxations, seed);
            cases.Add("any length", relaxations, 1);
        }
        return cases;
    }

    /// <summary>
    /// Ten boxes on each other for a minute. They stand still to a centimetre a second, stay within millimetres of their column, and sink no deeper than they
    /// do at the longest of the usual lengths.
    /// </summary>
    [Theory]
    [MemberData(nameof(Sequences))]
    public void A_stack_stands_whatever_the_steps(string sequence, int relaxations, int seed)
    {
        using var world = new AccuracyWorld(new AccuracySettings { RelaxationCount = relaxations });
        world.AddGround();
        var stack = Stack.OfEqual(world, 10);
        var random = new Random(seed);
        double squares = 0, fastest = 0, start = Energy(world), highest = start;
        int count = 0;
        for (int i = 0; world.Time < Duration; ++i)
        {
            world.Step(Length(sequence, i, random));
            highest = Tally.Most(highest, Energy(world));
            if (world.Time < 2)
                continue;
            foreach (var body in world.Dynamics)
            {
                double speed = world.LinearVelocity(body).Length;
                squares += speed * speed;
                fastest = Tally.Most(fastest, speed);
                ++count;
            }
        }
        double residual = Math.Sqrt(squares / count);
        output.WriteLine(FormattableString.Invariant(
            $"{sequence}, r{relaxations}, {seed}: drift {stack.Drift:F4} m, loss {stack.Loss:F4} m, speed {residual:F4} rms, {fastest:F4} at most"));
        Assert.InRange(stack.Drift, 0, .005);
        Assert.InRange(stack.Loss, 0, .1);
        Assert.InRange(residual, 0, .01);
        Assert.InRange(fastest, 0, .1);
        // What the boxes begin with is the most that they ever have.
        Assert.True(highest - start < 1e-6 * Math.Abs(start), $"energy rose by {highest - start} J");
    }

    static float Length(string sequence, int step, Random random) => sequence switch
    {
        "a step of 1/30 a second" => step % 60 == 59 ? 1 / 30f : Usual,
        "a step of 1/20 a second" => step % 60 == 59 ? 1 / 20f : Usual,
        "60 and 30 Hz in turn" => step / 300 % 2 == 0 ? Usual : 1 / 30f,
        "missed frames" => random.Next(10) == 0 ? 1 / 30f : Usual,
        "any rate" => 1 / (30 + 210 * random.NextSingle()),
        _ => 1 / 240f + random.NextSingle() * (1 / 30f - 1 / 240f),
    };

    static double Energy(AccuracyWorld world)
    {
        double sum = 0;
        foreach (var body in world.Dynamics)
            sum += world.Energy(body, 1, new(1 / 6.0, 1 / 6.0, 1 / 6.0));
        return sum;
    }

    /// <summary>
    /// Chains and hubs, rigid ones and springs that are as stiff as a substep bears, once they are at rest: no sequence of steps moves them with more
    /// energy than their fall from where they began would give.
    /// </summary>
    [Theory]
    [InlineData(0, 0)]
    [InlineData(1, 0)]
    [InlineData(0, 1000)]
    [InlineData(1, 1000)]
    public void A_straight_chain_gains_no_energy_from_changing_steps(int relaxations, float frequency)
    {
        var settings = new AccuracySettings { RelaxationCount = relaxations, Contacts = ContactScope.None };
        foreach (string sequence in (ReadOnlySpan<string>)["a step of 1/20 a second", "missed frames", "any rate", "any length"])
        {
            using var world = new AccuracyWorld(settings);
            var chain = new LoadedChain(
                world, ChainStart.HangingStraight, linkCount: 30, load: 10, frequency > 0 ? new SpringSettings(frequency, 1) : null);
            double start = chain.Energy, highest = start;
            var random = new Random(5);
            for (int i = 0; world.Time < 10; ++i)
            {
                world.Step(Length(sequence, i, random));
                highest = Tally.Most(highest, chain.Energy);
            }
            Assert.True(highest - start < 1e-6 * Math.Abs(start), $"{sequence}: energy rose from {start} to {highest}");
        }
    }

    [Theory]
    [InlineData(HubJoint.Weld, 0)]
    [InlineData(HubJoint.Weld, 1)]
    [InlineData(HubJoint.Hinge, 1)]
    [InlineData(HubJoint.Ball, 1)]
    public void A_hub_gains_no_energy_from_changing_steps(HubJoint joint, int relaxations)
    {
        foreach (int arms in (ReadOnlySpan<int>)[2, 4, 6, 12])
        {
            foreach (bool isPost in (ReadOnlySpan<bool>)[true, false])
            {
                var settings = new AccuracySettings { RelaxationCount = relaxations, Contacts = ContactScope.None };
                using var world = new AccuracyWorld(isPost ? settings : settings with { Gravity = default });
                var hub = new Hub(world, joint, arms, 8, 4, isPost);
                double start = hub.Energy, highest = start;
                world.Run(1);
                var random = new Random(arms);
                for (int i = 0; world.Time < 10; ++i)
                {
                    world.Step(Length("any rate", i, random));
                    highest = Tally.Most(highest, hub.Energy);
                }
                Assert.True(highest - start < .01 * (isPost ? hub.Scale : start), $"{arms} arms: energy rose from {start} to {highest} J");
            }
        }
    }

    static TestWorld Falling(int substepCount)
    {
        var world = new TestWorld(new AccuracySettings { SubstepCount = substepCount });
        world.AddDynamic(new Sphere(.5f), 1, RigidPose.Identity);
        return world;
    }
}
