using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using BepuPhysics;
using BepuUtilities.Diagnostics;
using Demos.Accuracy;
using Demos.Scenes;
using DemoTests.FastBodies;
using DemoTests.Quality;
using DemoTests.Queries;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Determinism;

/// <summary>
/// The same bits on every machine and from commit to commit: hashes of a few scenes, recorded in RecordedHashes.txt. They prove nothing about
/// what is right. A commit that changes one says in its message why it had to.
/// </summary>
/// <remarks>PHYSICS_UPDATE_HASHES=1 writes the file anew.</remarks>
public class RecordedHashTests
{
    const string File = "DemoTests/Determinism/RecordedHashes.txt";
    const string Heading = "# scene: hash of the state after some steps; written by PHYSICS_UPDATE_HASHES=1 dotnet test -c Release --filter RecordedHash";
    static readonly bool isUpdate = Environment.GetEnvironmentVariable("PHYSICS_UPDATE_HASHES") is { Length: > 0 };

    static readonly Dictionary<string, Func<ulong>> scenes = new()
    {
        ["pyramids"] = () => Run(SmallScenes.Pyramids(count: 3, baseCount: 10), 120),
        ["pyramids relaxed"] = () => Run(SmallScenes.Pyramids(count: 3, baseCount: 10), 60, relaxations: 1),
        ["pyramids by sweeps"] = () => Run(SmallScenes.Pyramids(count: 3, baseCount: 10), 120, loadPath: LoadPathMode.Off),
        ["pyramids always handed down"] = () => Run(SmallScenes.Pyramids(count: 3, baseCount: 10), 120, loadPath: LoadPathMode.Always),
        ["hull-pile by sweeps"] = () => Run(SmallScenes.Pile("hull-pile", columns: 4, layers: 4), 120, loadPath: LoadPathMode.Off),
        ["cloth-lattice"] = () => Run(SmallScenes.Lattice(width: 16), 60),
        ["cloth-lattice relaxed"] = () => Run(SmallScenes.Lattice(width: 16), 60, relaxations: 1),
        ["pile"] = () => Run(SceneLibrary.Load("pile", 1), 120),
        ["newton"] = () => Run(SceneLibrary.Load("newton", 1), 120),
        ["shape-pile"] = () => Run(SmallScenes.Pile("shape-pile", columns: 4, layers: 6), 120),
        ["hull-pile"] = () => Run(SmallScenes.Pile("hull-pile", columns: 4, layers: 4), 120),
        ["coins"] = () => Run(SceneLibrary.Load("coins", 1), 120),
        ["fast"] = () => Run(SmallScenes.Fast(seed: 1), 120),
        ["joints"] = () => Run(new RandomScene(5, Ingredients.Contacts | Ingredients.Joints), 60),
        ["joints at once"] = () => Run(new RandomScene(5, Ingredients.Contacts | Ingredients.Joints), 60, DirectJointsMode.Always),
        ["joints at once where needed"] = () => Run(SceneLibrary.Load("ragdolls", 1), 120, joints: DirectJointsMode.WhereNeeded),
        ["hubs"] = () => Run(new RandomScene(6, Ingredients.All), 60),
        ["bounces"] = () => Bounce(60),
        ["wave"] = () => Run(SmallScenes.Wave(), 350),
        ["sweeps"] = Sweeps,
        ["near"] = Near,
        ["marked shots at a mesh"] = () => ThinWallTests.HashOf(Shot.Hammer, Wall.Mesh, 1),
        ["marked shots at bodies"] = () => ThinWallTests.HashOf(Shot.SpinningRod, Wall.Heavy, 1),
    };

    public static TheoryData<string> Names() => new(scenes.Keys);

    [Theory]
    [MemberData(nameof(Names))]
    public void The_hash_of_a_scene_is_what_it_was(string name)
    {
        string hash = scenes[name]().ToString("x16", CultureInfo.InvariantCulture);
        var recorded = Read();
        if (isUpdate)
        {
            recorded[name] = hash;
            var lines = scenes.Keys.Where(recorded.ContainsKey).Select(key => $"{key}: {recorded[key]}");
            System.IO.File.WriteAllLines(RepositoryFiles.PathOf(File), [Heading, .. lines]);
        }
        Assert.True(recorded.TryGetValue(name, out string? expected), $"{File} has no hash of {name}.");
        Assert.True(expected == hash, $"The state of {name} has the hash {hash}; recorded is {expected}. If it had to change, the commit says why.");
    }

    [Fact]
    public void No_hash_is_recorded_of_a_scene_that_is_gone() => Assert.Equal(scenes.Keys.Order(), Read().Keys.Order());

    static Dictionary<string, string> Read()
    {
        const string Separator = ": ";
        string path = RepositoryFiles.PathOf(File);
        return !System.IO.File.Exists(path) ? [] : System.IO.File.ReadAllLines(path).Where(line => line[0] != '#')
            .Select(line => line.Split(Separator)).ToDictionary(parts => parts[0], parts => parts[1]);
    }

    static ulong Run(
        SceneDescription scene, int steps, int relaxations = 0, LoadPathMode loadPath = LoadPathMode.WhereNeeded,
        DirectJointsMode joints = DirectJointsMode.Off)
    {
        using var world = new SceneWorld(scene, threads: 1, relaxations, loadPath);
        world.Simulation.Solver.DirectJoints = joints;
        return world.HashSteps(steps)[^1];
    }

    static ulong Run(RandomScene scene, int steps, DirectJointsMode joints = DirectJointsMode.Off)
    {
        using var world = new TestWorld();
        world.Solver.DirectJoints = joints;
        scene.AddTo(world);
        return world.HashSteps(steps)[^1];
    }

    // Shapes of all kinds, by all that there is.
    static ulong Sweeps()
    {
        using var maze = new SweepMaze(9);
        var random = new Random(9);
        var hash = new StateHash();
        var hits = new List<SweptHit>();
        for (int i = 0; i < 300; ++i)
        {
            hits.Clear();
            var handler = new SweepHits(hits);
            maze.Sweep(SweepMaze.NextCase(random), ref handler);
            foreach (var hit in hits)
            {
                hash.Add(hit.T);
                hash.Add(hit.Place);
                hash.Add(hit.Normal);
            }
        }
        return hash.Value;
    }

    // What is near shapes of all kinds, of all that there is.
    static ulong Near()
    {
        using var maze = new SweepMaze(9);
        var random = new Random(10);
        var hash = new StateHash();
        for (int i = 0; i < 300; ++i)
        {
            var handler = new NearestProximity();
            maze.FindNear(SweepMaze.NextCase(random) with { MaximumT = float.PositiveInfinity }, maze.World.Pool, ref handler);
            hash.Add(handler.Nearest.Distance);
            hash.Add(handler.Nearest.Place);
            hash.Add(handler.Nearest.Normal);
        }
        return hash.Value;
    }

    // Restitution among bodies that fall on each other, with steps that change.
    static ulong Bounce(int steps)
    {
        using var world = new TestWorld(new AccuracySettings { Friction = .3f }, restitution: .8f);
        new RandomScene(7, Ingredients.Contacts).AddTo(world);
        for (int i = 0; i < steps; ++i)
            world.Step(i % 5 == 0 ? 1 / 45f : TestWorld.Dt);
        return world.Simulation.StateHash();
    }
}
