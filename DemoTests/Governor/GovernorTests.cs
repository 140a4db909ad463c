using System;
using System.Collections.Generic;
using BepuPhysics;
using BepuPhysics.Constraints;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Governor;

/// <summary>Substeps by the error of the constraints: what is read, what is held at what price, and that nothing is kicked.</summary>
public class GovernorTests(ITestOutputHelper output)
{
    const int StepsPerPhase = 300;
    const float Target = 1e-3f;

    /// <summary>Loaded and unloaded by turns, five seconds each.</summary>
    /// <returns>Greatest error from the second second of each phase on, m, and the mean number of substeps.</returns>
    static (float Error, double Cost) Alternate(bool hangs, SubstepGovernor governor)
    {
        using var world = new GovernorWorld(governor);
        if (hangs)
            world.AddChain(8);
        else
            world.AddStack(4);
        for (int i = 0; i < 120; ++i)
            world.Step();
        var before = world.Cost;
        var greatest = 0f;
        for (int phase = 0; phase < 4; ++phase)
        {
            if (phase % 2 == 1)
                world.TakeLoad();
            else if (hangs)
                world.HangLoad(20);
            else
                world.PutLoad(20);
            for (int i = 0; i < StepsPerPhase; ++i)
            {
                world.Step();
                if (i >= 60)
                    greatest = MathF.Max(greatest, world.Solver.LastConstraintError);
            }
        }
        return (greatest, (world.Cost - before) / (4.0 * StepsPerPhase));
    }

    [Theory, InlineData(false, 15), InlineData(true, 17)]
    public void A_target_is_held_for_less_than_a_fixed_count_costs(bool hangs, int holding)
    {
        var governed = Alternate(hangs, new SubstepGovernor(Target, 2, 32));
        var holds = Alternate(hangs, new SubstepGovernor(1, holding, holding));
        var fails = Alternate(hangs, new SubstepGovernor(1, holding - 1, holding - 1));
        output.WriteLine($"{governed}, {holding}: {holds}, {holding - 1}: {fails}");
        Assert.InRange(governed.Error, 0.2f * Target, Target);
        Assert.InRange(holds.Error, 0, 1.02f * Target);
        Assert.True(fails.Error > Target);
        Assert.Equal(holding, holds.Cost);
        Assert.True(governed.Cost < 0.92 * holding, $"{governed.Cost}");
    }

    /// <summary>Without a range a governor only reads: bits are those of the same count without one, and the error is what the poses say.</summary>
    [Theory, InlineData(4), InlineData(8)]
    public void Reading_changes_no_bit_and_nothing_is_read_when_off(int substeps)
    {
        using var governed = new GovernorWorld(new SubstepGovernor(Target, substeps, substeps), substeps);
        using var plain = new GovernorWorld(null, substeps);
        foreach (var world in new[] { governed, plain })
        {
            world.AddStack(5);
            world.AddChain(5);
            foreach (var stage in world.Solver.OptionalStages)
                Assert.True(world == governed || stage.GetBlockCount(SolverPoint.AfterSubsteps) == 0);
        }
        for (int i = 0; i < 100; ++i)
        {
            governed.Step();
            plain.Step();
            Assert.Equal(plain.Hash(), governed.Hash());
            Assert.Equal(0, plain.Solver.LastConstraintError);
            Assert.True(governed.Solver.LastConstraintError > 0);
        }
    }

    [Fact]
    public void The_error_of_contacts_is_their_depth()
    {
        using var world = new GovernorWorld(new SubstepGovernor(Target, 4, 4));
        world.AddStack(1);
        for (int i = 0; i < 100; ++i)
        {
            // From the first step on, in which it sinks in, at one corner a little before the others. Rounding of a position of half a metre.
            world.Step();
            var depth = 0.5f - world.Height;
            Assert.InRange(world.Solver.LastConstraintError, depth - 1e-6f, depth + (i < 50 ? 1e-4f : 1e-6f));
        }
        Assert.InRange(world.Solver.LastConstraintError, 1e-5f, 1e-3f);
    }

    [Fact]
    public void The_error_of_joints_is_the_distance_of_their_points()
    {
        using var world = new GovernorWorld(new SubstepGovernor(Target, 4, 4));
        world.AddChain(6);
        world.HangLoad(10);
        for (int i = 0; i < 100; ++i)
        {
            world.Step();
            var expected = world.GreatestGap();
            // Rounding of heights of 50 m.
            Assert.InRange(world.Solver.LastConstraintError, expected - 1e-5f, expected + 1e-5f);
        }
        Assert.True(world.Solver.LastConstraintError > 1e-3f);
    }

    [Fact]
    public void Springs_of_the_game_and_gaps_do_not_count()
    {
        var springs = new SpringSettings(5, 1);
        using var world = new GovernorWorld(new SubstepGovernor(Target, 2, 8), springs: springs);
        world.AddStack(3);
        world.AddChain(3, springs);
        for (int i = 0; i < 100; ++i)
        {
            world.Step();
            Assert.Equal(0, world.Solver.LastConstraintError);
        }
        Assert.Equal(2, world.Solver.LastSubstepCount);
    }

