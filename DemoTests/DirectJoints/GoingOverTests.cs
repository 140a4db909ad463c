using System;
using System.Linq;
using BepuPhysics;
using Demos.Accuracy;
using DemoTests.Scenes;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.DirectJoints;

/// <summary>Chains of light links under heavy loads, which come to be solved at once with whatever the sweeps have left of them.</summary>
public class GoingOverTests(ITestOutputHelper output)
{
    const int Chains = 100;
    // What rounding and the sweeps of the first steps may add.
    const double Gained = .02;

    /// <summary>
    /// A taut chain that is not quite straight swings faster than a substep can follow, and a blow makes its load a hundred times what it was in the substep
    /// before. No joint has a gap: it is no fault of going over. With the stiffness of the first substep of a step 33 and 17 of these gained, up to 6.6 times
    /// what there was.
    /// </summary>
    [Theory]
    [InlineData(DirectJointsMode.Always)]
    [InlineData(DirectJointsMode.WhereNeeded)]
    public void A_taut_chain_that_is_not_straight_gains_nothing(DirectJointsMode mode)
    {
        var gains = Enumerable.Range(0, Chains).Select(seed => Run(seed, crooked: .2f, mode, sweptSteps: 0).Gain).Order().ToArray();
        output.WriteLine($"{gains.Count(gain => gain > Gained)} gain, at most {gains[^1]}");
        Assert.InRange(gains.Count(gain => gain > Gained), 0, Chains / 50);
        Assert.InRange(gains[^1], double.MinValue, .1);
    }

    /// <summary>
    /// Let go by sweeps for half a second, in which they stretch by up to several times their length. Nothing explodes, and none comes to be longer than the
    /// sweeps alone would let it. What is pulled in as it swings gains by that, as a skater does who pulls in her arms. With errors that went at once, or all
    /// in half a second, 91 and 15 of these gained, up to 62 times what there was.
    /// </summary>
    [Theory]
    [InlineData(DirectJointsMode.Always)]
    [InlineData(DirectJointsMode.WhereNeeded)]
    public void What_sweeps_have_not_held_is_taken_in_mid_fall(DirectJointsMode mode)
    {
        int many = 0, longer = 0;
        double most = 0;
        for (int seed = 0; seed < Chains; ++seed)
        {
            var swept = Run(seed, crooked: 0, DirectJointsMode.Off, sweptSteps: 0);
            var (gain, stretch) = Run(seed, crooked: 0, mode, sweptSteps: 30);
            most = Math.Max(most, gain);
            many += gain > Gained ? 1 : 0;
            longer += stretch > Math.Max(1.1f * swept.Stretch, .02f) ? 1 : 0;
        }
        output.WriteLine($"{many} gain, at most {most}; {longer} longer than by sweeps");
        Assert.Equal(0, longer);
        Assert.InRange(many, 0, Chains / 20);
        Assert.InRange(most, 0, 1);
    }

    /// <summary>
    /// What hangs in a crooked chain falls until that is taut, and stops: a blow of a hundred times its weight, which no link was prepared for. Rigid links
    /// let it no farther, and it has no more energy than it fell with. Solved as if nothing hindered the links, they turned by radians in a substep, and of
    /// some chains the load fell on for ever beside them, through gaps of up to eighty links.
    /// </summary>
    [Theory]
    [InlineData(DirectJointsMode.Always, 1)]
    [InlineData(DirectJointsMode.Always, 2)]
    [InlineData(DirectJointsMode.Always, 4)]
    [InlineData(DirectJointsMode.WhereNeeded, 2)]
    [InlineData(DirectJointsMode.WhereNeeded, 4)]
    public void A_crooked_chain_that_comes_taut_stops_its_load(DirectJointsMode mode, int substeps)
    {
        double most = 0;
        float longest = 0;
        for (int seed = 0; seed < 60; ++seed)
        {
            using var chain = new HeavyChain(seed, crooked: 1, zigzag: true, substeps);
            chain.World.Solver.DirectJoints = mode;
            for (int step = 0; step < 240; ++step)
            {
                chain.World.Step();
                most = Math.Max(most, chain.Gain);
                longest = MathF.Max(longest, chain.Stretch);
                Assert.True(double.IsFinite(most) && float.IsFinite(longest), $"chain {seed}");
            }
        }
        output.WriteLine($"gains {most} at most, {longest} of a link too long");
        Assert.InRange(most, 0, Gained);
        Assert.InRange(longest, 0, .2f);
    }

    /// <summary>
    /// Off and on again: the impulses of a hard substep are none that sweeps may begin with. When they did, 54 of 200 such chains gained more than all of
    /// their fall and kick.
    /// </summary>
    [Fact]
    public void A_mode_that_comes_and_goes_throws_no_chain()
    {
        var many = 0;
        double most = 0;
        for (int seed = 0; seed < Chains; ++seed)
        {
            using var chain = new HeavyChain(seed, crooked: 0);
            double gain = 0;
            for (int step = 0; step < 150; ++step)
            {
                if (step % 7 == 0)
                    chain.World.Solver.DirectJoints = step / 7 % 2 == 0 ? DirectJointsMode.Off : DirectJointsMode.WhereNeeded;
                chain.World.Step();
                gain = Math.Max(gain, chain.Gain);
                Assert.True(double.IsFinite(gain), $"chain {seed}");
            }
            many += gain > Gained ? 1 : 0;
            most = Math.Max(most, gain);
        }
        output.WriteLine($"{many} gain, at most {most}");
        Assert.InRange(many, 0, Chains / 20);
        Assert.InRange(most, 0, 2);
    }

    static (double Gain, float Stretch) Run(int seed, float crooked, DirectJointsMode mode, int sweptSteps)
    {
        using var chain = new HeavyChain(seed, crooked);
        double gain = 0;
        float stretch = 0;
        for (int step = 0; step < 150; ++step)
        {
            if (step == sweptSteps)
                chain.World.Solver.DirectJoints = mode;
            chain.World.Step();
            gain = Math.Max(gain, chain.Gain);
            stretch = MathF.Max(stretch, chain.Stretch);
            Assert.True(double.IsFinite(gain) && float.IsFinite(stretch), $"chain {seed}");
        }
        return (gain, stretch);
    }

    /// <summary>What is slow enough to sleep long before its gap is closed stays awake until it is.</summary>
    [Theory]
    [InlineData(DirectJointsMode.Always)]
    [InlineData(DirectJointsMode.WhereNeeded)]
    public void What_goes_over_does_not_sleep_with_its_gaps(DirectJointsMode mode)
    {
        using var world = new TestWorld(new AccuracySettings { Contacts = ContactScope.None });
        var chain = DirectStructures.AddChain(world, default, 5, load: 100, downwards: true);
        float Gap() => chain.Zip(chain.Skip(1)).Max(pair =>
            (DirectStructures.Point(world, pair.First, .5f) - DirectStructures.Point(world, pair.Second, -.5f)).Length());
        world.Step(300);
        var before = Gap();
        Assert.InRange(before, .01f, .2f);
        world.Solver.DirectJoints = mode;
        foreach (var link in chain)
            world.Bodies[link].Activity.SleepThreshold = 10;
        int steps = 0;
        for (; world.Bodies[chain[1]].Awake; ++steps)
        {
            Assert.InRange(steps, 0, 600);
            world.Step();
        }
        output.WriteLine($"{before} m before, {Gap()} m after {steps} steps");
        Assert.InRange(Gap(), 0, 1e-3f);
    }
}
