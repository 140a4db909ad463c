using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using Demos.Accuracy;
using Demos.JointTables;
using Demos.Running;
using Demos.Scenes;
using DemoTests.Scenes;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.DirectJoints;

/// <summary>Joints that are solved at once where sweeps do not hold them: found, let go, and nothing is thrown on the way.</summary>
public class DirectNeedTests(ITestOutputHelper output)
{
    static readonly AccuracySettings needed = new() { DirectJoints = DirectJointsChoice.WhereNeeded, Contacts = ContactScope.None };

    /// <summary>By sweeps the first is 43 % longer than it should be, the second five times as long.</summary>
    [Theory]
    [InlineData(100)]
    [InlineData(1000)]
    public void A_chain_that_sweeps_do_not_hold_is_found_and_does_not_stretch(float load)
    {
        using var world = new AccuracyWorld(needed);
        var chain = new LoadedChain(world, ChainStart.HangingKicked, 100, load);
        var (steps, found) = (0, int.MaxValue);
        double worst = 0, greatest = 0, last = 0;
        world.Run(5, () =>
        {
            ++steps;
            if (DirectCount(world.Simulation.Solver) == 101)
                found = Math.Min(found, steps);
            chain.Gaps(out last, ref worst);
            greatest = Math.Max(greatest, last);
        });
        output.WriteLine($"found after {found} steps; stretch {greatest:P3}, at the end {last:P5}");
        // New joints are looked at in each step.
        Assert.InRange(found, 1, Solver.NeedTurns / 2);
        Assert.InRange(greatest, 0, .01);
        Assert.InRange(last, 0, 1e-4);
    }

    /// <summary>What needs nothing is as it would be without the mode.</summary>
    [Theory]
    [InlineData(0)]
    [InlineData(1)]
    public void What_sweeps_hold_is_left_to_them(int relaxations)
    {
        List<ulong> Hashes(DirectJointsChoice mode)
        {
            using var world = new TestWorld(needed with { DirectJoints = mode, Contacts = ContactScope.All, RelaxationCount = relaxations });
            world.AddStatic(new Box(100, 1, 100), new RigidPose(new Vector3(0, -1, 0)));
            for (int i = 0; i < 6; ++i)
            {
                // A weld that lies on the ground, a pendulum, a spring that a game wants to give way.
                DirectStructures.AddLoose(world, new Vector3(0, -.39f, 2 * i), 3);
                DirectStructures.AddChain(world, new Vector3(10, 3, 2 * i), 1, downwards: true);
                DirectStructures.AddChain(world, new Vector3(20, 3, 2 * i), 2, spring: new(2, 1));
            }
            var hashes = world.HashSteps(200);
            Assert.Equal(0, DirectCount(world.Solver));
            return hashes;
        }
        Assert.Equal(Hashes(DirectJointsChoice.Off), Hashes(DirectJointsChoice.WhereNeeded));
    }

    /// <summary>When the load is taken off, the rest of a chain is one that sweeps bear, and goes back to them; under load it never does.</summary>
    [Fact]
    public void It_goes_back_when_the_load_is_taken_off()
    {
        using var world = new TestWorld(needed);
        var chain = DirectStructures.AddChain(world, Vector3.Zero, 2, downwards: true);
        var load = world.AddDynamic(new Sphere(.5f), 500, new RigidPose(new Vector3(0, -3, 0)));
        world.Solver.Add(chain[2], load, new BallSocket { LocalOffsetA = new(.5f, 0, 0), LocalOffsetB = new(0, .5f, 0) });
        world.Step(2 * Solver.NeedTurns);
        for (int i = 0; i < 600; ++i)
        {
            Assert.Equal(3, DirectCount(world.Solver));
            world.Step();
        }
        world.Bodies.Remove(load);
        world.Step(30);
        Assert.Equal(2, DirectCount(world.Solver));
        world.Step(60);
        Assert.Equal(0, DirectCount(world.Solver));
        world.Step(120);
        Assert.Equal(0, DirectCount(world.Solver));
        world.Simulation.Validate();
    }

    /// <summary>
    /// A chain that has hung by sweeps for long goes over. What it lost in height it gets back, as it must, but no more than that: whatever is above where it
    /// began would be a gift.
    /// </summary>
    [Theory]
    [InlineData(20, 1, .05)]
    [InlineData(20, 10, .05)]
    [InlineData(20, 100, .2)]
    public void Going_over_throws_nothing(int links, float load, double most)
    {
        using var world = new AccuracyWorld(needed with { DirectJoints = DirectJointsChoice.Off });
        var chain = new LoadedChain(world, ChainStart.HangingKicked, links, load);
        var start = chain.Energy;
        world.Run(10, () => { });
        var lost = start - chain.Energy;
        world.Simulation.Solver.DirectJoints = DirectJointsMode.WhereNeeded;
        var greatest = double.MinValue;
        world.Run(5, () => greatest = Math.Max(greatest, chain.Energy - start));
        double worst = 0;
        chain.Gaps(out var stretch, ref worst);
        output.WriteLine($"lost {lost:G4} J, at most {greatest:G4} J above the start, stretch {stretch:P5}");
        Assert.True(greatest < most * lost, $"{greatest} J above the start, after {lost} J had been lost");
        Assert.InRange(stretch, 0, 1e-3);
    }

