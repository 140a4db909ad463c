using System;
using System.Globalization;
using BepuPhysics.Collidables;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.FastBodies;

/// <summary>What is marked as continuous does not pass walls, however fast and thin it is.</summary>
public class ThinWallTests(ITestOutputHelper output)
{
    static readonly bool isFull = Environment.GetEnvironmentVariable("PHYSICS_FULL_TESTS") is { Length: > 0 };
    static readonly ulong seed = ulong.Parse(Environment.GetEnvironmentVariable("PHYSICS_FAST_SEED") ?? "11", CultureInfo.InvariantCulture);

    public static TheoryData<Shot, Wall> Cases
    {
        get
        {
            var data = new TheoryData<Shot, Wall>();
            foreach (var shot in Enum.GetValues<Shot>())
            {
                foreach (var wall in Enum.GetValues<Wall>())
                    data.Add(shot, wall);
            }
            return data;
        }
    }

    [Theory]
    [MemberData(nameof(Cases))]
    public void MarkedShotsDoNotPass(Shot shot, Wall wall)
    {
        foreach (var speed in new[] { 100, 1000 })
        {
            var passed = 0;
            foreach (var mode in isFull ? Enum.GetValues<ContinuousDetectionMode>() : [ContinuousDetectionMode.Continuous])
            {
                using var world = new ThinWall(
                    shot, wall, speed, new ContinuousDetection { Mode = mode }, isFull ? 300 : 30, seed);
                output.WriteLine($"{shot} {wall} {speed} m/s {mode}: {world.PassedCount} pass; normal speed {world.GreatestNormalSpeed:f4}; " +
                    $"way lost {world.GreatestLostWay:f4}, of {world.DelayedCount}");
                passed = world.PassedCount;
            }
            // Of the last mode, which is the one that is marked.
            Assert.Equal(0, passed);
        }
    }

    /// <summary>The same bits on any number of threads.</summary>
    [Theory]
    [InlineData(Shot.SpinningRod, Wall.Mesh)]
    [InlineData(Shot.Hammer, Wall.Heavy)]
    public void ThreadsDoNotShow(Shot shot, Wall wall)
    {
        var hash = HashOf(shot, wall, 1);
        Assert.Equal(hash, HashOf(shot, wall, 2));
        Assert.Equal(hash, HashOf(shot, wall, 5));
    }

    /// <summary>Hash of what becomes of some shots, for the record.</summary>
    internal static ulong HashOf(Shot shot, Wall wall, int threads)
    {
        using var world = new ThinWall(shot, wall, 300, ContinuousDetection.Continuous(), 40, 3, threads: threads);
        return world.Simulation.StateHash();
    }
}
