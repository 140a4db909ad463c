using System;
using System.Collections.Generic;
using BepuPhysics;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Sleeping;

/// <summary>Adds, removals, teleports, impulses, joints, sleep and waking at random, looked at after each step.</summary>
public class SleepScrambleTests
{
    static readonly SimulationAllocationSizes tiny = new(1, 1, 0, 1, 1, 1, 1);

    // Ten thousand sequences take half an hour.
    static int SequenceCount => Environment.GetEnvironmentVariable("PHYSICS_FULL_TESTS") is { Length: > 0 } ? 10_000 : 100;

    [Fact]
    public void Nothing_that_is_done_to_bodies_asleep_or_awake_breaks_an_invariant()
    {
        int slept = 0;
        for (int seed = 0; seed < SequenceCount; ++seed)
        {
            using var scramble = new Scramble(seed, threads: 1, seed % 2 == 0 ? tiny : null, sleeps: true);
            for (int round = 0; round < 60; ++round)
            {
                scramble.Round();
                scramble.Check();
                slept += scramble.Simulation.Awakener.SleepingIslandCount;
                if (round == 40 && seed % 4 == 0)
                    scramble.Clear();
            }
        }
        Assert.InRange(slept, 60 * SequenceCount / 2, int.MaxValue);
    }

    [Theory, InlineData(21), InlineData(22), InlineData(23)]
    public void Threads_and_initial_sizes_do_not_change_a_scramble_with_sleepers(int seed)
    {
        var expected = Hashes(seed, threads: 1, sizes: null, out int islands);
        Assert.InRange(islands, 100, int.MaxValue);
        Assert.Equal(expected, Hashes(seed, threads: 2, sizes: null, out _));
        Assert.Equal(expected, Hashes(seed, threads: 3, sizes: tiny, out _));
    }

    [Theory, InlineData(1), InlineData(2)]
    public void A_run_that_was_interrupted_and_cleared_gives_the_same_bits(int threads)
    {
        using var world = new SleepWorld(threads);
        List<ulong>? expected = null;
        // Cleared while all sleep, in the middle of falling asleep, and just after waking.
        foreach (int steps in (ReadOnlySpan<int>)[200, 60, 34, 120, 200])
        {
            world.Fill();
            var hashes = world.HashSteps(steps);
            expected ??= hashes;
            Assert.Equal(expected[..steps], hashes);
            world.Clear();
        }
    }

    static List<ulong> Hashes(int seed, int threads, SimulationAllocationSizes? sizes, out int islands)
    {
        using var scramble = new Scramble(seed, threads, sizes, sleeps: true);
        var hashes = new List<ulong>();
        islands = 0;
        for (int round = 0; round < 200; ++round)
        {
            scramble.Round();
            islands += scramble.Simulation.Awakener.SleepingIslandCount;
            hashes.Add(scramble.Simulation.StateHash());
        }
        return hashes;
    }
}
