using System.Numerics;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.Quality;

/// <summary>The character of the guide walks and jumps as it is told.</summary>
public class CharacterGuideTests
{
    [Fact]
    public void The_hero_walks_where_it_looks_and_jumps()
    {
        var pool = new BufferPool();
        var (simulation, characters, hero) = DocSamples.CreateCharacter(pool);
        for (int i = 0; i < 60; ++i)
            DocSamples.MoveCharacter(simulation, characters, hero, new Vector3(1, 0, 0), new Vector2(0, 1), jump: false);
        Assert.True((simulation.Bodies[hero].Velocity.Linear - new Vector3(4, 0, 0)).Length() < 1e-3f);
        Assert.True(characters.GetCharacterByBodyHandle(hero).Supported);
        DocSamples.MoveCharacter(simulation, characters, hero, new Vector3(1, 0, 0), new Vector2(0, 1), jump: true);
        Assert.True(simulation.Bodies[hero].Velocity.Linear.Y > 4.5f);
        characters.Dispose();
        simulation.Dispose();
        pool.AssertEmpty();
        pool.Clear();
    }
}