    /// <summary>
    /// Dolls that lie in a heap, with gaps, and may be solved at once from some moment on: few of those that rest are, and nothing is thrown. Of heaps that
    /// differ by what each part was pushed with as it fell: one of them says little.
    /// </summary>
    [Fact]
    public void Ragdolls_at_rest_stay_there()
    {
        var fastest = Enumerable.Range(1, 15).Select(RestOfDolls).Order().ToArray();
        output.WriteLine(string.Join(", ", fastest));
        // A gap of 9 mm goes at .86 of it over half a second, which is .15 m/s; parts between several gaps move by the sum.
        Assert.InRange(fastest[7], 0, .4f);
        Assert.InRange(fastest[^1], 0, 1.5f);
    }

    float RestOfDolls(int seed)
    {
        using var world = new SceneWorld(SceneLibrary.Load("ragdolls", 1), threads: 1);
        var solver = world.Simulation.Solver;
        ref var set = ref world.Simulation.Bodies.ActiveSet;
        world.Step();
        var random = new Random(seed);
        for (int body = 0; body < set.Count; ++body)
            set.MotionStates[body].Velocity.Linear += new Vector3(random.NextSingle() - .5f, 0, random.NextSingle() - .5f) * .5f;
        for (int i = 0; i < 400; ++i)
            world.Step();
        solver.DirectJoints = DirectJointsMode.WhereNeeded;
        float fastest = 0;
        for (int i = 0; i < 150; ++i)
        {
            world.Step();
            for (int body = 0; body < set.Count; ++body)
                fastest = MathF.Max(fastest, set.MotionStates[body].Velocity.Linear.Length());
        }
        output.WriteLine($"{DirectCount(solver)} joints, at most {fastest} m/s");
        // Of 1,920.
        Assert.InRange(DirectCount(solver), 1, 400);
        return fastest;
    }

    /// <summary>By sweeps it loses a quarter of its speed in ten seconds, all at once 2 %.</summary>
    [Fact]
    public void A_rotor_out_of_balance_keeps_its_speed()
    {
        using var world = new TestWorld(needed with { Gravity = default });
        var left = DirectStructures.TurnRotor(world);
        Assert.Equal(1, DirectCount(world.Solver));
        output.WriteLine($"{left - 1:P2} of its speed");
        Assert.InRange(left, .95f, 1.001f);
    }

    /// <summary>By sweeps they lose 68, 10, 3.7 and 4.7 % of their energy in a minute; the last two are never off by much.</summary>
    [Theory]
    [InlineData("double-pendulum", .05)]
    [InlineData("slider-crank", .02)]
    [InlineData("four-bar", .01)]
    [InlineData("pendulum", .01)]
    public void Linkages_keep_their_energy(string name, double most)
    {
        var run = LinkageRun.Measure(LinkageLibrary.All.Single(linkage => linkage.Name == name), needed);
        output.WriteLine($"{run}");
        Assert.InRange(run.EnergyLeft, -most, .01);
        Assert.InRange(run.EnergyGain, 0, .01);
    }

    /// <summary>A hub of hundreds cannot be solved at once: it stays as it is without the mode, and is not tried again and again.</summary>
    [Fact]
    public void What_would_take_too_long_is_left_to_sweeps()
    {
        List<ulong> Hashes(DirectJointsChoice mode)
        {
            using var world = new TestWorld(needed with { DirectJoints = mode });
            var hub = world.AddDynamic(new Sphere(1), 100, new RigidPose(Vector3.Zero));
            for (int i = 0; i < 100; ++i)
            {
                var arm = world.AddDynamic(new Sphere(.2f), 1, new RigidPose(new Vector3(2, i, 0)));
                world.Solver.Add(hub, arm, new BallSocket { LocalOffsetA = new(1, i, 0), LocalOffsetB = new(-1, 0, 0) });
            }
            return world.HashSteps(60);
        }
        Assert.Equal(Hashes(DirectJointsChoice.Off), Hashes(DirectJointsChoice.WhereNeeded));
    }

    internal static int DirectCount(Solver solver)
    {
        var index = Solver.FindBatch(solver.ActiveSet, BatchKind.Direct);
        return index < 0 ? 0 : solver.ActiveSet.Batches[index].CountConstraints();
    }
}
