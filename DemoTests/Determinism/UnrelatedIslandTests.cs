using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuUtilities;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.Determinism;

/// <summary>Random parts of worlds do what they do by themselves, to the last bit, whatever there is three kilometres from them.</summary>
public class UnrelatedIslandTests
{
    const int Steps = 150;

    [Theory]
    [InlineData(0), InlineData(1), InlineData(2), InlineData(3), InlineData(4), InlineData(5), InlineData(6), InlineData(7)]
    public void Another_island_changes_no_bit(int block)
    {
        const int seeds = 6;
        for (int seed = block * seeds; seed < (block + 1) * seeds; ++seed)
        {
            var solve = (seed % 3) switch { 0 => SolveDescription.Default, 1 => SolveDescription.Accurate, _ => new SolveDescription(1, 2) };
            solve.DirectJoints = (seed % 5) switch { 0 => DirectJointsMode.Always, 1 or 2 => DirectJointsMode.WhereNeeded, _ => DirectJointsMode.Off };
            Compare(seed, solve);
        }
    }

    /// <summary>
    /// A bounce hides an overlap from the substeps, so contacts touch in some of them and not in others. Where the friction of a support acts was read again in
    /// each of them only if the block of its island had others to do.
    /// </summary>
    [Fact]
    public void What_is_hit_is_read_in_each_substep() =>
        Compare(53, new SolveDescription(1, 4) { RelaxationIterationCount = 1, DirectJoints = DirectJointsMode.WhereNeeded });

    /// <summary>
    /// Whether all constraints of what hangs on a floor are gone over, or sets of bodies are joined; and whom a body is with, one by one or all at once.
    /// </summary>
    [Theory]
    [InlineData(0), InlineData(1), InlineData(2), InlineData(3)]
    public void What_is_found_in_another_way_changes_no_bit(int block)
    {
        const int seeds = 6;
        for (int seed = 1000 + block * seeds; seed < 1000 + (block + 1) * seeds; ++seed)
        {
            var expected = Run(seed, SolveDescription.Default, false, Find(0, true, 0));
            Compare(seed, expected, Run(seed, SolveDescription.Default, false, Find(int.MaxValue, false, 0)));
            Compare(seed, expected, Run(seed, SolveDescription.Default, false, Find(7, true, int.MaxValue)));
        }
    }

    static Action<Simulation> Find(int mostWalked, bool remembersWitnesses, int bodiesPerKinematic) => simulation =>
    {
        simulation.CommonMotion.BodiesPerKinematic = bodiesPerKinematic;
        simulation.NarrowPhase.MostWalkedFromFloors = mostWalked;
        simulation.CommonMotion.Remembers = remembersWitnesses;
    };

    static void Compare(int seed, in SolveDescription solve) => Compare(seed, Run(seed, solve, false), Run(seed, solve, true));

    static void Compare(int seed, List<MotionState[]> expectedStates, List<MotionState[]> actualStates)
    {
        for (int step = 0; step < Steps; ++step)
        {
            for (int body = 0; body < expectedStates[step].Length; ++body)
            {
                var (expected, actual) = (expectedStates[step][body], actualStates[step][body]);
                Assert.True(
                    expected.Pose.Position.Equals(actual.Pose.Position) && expected.Pose.Orientation.Equals(actual.Pose.Orientation) &&
                    expected.Velocity.Linear.Equals(actual.Velocity.Linear) && expected.Velocity.Angular.Equals(actual.Velocity.Angular),
                    $"Seed {seed}, body {body} differs after step {step}: {expected.Pose.Position} became {actual.Pose.Position}.");
            }
        }
    }

    static List<MotionState[]> Run(int seed, in SolveDescription solve, bool hasOther, Action<Simulation>? prepare = null)
    {
        var pool = new BufferPool();
        using var dispatcher = seed % 2 == 0 ? new ThreadDispatcher(2) : null;
        var gravity = new Vector3(0, (seed % 4) switch { 0 => -1.6f, 1 => -30, 2 => -9.81f, _ => 0 }, 0);
        var simulation = Simulation.Create(pool, new DefaultNarrowPhaseCallbacks(), new DefaultPoseIntegratorCallbacks(gravity), solve);
        prepare?.Invoke(simulation);
        var sleepThreshold = seed % 2 == 0 ? 0.01f : -1;
        var island = new RandomIsland(simulation, pool, seed, default, sleepThreshold, seed % 3 == 0);
        var other = hasOther ? new RandomIsland(simulation, pool, seed + 100_000, new Vector3(3000, 0, 0), sleepThreshold, true) : null;
        var states = new List<MotionState[]>();
        for (int step = 0; step < Steps; ++step)
        {
            simulation.Timestep(1 / 60f, dispatcher);
            island.Edit();
            other?.Edit();
            var bodies = new MotionState[island.Count];
            for (int i = 0; i < bodies.Length; ++i)
                bodies[i] = island[i];
            states.Add(bodies);
        }
        simulation.Dispose();
        pool.Clear();
        return states;
    }
}
