using System.Numerics;
using BepuPhysics.Collidables;
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

    [Fact]
    public void The_hero_crouches_and_climbs_a_ladder()
    {
        var pool = new BufferPool();
        var (simulation, characters, hero) = DocSamples.CreateCharacter(pool);
        var standing = simulation.Bodies[hero].Collidable.Shape;
        Assert.Equal((true, true), DocSamples.Crouch(characters, hero, simulation.Shapes.Add(new Capsule(.3f, .4f)), standing));
        Step(30);
        var from = Height();
        var (ladder, motor) = DocSamples.BeginLadder(simulation, hero, 1.5f);
        Step(60);
        Assert.Equal(from + 1.5f, Height(), .02f);
        DocSamples.Climb(simulation, ladder, motor, 0);
        Step(1);
        from = Height();
        Step(60);
        Assert.Equal(from, Height(), 1e-3f);
        DocSamples.EndLadder(simulation, ladder);
        Step(90);
        Assert.Equal(.9f, Height(), 2e-3f);
        Assert.True(characters.GetCharacterByBodyHandle(hero).Supported);
        characters.Dispose();
        simulation.Dispose();
        pool.AssertEmpty();
        pool.Clear();

        float Height() => simulation.Bodies[hero].Pose.Position.Y;

        void Step(int count)
        {
            for (int i = 0; i < count; ++i)
                simulation.Timestep(1 / 60f);
        }
    }
}
