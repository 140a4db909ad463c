using System;
using System.Globalization;
using Demos.Scenes;
using DemoTests.Scenes;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.CollisionDetection;

/// <summary>
/// What searches that go on from the last step save in a pile of hulls. PHYSICS_FULL_TESTS: the whole scene of 2,000 in place of a small one.
/// </summary>
public class WarmStartTests(ITestOutputHelper output)
{
    const int PhaseCount = 4;

    static bool IsFull => Environment.GetEnvironmentVariable("PHYSICS_FULL_TESTS") is { Length: > 0 };

    [Fact]
    public void A_pile_of_hulls_takes_less_than_half_of_the_evaluations()
    {
        var scene = IsFull ? SceneLibrary.Load("hull-pile", 1) : SmallScenes.Pile("hull-pile", 4, 4);
        var stepsPerPhase = (IsFull ? scene.Steps : 160) / PhaseCount;
        using var world = new ShapeProbe(scene);
        var pairs = new WarmStartPairs(world.Simulation);
        for (int phase = 0; phase < PhaseCount; ++phase)
        {
            ConvexPairEffort cold = new(), warm = new();
            var keptCount = 0L;
            for (int step = 0; step < stepsPerPhase; ++step)
            {
                world.Step(1);
                var (coldOutcomes, warmOutcomes) = pairs.Search();
                for (int i = 0; i < coldOutcomes.Length; ++i)
                {
                    cold.Add(coldOutcomes[i]);
                    warm.Add(warmOutcomes[i]);
                }
                keptCount += pairs.KeptCount;
            }
            var steps = string.Create(CultureInfo.InvariantCulture, $"{phase * stepsPerPhase + 1} to {(phase + 1) * stepsPerPhase}");
            var share = (100.0 * keptCount / cold.SearchCount).ToString("f1", CultureInfo.InvariantCulture);
            var rows = $"| {world.BodyCount} hulls | {steps} | cold | 0 | {cold}\n| {world.BodyCount} hulls | {steps} | warm | {share} | {warm}";
            output.WriteLine(rows);
            ConvexPairReport.Add(ConvexPairTable.Pile, $"{phase}", rows);
            Assert.True(warm.Mean < cold.Mean / 2, rows);
        }
    }
}
