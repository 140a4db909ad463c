using System.Collections.Generic;
using System.Numerics;
using BepuPhysics.Collidables;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Determinism;

/// <summary>
/// Simulations that take turns on a thread find nothing of their own in its caches, and go over their pairs in another way than one that is stepped
/// alone. That changes no bit.
/// </summary>
public class SimulationsInTurnTests
{
    const int Steps = 60;
    const int BallsPerSide = 64;
    // What a cache is taken to hold, over what a pair takes of it.
    const int PairsInCache = (3 << 18) / 256;

    [Theory]
    [InlineData(1, Ingredients.All), InlineData(2, Ingredients.Contacts), InlineData(3, Ingredients.Contacts | Ingredients.Joints)]
    public void One_among_others_does_what_it_does_alone(int seed, Ingredients ingredients)
    {
        using var alone = new TestWorld();
        using var inTurn = new TestWorld();
        using var other = Balls();
        var scene = new RandomScene(seed, ingredients, 60);
        scene.AddTo(alone);
        scene.AddTo(inTurn);
        var expected = alone.HashSteps(Steps);
        var hashes = new List<ulong>();
        for (int i = 0; i < Steps; ++i)
        {
            other.Step();
            hashes.AddRange(inTurn.HashSteps(1));
        }
        Assert.True(other.Simulation.NarrowPhase.PairCount > PairsInCache, "The other one leaves what the first had in the caches.");
        Assert.Equal(expected, hashes);
    }

    // Side by side on a floor, each of them touching its neighbours.
    static TestWorld Balls()
    {
        const float radius = .25f;
        var world = new TestWorld();
        world.AddStatic(new Box(100, 1, 100), new Vector3(0, -.5f, 0));
        var ball = new Sphere(radius);
        for (int i = 0; i < BallsPerSide * BallsPerSide; ++i)
            world.AddDynamic(ball, 1, new Vector3(i % BallsPerSide * 2 * radius, radius, i / BallsPerSide * 2 * radius));
        return world;
    }
}
