using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Runtime.Intrinsics;
using System.Text.Json;
using Demos.Scenes;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Scenes;

/// <summary>The same bits after every step, for any number of threads and any width of vectors.</summary>
/// <remarks>The environment variable PHYSICS_FULL_TESTS makes the scenes as large as the runner's.</remarks>
public sealed class DeterminismTests(ITestOutputHelper output)
{
    static bool IsFull => Environment.GetEnvironmentVariable("PHYSICS_FULL_TESTS") is { Length: > 0 };

    [Theory]
    [InlineData("pyramids", 300)]
    [InlineData("cloth-lattice", 120)]
    [InlineData("pile", 300)]
    [InlineData("shape-pile", 200)]
    [InlineData("hull-pile", 200)]
    [InlineData("wave", 350)]
    [InlineData("tiles", 150)]
    [InlineData("gears-of-hulls", 60)]
    [InlineData("tori", 60)]
    public void Threads_do_not_change_a_bit(string name, int steps)
    {
        var scene = Scene(name);
        var expected = Run(scene, 1, steps);
        foreach (int threads in (ReadOnlySpan<int>)[2, 3, 8])
            AssertSame(expected, Run(scene, threads, steps), $"{name} with {threads} threads");
    }

    [Fact]
    public void Relaxation_does_not_depend_on_threads()
    {
        foreach (string name in (ReadOnlySpan<string>)["pyramids", "cloth-lattice", "pile"])
        {
            var scene = Scene(name);
            var expected = Run(scene, 1, 60, relaxations: 1);
            foreach (int threads in (ReadOnlySpan<int>)[2, 3])
                AssertSame(expected, Run(scene, threads, 60, relaxations: 1), $"{name}, relaxed, with {threads} threads");
        }
    }

    [Fact]
    public void A_run_that_is_repeated_gives_the_same_bits()
    {
        var scene = Scene("pile");
        AssertSame(Run(scene, 2, 60), Run(scene, 2, 60), "pile again");
    }

    [Theory]
    [InlineData("pyramids", 40, 300)]
    [InlineData("cloth-lattice", 20, 300)]
    [InlineData("pile", 300, 300)]
    [InlineData("newton", 120, 300)]
    [InlineData("shape-pile", 200, 300)]
    [InlineData("hull-pile", 200, 300)]
    [InlineData("coins", 300, 900)]
    [InlineData("fast-1", 120, 300)]
    [InlineData("fast-2", 120, 300)]
    [InlineData("fast-3", 120, 300)]
    [InlineData("wave", 350, 350)]
    [InlineData("tiles", 150, 300)]
    [InlineData("gears-of-hulls", 60, 300)]
    [InlineData("tori", 45, 300)]
    public void Lanes_do_not_change_a_bit(string name, int steps, int fullSteps)
    {
        // Another process knows the built-in scenes only; a small one it reads from a file.
        var isSmall = name == "wave" || IsFast(name) || (!IsFull && name is "shape-pile" or "hull-pile");
        AssertSameForAnyLanes(name, isSmall ? Scene(name) : null, IsFull ? fullSteps : steps);
    }

    /// <summary>Requires the same recorded hashes for 4, 8 and 16 lanes.</summary>
    /// <param name="name">Name of a built-in scene, or of the one that is given.</param>
    /// <param name="scene">The scene; null for a built-in one.</param>
    /// <param name="steps">Steps to run.</param>
    /// <param name="options">Options of the run.</param>
    internal void AssertSameForAnyLanes(string name, SceneDescription? scene, int steps, params string[] options)
    {
        var four = RunChild(name, scene, steps, LaneRunner.Four, out int lanes, options);
        Assert.Equal(4, lanes);
        // The stand-in is the same on every processor; true vectors of 512 bits are asked for besides, where there are any.
        AssertSame(four, RunChild(name, scene, steps, LaneRunner.StandIn, out lanes, options), $"{name} with 16 lanes, against 4,");
        Assert.Equal(16, lanes);
        if (Vector256.IsHardwareAccelerated)
        {
            AssertSame(four, RunChild(name, scene, steps, LaneRunner.Eight, out lanes, options), $"{name} with 8 lanes, against 4,");
            Assert.Equal(8, lanes);
        }
        else
        {
            output.WriteLine("Not run with 8 lanes: this processor has no vectors of 256 bits.");
        }
        if (Vector512.IsHardwareAccelerated)
        {
            AssertSame(four, RunChild(name, scene, steps, LaneRunner.Sixteen, out lanes, options), $"{name} with vectors of 512 bits, against 4 lanes,");
            Assert.Equal(16, lanes);
        }
        else
        {
            output.WriteLine("Not run with vectors of 512 bits: this processor has no vectors of 512 bits.");
        }
    }

