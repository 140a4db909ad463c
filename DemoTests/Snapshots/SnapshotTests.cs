using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuUtilities.Memory;
using Demos.Accuracy;
using Demos.Scenes;
using DemoTests.Determinism;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Snapshots;

/// <summary>A world that was restored goes on as the one that was saved, to the bit, whatever was done with it in between.</summary>
public class SnapshotTests
{
    const int StepsAfter = 25;

    static readonly int[] savedAt = [0, 1, 7, 40, 90];

    static readonly Dictionary<string, Func<SceneDescription>> scenes = new()
    {
        ["pyramids"] = () => SmallScenes.Pyramids(2, 8),
        ["lattice"] = () => SmallScenes.Lattice(8),
        ["shapes"] = () => SmallScenes.Pile("shape-pile", 4, 3),
        ["hulls"] = () => SmallScenes.Pile("hull-pile", 3, 3),
        ["fast"] = () => SmallScenes.Fast(3),
        ["ragdolls"] = () => SceneLibrary.Load("ragdolls", 1),
        ["washer"] = () => SceneLibrary.Load("washer", 1),
        ["tori"] = () => SmallScenes.Tori(12),
    };

    public static TheoryData<string, int> Cases()
    {
        var cases = new TheoryData<string, int>();
        foreach (var name in scenes.Keys)
        {
            cases.Add(name, 1);
            cases.Add(name, 3);
        }
        return cases;
    }

    [Theory]
    [MemberData(nameof(Cases))]
    public void A_restored_world_goes_on_as_the_saved_one(string name, int threads)
    {
        var scene = scenes[name]();
        using var world = new SceneWorld(scene, threads);
        using var other = new SceneWorld(scene, threads: 4 - threads);
        AssertGoesOn(world, other);
    }

    [Theory]
    [InlineData("chain", DirectJointsMode.Always), InlineData("ragdolls", DirectJointsMode.Always)]
    [InlineData("chain", DirectJointsMode.WhereNeeded), InlineData("ragdolls", DirectJointsMode.WhereNeeded)]
    public void Joints_that_are_solved_at_once_go_on(string name, DirectJointsMode mode)
    {
        var scene = SceneLibrary.Load(name, 1);
        using var world = new SceneWorld(scene, threads: 1);
        using var other = new SceneWorld(scene, threads: 2);
        world.Simulation.Solver.DirectJoints = mode;
        AssertGoesOn(world, other);
        Assert.Equal(mode, other.Simulation.Solver.DirectJoints);
    }

    /// <summary>What the solver was told to do comes back too: a game may have changed it after it saved.</summary>
    [Theory, InlineData(false), InlineData(true)]
    public void What_the_solver_was_told_comes_back(bool isSaved)
    {
        using var world = new TestWorld(new AccuracySettings());
        using var pool = new BufferPool();
        using var snapshot = new SimulationSnapshot(pool);
        var solver = world.Solver;
        static (bool, bool, float, DirectJointsMode, LoadPathMode) Settings(bool value) =>
            (value, value, value ? 30 : 0, value ? DirectJointsMode.Always : DirectJointsMode.Off, value ? LoadPathMode.Off : LoadPathMode.WhereNeeded);
        void Tell(bool value) =>
            (solver.StopsImpacts, solver.ClosesGapsSlowly, solver.ContactFrequency, solver.DirectJoints, solver.LoadPath) = Settings(value);
        Tell(isSaved);
        world.Simulation.Save(snapshot);
        Tell(!isSaved);
        world.Simulation.Restore(snapshot);
        Assert.Equal(Settings(isSaved), (solver.StopsImpacts, solver.ClosesGapsSlowly, solver.ContactFrequency, solver.DirectJoints, solver.LoadPath));
    }

    static void AssertGoesOn(SceneWorld world, SceneWorld other)
    {
        using var pool = new BufferPool();
        using var snapshot = new SimulationSnapshot(pool);
        var step = 0;
        foreach (var at in savedAt)
        {
            for (; step < at; ++step)
                world.Step();
            world.Simulation.Save(snapshot);
            var expected = world.HashSteps(StepsAfter);
            // Another way on.
            for (int i = 0; i < 5; ++i)
            {
                world.Simulation.Bodies.ActiveSet.MotionStates[i].Velocity.Linear += new Vector3(1, 2, 3);
                world.Step();
            }
            world.Simulation.Restore(snapshot);
            world.Simulation.Validate();
            Assert.Equal(expected, world.HashSteps(StepsAfter));
            other.Simulation.Restore(snapshot);
            other.Simulation.Validate();
            Assert.Equal(expected, other.HashSteps(StepsAfter));
            world.Simulation.Restore(snapshot);
        }
    }

    [Theory]
    [InlineData(1), InlineData(2), InlineData(3), InlineData(4), InlineData(5), InlineData(6)]
    public void What_was_done_between_saving_and_restoring_leaves_no_trace(int seed)
    {
        var expected = Run(seed, static _ => { });
        using var pool = new BufferPool();
        using var snapshot = new SimulationSnapshot(pool);
        var random = new Random(seed + 1000);
        Assert.Equal(expected, Run(seed, simulation =>
        {
            simulation.Save(snapshot);
            Disturb(simulation, random);
            simulation.Restore(snapshot);
        }));
    }

    static List<ulong> Run(int seed, Action<Simulation> betweenSteps)
    {
        var hashes = new List<ulong>();
        using var scramble = new Scramble(seed, threads: 1 + seed % 3, sizes: null, sleeps: seed % 2 == 0);
        for (int i = 0; i < 120; ++i)
        {
            betweenSteps(scramble.Simulation);
            scramble.Round();
            scramble.Check();
            hashes.Add(scramble.Simulation.StateHash());
        }
        return hashes;
    }

    // Anything that a game may do but remove shapes.
    static void Disturb(Simulation simulation, Random random)
    {
        var shape = simulation.Shapes.Add(new Box(1, 1, 1));
        for (int i = random.Next(4); i > 0; --i)
        {
            switch (random.Next(6))
            {
                case 0:
                    for (int j = 0; j < 40; ++j)
                        simulation.Bodies.Add(RandomScene.AnyBody(random) with { Collidable = shape });
                    break;
                case 1:
                    for (int j = 0; j < 5 && simulation.Bodies.ActiveSet.Count > 0; ++j)
                        simulation.Bodies.RemoveAt(random.Next(simulation.Bodies.ActiveSet.Count));
                    break;
                case 2:
                    if (simulation.Statics.Count > 0)
                        simulation.Statics.RemoveAt(random.Next(simulation.Statics.Count));
                    break;
                case 3:
                    simulation.Statics.Add(new(new Vector3(random.Next(8) - 4, 1, 0), shape));
                    break;
                case 4:
                    simulation.Awakener.AwakenAll();
                    break;
                case 5:
                    simulation.Solver.SubstepCount = random.Next(1, 9);
                    break;
            }
            for (int j = random.Next(3); j > 0; --j)
                simulation.Timestep(random.Next(2) == 0 ? 1 / 60f : 1 / 30f);
        }
    }
}