    [Fact]
    public void Threads_change_no_bit()
    {
        List<(ulong, float, int)>? first = null;
        foreach (var threads in new[] { 1, 2, 3 })
        {
            using var world = new GovernorWorld(new SubstepGovernor(Target, 2, 16), threads: threads);
            // Enough constraints for several blocks at any number of lanes.
            for (int i = 0; i < 60; ++i)
                world.AddStack(10, 3 * i);
            world.AddChain(8);
            List<(ulong, float, int)> states = [];
            for (int i = 0; i < 60; ++i)
            {
                if (i == 20)
                    world.HangLoad(50);
                world.Step();
                states.Add((world.Hash(), world.Solver.LastConstraintError, world.Solver.LastSubstepCount));
            }
            first ??= states;
            Assert.Equal(first, states);
        }
    }

    /// <summary>The count goes from the least to the greatest and back every five seconds, under a stack that rests.</summary>
    [Fact]
    public void Changing_the_count_kicks_nothing()
    {
        (double Speed, float Aside, float Drift, float Height) Run(bool governed, bool byHand)
        {
            using var world = new GovernorWorld(governed ? new SubstepGovernor(1, 4, 16) : null);
            world.AddStack(5);
            double sum = 0;
            var aside = 0f;
            var seen = new HashSet<int>();
            for (int i = 0; i < 2100; ++i)
            {
                var isFine = i >= 300 && i / 300 % 2 == 1;
                if (governed && i % 300 == 0)
                    world.Solver.Governor = new SubstepGovernor(isFine ? 1e-6f : 1, 4, 16);
                if (byHand && i % 300 == 0)
                    world.Solver.SubstepCount = isFine ? 16 : 4;
                world.Step();
                seen.Add(world.Solver.LastSubstepCount);
                if (i < 300)
                    continue;
                var speeds = world.GreatestSpeeds();
                sum += speeds.Up * speeds.Up;
                aside = MathF.Max(aside, speeds.Aside);
            }
            Assert.True(!governed || seen.SetEquals([4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16]), string.Join(' ', seen));
            return (Math.Sqrt(sum / 1800), aside, world.Drift, world.Height);
        }
        var resting = Run(false, false);
        var moving = Run(true, false);
        var jumping = Run(false, true);
        output.WriteLine($"{resting}\n{moving}\n{jumping}");
        // It is raised by 6 mm each time, in half a second: that is .004 m/s in the mean of five seconds, and a jump gives four times as much.
        Assert.InRange(moving.Speed, 0, 5e-3);
        Assert.True(moving.Speed < jumping.Speed / 3);
        Assert.InRange(moving.Aside, 0, 2e-3f);
        Assert.InRange(moving.Drift, 0, 1e-4f);
        Assert.InRange(moving.Height, resting.Height - 1e-4f, resting.Height + 1e-4f);
    }

    [Fact]
    public void The_count_stays_in_its_range_and_starts_from_what_was_asked_for()
    {
        using var world = new GovernorWorld(new SubstepGovernor(1, 6, 9), substeps: 4);
        world.AddStack(2);
        world.Step();
        Assert.Equal(6, world.Solver.LastSubstepCount);
        world.Solver.Governor = new SubstepGovernor(1e-9f, 6, 9);
        for (int i = 0; i < 30; ++i)
        {
            world.Step();
            Assert.InRange(world.Solver.LastSubstepCount, 6, 9);
        }
        Assert.Equal(9, world.Solver.LastSubstepCount);
        // Twice the usual length.
        world.Step(2 * GovernorWorld.Dt);
        Assert.Equal(18, world.Solver.LastSubstepCount);
        world.Solver.Governor = null;
        world.Step();
        Assert.Equal(4, world.Solver.LastSubstepCount);
        Assert.Equal(0, world.Solver.LastConstraintError);
    }

    public static TheoryData<float, int, int> BadSettings => new()
    {
        { float.NaN, 1, 4 }, { 0, 1, 4 }, { -1, 1, 4 }, { float.PositiveInfinity, 1, 4 }, { Target, 0, 4 }, { Target, -1, 4 }, { Target, 5, 4 },
    };

    [Theory, MemberData(nameof(BadSettings))]
    public void Bad_settings_are_refused_and_change_nothing(float target, int least, int greatest)
    {
        Assert.Throws<ArgumentOutOfRangeException>(() => new SubstepGovernor(target, least, greatest));
        var bad = new SubstepGovernor { TargetError = target, LeastSubstepCount = least, GreatestSubstepCount = greatest };
        Assert.Throws<ArgumentOutOfRangeException>(() => new GovernorWorld(bad));
        using var world = new GovernorWorld(new SubstepGovernor(Target, 2, 5));
        Assert.Throws<ArgumentOutOfRangeException>(() => world.Solver.Governor = bad);
        Assert.Throws<ArgumentOutOfRangeException>(() => world.Solver.Governor = default(SubstepGovernor));
        Assert.Equal(new SubstepGovernor(Target, 2, 5), world.Solver.Governor);
    }
}