    static bool IsFast(string name) => name.StartsWith("fast-", StringComparison.Ordinal);

    static SceneDescription Scene(string name) => name switch
    {
        "wave" => SmallScenes.Wave(),
        _ when IsFast(name) => SmallScenes.Fast(name[^1]),
        _ when IsFull => SceneLibrary.Load(name, 1),
        "pyramids" => SmallScenes.Pyramids(count: 5, baseCount: 12),
        "cloth-lattice" => SmallScenes.Lattice(width: 24),
        "shape-pile" => SmallScenes.Pile("shape-pile", columns: 4, layers: 8),
        "hull-pile" => SmallScenes.Pile("hull-pile", columns: 4, layers: 5),
        "tori" => SmallScenes.Tori(12),
        _ => SceneLibrary.Load(name, 1),
    };

    static List<(int Step, string Hash)> Run(SceneDescription scene, int threads, int steps, int relaxations = 0)
    {
        using var world = new SceneWorld(scene, threads, relaxations);
        return world.HashSteps(steps).ConvertAll(hash => hash.ToString("x16", CultureInfo.InvariantCulture)).Numbered();
    }

    static List<(int Step, string Hash)> RunChild(
        string name, SceneDescription? scene, int steps, LaneRunner runner, out int lanes, string[]? options = null)
    {
        string json = Path.GetTempFileName(), file = Path.GetTempFileName() + ".scene";
        try
        {
            if (scene is not null)
                File.WriteAllText(file, SmallScenes.Write(scene));
            int status = runner.Run(
            [
                "run", scene is null ? name : file, "--steps", steps.ToString(CultureInfo.InvariantCulture), "--hash-every", "1", "--json", json,
                .. options ?? [],
            ], out string messages);
            // A status of 2 says that bodies were lost: what falls freely for five seconds is.
            Assert.True(status is 0 or 2, $"{name} with {runner.Name} ended with {status}: {messages}");
            var root = JsonDocument.Parse(File.ReadAllBytes(json)).RootElement;
            lanes = root.GetProperty("lanes").GetInt32();
            var hashes = new List<(int, string)>();
            foreach (var entry in root.GetProperty("hashes").EnumerateArray())
                hashes.Add((entry[0].GetInt32(), entry[1].GetString()!));
            return hashes;
        }
        finally
        {
            File.Delete(json);
            File.Delete(file);
        }
    }

    internal static void AssertSame(List<(int Step, string Hash)> expected, List<(int Step, string Hash)> actual, string what)
    {
        Assert.NotEmpty(expected);
        Assert.Equal(expected.Count, actual.Count);
        for (int i = 0; i < expected.Count; ++i)
            Assert.True(expected[i] == actual[i], $"{what} first differs after step {expected[i].Step}: {expected[i].Hash} became {actual[i].Hash}.");
    }
}

/// <summary>Numbers the steps of a run from 1.</summary>
static class NumberedSteps
{
    public static List<(int Step, string Hash)> Numbered(this List<string> hashes)
    {
        var numbered = new List<(int, string)>(hashes.Count);
        foreach (string hash in hashes)
            numbered.Add((numbered.Count + 1, hash));
        return numbered;
    }
}
